#include "files/mesh_decoder/gltf_nodes.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "files/decoding/fail.h"
#include "files/mesh_decoder/meshes.h"

namespace gpu_shading::decoding {
namespace {

using Json = nlohmann::json;

constexpr std::string_view glb_mark = "glTF";

// Little-endian, as this machine.
std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t number = 0;
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

// The JSON of a GLB: its first chunk.
std::string_view json_of(std::string_view glb) {
  constexpr std::size_t header = 12;
  constexpr std::size_t chunk_header = 8;
  constexpr std::size_t length_at = 8;
  if (glb.size() < header + chunk_header) fail("it is shorter than a GLB's header");
  auto const stated = number_at(glb, length_at);
  if (stated > glb.size()) {
    fail("its header states " + std::to_string(stated) + " bytes, but it has " +
         std::to_string(glb.size()));
  }
  std::string_view json;
  for (std::size_t at = header; at + chunk_header <= stated;) {
    std::size_t const length = number_at(glb, at);
    at += chunk_header;
    if (length > stated - at) {
      fail("a chunk states " + std::to_string(length) + " bytes, of which it has " +
           std::to_string(stated - at));
    }
    if (json.data() == nullptr) json = glb.substr(at, length);
    at += length;
  }
  return json;
}

// The number of each node's parent, or `none`.
class Parents {
 public:
  explicit Parents(Json const& nodes) : parents_(nodes.size(), none) {
    for (std::size_t node = 0; node < nodes.size(); ++node) {
      if (!nodes[node].is_object()) fail("node " + std::to_string(node) + " is not an object");
      auto const children = nodes[node].find("children");
      if (children == nodes[node].end()) continue;
      for (auto const& child : *children) add(node, child);
    }
  }

  // A node whose parents do not end within deepest_node is too deep or below itself.
  void check_depth() const {
    for (std::size_t node = 0; node < parents_.size(); ++node) {
      std::size_t depth = 0;
      for (auto above = node; parents_[above] != none; above = parents_[above]) {
        if (++depth <= deepest_node) continue;
        fail("node " + std::to_string(node) + " is more than " + std::to_string(deepest_node) +
             " nodes deep, or below itself");
      }
    }
  }

 private:
  static constexpr std::size_t none = ~std::size_t{0};

  void add(std::size_t parent, Json const& child) {
    if (!child.is_number_unsigned() || child.get<std::size_t>() >= parents_.size()) {
      fail("node " + std::to_string(parent) + " has a child that does not exist");
    }
    auto& known = parents_[child.get<std::size_t>()];
    if (known != none) {
      fail("node " + std::to_string(child.get<std::size_t>()) +
           " is a child of more than one node, or twice of one");
    }
    known = parent;
  }

  std::vector<std::size_t> parents_;
};

}  // namespace

bool is_glb(char const* path) {
  std::array<char, glb_mark.size()> first{};
  std::ifstream(path, std::ios::binary).read(first.data(), first.size());
  return std::string_view(first.data(), first.size()) == glb_mark;
}

void check_gltf_nodes(char const* path) {
  std::ifstream file(path, std::ios::binary);
  std::string const bytes{std::istreambuf_iterator<char>(file), {}};
  auto const text = std::string_view(bytes).starts_with(glb_mark) ? json_of(bytes) : bytes;
  auto const root = Json::parse(text, nullptr, false);
  if (!root.is_object()) fail("it is not glTF: its JSON is damaged");
  auto const nodes = root.find("nodes");
  if (nodes == root.end()) return;
  if (!nodes->is_array()) fail("its nodes are not an array");
  Parents(*nodes).check_depth();
}

}  // namespace gpu_shading::decoding

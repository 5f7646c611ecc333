#include "runs/drawing.h"

#include <optional>
#include <string_view>

#include "gpu_shading/error.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

// Comments before a polyline: "Building Shading:NAME", "Fixed Shading:NAME" or "ZONE:NAME"; the
// zones are listed earlier, as "Zone=1:ZONE".
class Names {
 public:
  void read_zone(std::string const& comment) {
    constexpr std::string_view start = "Zone=";
    auto const colon = comment.find(':');
    if (comment.starts_with(start) && colon != std::string::npos) {
      owners_.push_back(comment.substr(colon + 1) + ":");
    }
  }

  std::string name_of(std::string const& comment) const {
    std::size_t longest = 0;  // a zone's name may be the beginning of another's
    for (auto const& owner : owners_) {
      if (comment.starts_with(owner)) longest = std::max(longest, owner.size());
    }
    if (longest == 0) longest = comment.find(':') + 1;
    return comment.substr(longest);
  }

 private:
  std::vector<std::string> owners_{"Building Shading:", "Fixed Shading:"};
};

double coordinate(std::string const& text) {
  auto const value = parse_number(trimmed(text));
  if (!value) throw Error("eplusout.dxf: \"" + trimmed(text) + "\" is not a number");
  return *value;
}

}  // namespace

std::vector<DrawnSurface> read_drawing(std::istream& dxf) {
  std::vector<DrawnSurface> surfaces;
  Names names;
  std::string comment;
  std::optional<DrawnSurface> current;
  bool in_vertex = false;
  bool ended = false;
  std::string code;
  std::string value;
  while (std::getline(dxf, code) && std::getline(dxf, value)) {
    code = trimmed(code);
    if (code == "999") {
      comment = trimmed(value);
      names.read_zone(comment);
    } else if (code == "0") {
      auto const entity = trimmed(value);
      in_vertex = entity == "VERTEX" && current;
      if (in_vertex) current->outline.emplace_back(0.0);
      if (entity == "POLYLINE") current = DrawnSurface{names.name_of(comment), {}};
      if (entity == "SEQEND" && current) {
        if (!current->name.starts_with("Mir-")) surfaces.push_back(std::move(*current));
        current.reset();
      }
      ended = ended || entity == "EOF";
    } else if (in_vertex && (code == "10" || code == "20" || code == "30")) {
      current->outline.back()[code[0] - '1'] = coordinate(value);
    }
  }
  if (!ended) throw Error("eplusout.dxf: ends unexpectedly");
  return surfaces;
}

}  // namespace gpu_shading::energyplus

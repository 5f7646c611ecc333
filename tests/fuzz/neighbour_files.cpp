// The names that a mesh gives to other files: whatever they are, nothing outside its folder is
// read.

#include "files/mesh_decoder/neighbour_files.h"

#include <assimp/IOStream.hpp>
#include <memory>
#include <string>

#include "fuzz.h"

namespace {

namespace fs = std::filesystem;

// A folder with a mesh, a file beside it, and links that lead out of it.
fs::path make_folder() {
  static gpu_shading::energyplus::TemporaryFolder const temporary;
  auto const& top = temporary.path();
  auto folder = top / "models" / "in";
  fs::create_directories(folder / "sub");
  for (auto const& file : {folder / "a.obj", folder / "in.mtl", folder / "sub" / "in.mtl"}) {
    std::ofstream(file) << "inside";
  }
  for (auto const& file : {top / "out.mtl", top / "models" / "out.mtl"}) {
    std::ofstream(file) << "secret";
  }
  fs::create_symlink("../out.mtl", folder / "link");
  fs::create_symlink("..", folder / "up");
  fs::create_symlink("loop", folder / "loop");
  return folder;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace gpu_shading;
  static auto const folder = make_folder();
  static auto const mesh = folder / "a.obj";
  std::string const name(energyplus::as_text(data, size));
  try {
    decoding::NeighbourFiles files(mesh.c_str(), mesh, false);
    files.Exists(name.c_str());
    energyplus::require(files.Open(name.c_str(), "wb") == nullptr);
    std::unique_ptr<Assimp::IOStream> const file(files.Open(name.c_str(), "rb"));
    if (!file) return 0;
    std::string bytes(file->FileSize(), '\0');
    file->Read(bytes.data(), 1, bytes.size());
    energyplus::require(bytes == "inside");
  } catch (std::exception const&) {
    return 0;
  }
  return 0;
}

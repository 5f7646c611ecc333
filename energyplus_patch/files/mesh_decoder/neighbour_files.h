#pragma once

#include <assimp/IOSystem.hpp>
#include <filesystem>
#include <string>

namespace gpu_shading::decoding {

// The files that Assimp opens: the file itself, and those that it names, such as buffers and
// materials, which must be in its folder or below.
class NeighbourFiles : public Assimp::IOSystem {
 public:
  // `path`: where the file itself is opened. `name`: how it is called; the names of others are
  // relative to its folder. `anywhere`: others may be in any folder.
  NeighbourFiles(char const* path, std::filesystem::path const& name, bool anywhere);

  bool Exists(char const* name) const override;
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(char const* name, char const* mode) override;
  void Close(Assimp::IOStream* file) override;

  // Why a file that was asked for was refused, or "".
  std::string const& refusal() const { return refusal_; }

 private:
  std::filesystem::path find(char const* name) const;
  bool allows(std::filesystem::path const& path) const;

  std::filesystem::path path_;
  std::filesystem::path name_;
  std::filesystem::path folder_;
  bool anywhere_;
  std::string refusal_;
};

}  // namespace gpu_shading::decoding

#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "files/decoding/decoded_message.h"
#include "files/decoding/sandbox.h"

namespace gpu_shading::decoding {

// The file that a decoding program reads is its standard input; libraries open it by this name.
inline constexpr char const* input_path = "/proc/self/fd/0";

// How a decoding program is called.
struct Request {
  // What to read, and how the file is called.
  std::string operation;
  std::filesystem::path name;
  // Whether any format of the library is read, and whatever other file the file names.
  bool any = false;
};

// The body of a decoding program's main(), which serves (files/decoding/server.h) requests of the
// words PARENT SECONDS BYTES OPERATION any|restricted NAME. `decode` puts its answer, or throws
// std::exception with the reason. `reads_neighbours`: whether it reads files beside the file.
// Returns the exit status.
int run_decoder(bool reads_neighbours,
                std::function<void(Request const&, DecodedMessage&)> const& decode);

}  // namespace gpu_shading::decoding

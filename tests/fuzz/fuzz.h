#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "gpu_shading/error.h"
#include "platform/process.h"
#include "platform/text.h"

// libFuzzer's own entry. Everything but an Error is a finding.
extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size);

namespace gpu_shading::energyplus {

inline std::string_view as_text(std::uint8_t const* data, std::size_t size) {
  return {reinterpret_cast<char const*>(data), size};
}

// A file with these bytes, the same one for every call in a process.
inline std::filesystem::path file_of(std::string_view bytes, std::string_view name) {
  static TemporaryFolder const folder;
  auto path = folder.path() / name;
  std::ofstream(path, std::ios::binary)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return path;
}

// The bytes of an input as values, zeros after their end.
class Values {
 public:
  Values(std::uint8_t const* data, std::size_t size) : rest_(data), left_(size) {}

  bool has_more() const { return left_ > 0; }

  template <typename Value>
  Value next() {
    Value value{};
    auto const count = left_ < sizeof value ? left_ : sizeof value;
    if (count > 0) std::memcpy(&value, rest_, count);
    rest_ += count;
    left_ -= count;
    return value;
  }

  // 0 .. most
  template <typename Value>
  Value next_up_to(Value most) {
    return static_cast<Value>(next<Value>() % (most + Value{1}));
  }

 private:
  std::uint8_t const* rest_;
  std::size_t left_;
};

// Stops at what must hold for every input and does not.
inline void require(bool holds) {
  if (!holds) std::terminate();
}

// Whether a line may go to a terminal as it is.
inline bool is_clean_line(std::string_view line) {
  constexpr std::size_t longest = 4096;
  constexpr unsigned char del = 0x7F;
  return line.size() <= longest && std::none_of(line.begin(), line.end(), [](unsigned char c) {
           return c < ' ' || c == del;
         });
}

// Calls `read`, which may refuse its input with an Error, told in one line.
template <typename Read>
int try_to(Read const& read) {
  try {
    read();
  } catch (Error const& error) {
    require(is_clean_line(one_line(error.what())));
  }
  return 0;
}

}  // namespace gpu_shading::energyplus

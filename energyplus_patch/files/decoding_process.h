#pragma once

#include <sys/types.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "files/asset_folder.h"
#include "files/decoding_server.h"
#include "platform/file_descriptor.h"

namespace gpu_shading::energyplus {

// What decoding a file may take.
struct DecodingLimits {
  std::uint64_t seconds = 60;                     // of processor time
  std::uint64_t memory = std::uint64_t{4} << 30;  // bytes of address space
  std::chrono::seconds wait{300};                 // until the answer is complete
  std::uint64_t file_size = std::uint64_t{1} << 30;
};

// Reads a file by one of our decoding programs, in a process of its own (files/decoding/decoder.h),
// and its untrusted reply. Every function throws Error with the reason in one
// line, to which the caller adds the file's name: also if the program crashes or reaches a limit.
class DecodingProcess {
 public:
  // `program`: one beside this module or program.
  DecodingProcess(char const* program, std::string const& operation,
                  std::filesystem::path const& file, Assets assets,
                  DecodingLimits const& limits = {});
  DecodingProcess(DecodingProcess const&) = delete;
  DecodingProcess& operator=(DecodingProcess const&) = delete;
  ~DecodingProcess();

  // The next value. If it is not in the range, the program is wrong about its own answer.
  template <typename Value>
  Value next(Value min, Value max) {
    static_assert(std::is_arithmetic_v<Value>);
    Value value{};
    read(&value, sizeof value);
    if (!(value >= min && value <= max)) throw_invalid();
    return value;
  }

  double next_double();  // any, NaN included

  std::string next_text();

  // `count` must have been checked. The memory grows with what arrives: a false count takes none.
  template <typename Value>
  std::vector<Value> next_all(std::size_t count) {
    static_assert(std::is_arithmetic_v<Value>);
    constexpr std::size_t first = std::size_t{1} << 20U;
    std::vector<Value> values;
    while (values.size() < count) {
      auto const known = values.size();
      auto const more = std::min(count - known, std::max(first, known));
      values.resize(known + more);
      read(values.data() + known, more * sizeof(Value));
    }
    return values;
  }

  // Checks that the answer ends here, and the process well.
  void finish();

  [[noreturn]] static void throw_invalid();

 private:
  void begin();
  void read(void* bytes, std::size_t count);
  std::size_t read_some(char* bytes, std::size_t count);  // 0: the end
  int wait();
  [[noreturn]] void throw_reason(int status) const;

  DecodingLimits limits_;
  DecodingDeadline deadline_;
  std::optional<FileDescriptor> answer_;
  pid_t process_ = -1;
  bool begun_ = false;
};

}  // namespace gpu_shading::energyplus

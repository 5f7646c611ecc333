#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <vector>

// What a decoding program writes to its standard output: `message_mark`, a Status, then for
// `failed` a text, and for `done` the values that its main.cpp lists. Values are in the byte order
// of the machine; a text is its length (32 bits) and its bytes. The reader trusts none of it.
namespace gpu_shading::decoding {

inline constexpr std::uint32_t message_mark = 0x31445347;  // "GSD1"

enum class Status : std::uint32_t { done = 0, failed = 1 };

inline constexpr std::size_t max_message_bytes = 400;
inline constexpr std::size_t max_name_bytes = 4096;  // of a mesh or a material; longer ones are cut

class DecodedMessage {
 public:
  explicit DecodedMessage(int descriptor) : descriptor_(descriptor) {}

  // The first value of either is preceded by mark and status. They throw std::system_error.
  template <typename Value>
  void put(Value value) {
    static_assert(std::is_arithmetic_v<Value>);
    begin(Status::done);
    write(&value, sizeof value);
  }
  template <typename Value>
  void put_all(std::vector<Value> const& values) {
    static_assert(std::is_arithmetic_v<Value>);
    begin(Status::done);
    write(values.data(), values.size() * sizeof(Value));
  }
  void put_text(std::string_view text);

  // Only if nothing was put: returns whether that is so.
  bool fail(std::string_view why);

  void flush();

 private:
  void begin(Status status);
  void write(void const* bytes, std::size_t count);
  void send(char const* bytes, std::size_t count) const;

  int descriptor_;
  bool begun_ = false;
  std::vector<char> waiting_;
};

}  // namespace gpu_shading::decoding

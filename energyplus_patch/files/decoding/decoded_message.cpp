#include "files/decoding/decoded_message.h"

#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace gpu_shading::decoding {
namespace {

constexpr std::size_t max_waiting = std::size_t{1} << 16U;

}  // namespace

void DecodedMessage::put_text(std::string_view text) {
  text = text.substr(0, max_name_bytes);
  put(static_cast<std::uint32_t>(text.size()));
  write(text.data(), text.size());
}

bool DecodedMessage::fail(std::string_view why) {
  if (begun_) return false;
  why = why.substr(0, max_message_bytes);
  begin(Status::failed);
  auto const length = static_cast<std::uint32_t>(why.size());
  write(&length, sizeof length);
  write(why.data(), why.size());
  flush();
  return true;
}

void DecodedMessage::begin(Status status) {
  if (begun_) return;
  begun_ = true;
  waiting_.reserve(max_waiting);
  write(&message_mark, sizeof message_mark);
  write(&status, sizeof status);
}

void DecodedMessage::write(void const* bytes, std::size_t count) {
  auto const* const from = static_cast<char const*>(bytes);
  if (waiting_.size() + count > max_waiting) flush();
  if (count > max_waiting) {
    send(from, count);
  } else {
    waiting_.insert(waiting_.end(), from, from + count);
  }
}

void DecodedMessage::flush() {
  send(waiting_.data(), waiting_.size());
  waiting_.clear();
}

void DecodedMessage::send(char const* bytes, std::size_t count) const {
  while (count > 0) {
    auto const sent = ::write(descriptor_, bytes, count);
    if (sent < 0) {
      if (errno == EINTR) continue;
      throw std::system_error(errno, std::generic_category());
    }
    bytes += sent;
    count -= static_cast<std::size_t>(sent);
  }
}

}  // namespace gpu_shading::decoding

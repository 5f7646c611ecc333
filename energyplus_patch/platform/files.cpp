#include "platform/files.h"

#include <fmt/format.h>

#include <cctype>

#include "gpu_shading/error.h"
#include "platform/staged_files.h"

namespace gpu_shading::energyplus {

void require_file(std::filesystem::path const& path) {
  if (!std::filesystem::exists(path)) {
    throw Error(fmt::format("{}: {}", path.string(),
                            std::filesystem::is_symlink(path)
                                ? "is a link to a file that does not exist"
                                : "no such file"));
  }
  if (!std::filesystem::is_regular_file(path)) {
    throw Error(fmt::format("{}: is not a file", path.string()));
  }
}

void write_whole_file(std::filesystem::path const& path,
                      std::function<void(std::ostream&)> const& write) {
  StagedFiles files(path.parent_path());
  files.write(path.filename().string(), write);
  files.commit();
}

void require_room(std::filesystem::path const& folder) {
  constexpr std::size_t bytes = 4096;
  write_whole_file(folder / "room.txt", [](std::ostream& out) { out << std::string(bytes, '.'); });
}

namespace {

constexpr std::size_t max_bytes = 200;  // file systems allow 255, with what follows

struct Character {
  std::uint32_t code;
  std::size_t bytes;  // 0: not UTF-8
};

// The character that begins a text which is not empty (RFC 3629).
Character first_of(std::string_view text) {
  auto const byte = [&](std::size_t i) {
    return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i]));
  };
  auto const first = byte(0);
  if (first < 0x80) return {first, 1};
  std::size_t const bytes = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < bytes) return {0, 0};
  constexpr unsigned bits = 6;  // of each byte that follows
  auto code = first & (0x7fU >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xc0U) != 0x80) return {0, 0};
    code = (code << bits) | (byte(i) & 0x3fU);
  }
  constexpr std::uint32_t min_code[] = {0, 0, 0x80, 0x800, 0x10000};
  bool const is_surrogate = code >= 0xd800 && code <= 0xdfff;
  if (code < min_code[bytes] || is_surrogate || code > 0x10ffff) return {0, 0};
  return {code, bytes};
}

// Control characters, and what stands for spaces and the direction of writing, mislead a reader.
bool is_kept(std::uint32_t code) {
  if (code < 0x80) return std::isalnum(static_cast<int>(code)) != 0 || code == '-' || code == '.';
  bool const is_control = code <= 0xa0;
  bool const is_format = (code >= 0x2000 && code <= 0x206f) || code == 0x3000 || code == 0xfeff ||
                         code == 0x61c || code == 0x180e || (code >= 0xfff0 && code <= 0xffff) ||
                         code >= 0xe0000;
  return !is_control && !is_format;
}

}  // namespace

std::string FileNames::add(std::string_view text, std::string_view ending) {
  std::string stem;
  while (!text.empty()) {
    auto const [code, bytes] = first_of(text);
    auto const length = bytes == 0 ? 1 : bytes;
    if (stem.size() + length > max_bytes) break;
    // A hidden file, or an option of a command.
    bool const misleads = (code == '.' || code == '-') && stem.empty();
    if (bytes > 0 && is_kept(code) && !misleads) {
      stem += text.substr(0, bytes);
    } else {
      stem += '_';
    }
    text.remove_prefix(length);
  }
  auto name = fmt::format("{}{}", stem, ending);
  for (int number = 2; !given_.insert(name).second; ++number) {
    name = fmt::format("{}_{}{}", stem, number, ending);
  }
  return name;
}

}  // namespace gpu_shading::energyplus

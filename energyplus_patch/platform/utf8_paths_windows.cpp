#include <windows.h>

#include <locale>

// MinGW's std::filesystem::path gives text as UTF-8, but reads it by the C locale, which takes
// every byte for a character. The linker puts this function in the place of the one that it reads
// text by
// (--wrap in CMakeLists.txt), so that paths are UTF-8 both ways.

namespace gpu_shading::energyplus {
namespace {

// The number of UTF-16 units; 0 where the text is not of the code page.
int convert(unsigned page, char const* text, int bytes, wchar_t* to, int units) {
  DWORD const flags = page == CP_UTF8 ? MB_ERR_INVALID_CHARS : 0;
  return MultiByteToWideChar(page, flags, text, bytes, to, units);
}

}  // namespace

// As std::codecvt<wchar_t, char, int>::do_in. A model's text may be in the system's code page.
std::codecvt_base::result read_path_text(
    void const* /*facet*/, int& /*state*/, char const* from, char const* from_end,
    char const*& from_next, wchar_t* to, wchar_t* to_end,
    wchar_t*& to_next) asm("__wrap__ZNKSt7codecvtIwciE5do_inERiPKcS3_RS3_PwS5_RS5_");

std::codecvt_base::result read_path_text(void const* /*facet*/, int& /*state*/, char const* from,
                                         char const* from_end, char const*& from_next, wchar_t* to,
                                         wchar_t* to_end, wchar_t*& to_next) {
  auto const bytes = static_cast<int>(from_end - from);
  auto const room = static_cast<int>(to_end - to);
  from_next = from;
  to_next = to;
  if (bytes == 0) return std::codecvt_base::ok;
  if (room < bytes) return std::codecvt_base::partial;  // no byte becomes more than one unit
  int units = convert(CP_UTF8, from, bytes, to, room);
  if (units == 0) units = convert(CP_ACP, from, bytes, to, room);
  if (units == 0) return std::codecvt_base::error;
  from_next = from_end;
  to_next = to + units;
  return std::codecvt_base::ok;
}

}  // namespace gpu_shading::energyplus

// Preloaded into a program: makes one of its calls fail, and all later ones of the kind where the
// disk stays full.
//   FAIL_CALL   open, write, fsync, rename or mkdir
//   FAIL_NTH    which of each process's calls, from 1
//   FAIL_UNDER  only calls about files in or below this folder count
//   FAIL_COUNT  a file that gets a byte for each call that counts

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

template <typename Function>
Function* next(char const* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

bool is_wanted(char const* call) {
  char const* const wanted = std::getenv("FAIL_CALL");
  return wanted != nullptr && std::strcmp(wanted, call) == 0;
}

bool is_under(char const* path) {
  char const* const folder = std::getenv("FAIL_UNDER");
  if (folder == nullptr) return true;
  return std::strncmp(path, folder, std::strlen(folder)) == 0;
}

bool is_file_under(int file) {
  std::array<char, 64> link{};
  std::snprintf(link.data(), link.size(), "/proc/self/fd/%d", file);
  std::array<char, PATH_MAX> path{};
  return readlink(link.data(), path.data(), path.size() - 1) > 0 && is_under(path.data());
}

// Whether this call is to fail.
bool fails() {
  static std::atomic<long> calls{0};
  if (char const* const counted = std::getenv("FAIL_COUNT")) {
    static auto* const real_open = next<int(char const*, int, ...)>("open");
    static auto* const real_write = next<ssize_t(int, void const*, size_t)>("write");
    int const file = real_open(counted, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
    real_write(file, "x", 1);
    close(file);
  }
  char const* const number = std::getenv("FAIL_NTH");
  return number != nullptr && ++calls >= std::atol(number);
}

bool is_to_write(int flags) { return (flags & O_ACCMODE) != O_RDONLY; }

template <typename Open>
int open_or_fail(char const* path, int flags, Open const& open_it) {
  if (is_to_write(flags) && is_wanted("open") && is_under(path) && fails()) {
    errno = ENOSPC;
    return -1;
  }
  return open_it();
}

bool refuses_to_write(int file) {
  if (!is_wanted("write") || !is_file_under(file) || !fails()) return false;
  errno = ENOSPC;
  return true;
}

mode_t mode_of(int flags, va_list arguments) {
  return (flags & O_CREAT) != 0 ? va_arg(arguments, mode_t) : 0;
}

}  // namespace

extern "C" {

int open(char const* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  mode_t const mode = mode_of(flags, arguments);
  va_end(arguments);
  return open_or_fail(path, flags,
                      [&] { return next<int(char const*, int, ...)>("open")(path, flags, mode); });
}

int open64(char const* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  mode_t const mode = mode_of(flags, arguments);
  va_end(arguments);
  return open_or_fail(
      path, flags, [&] { return next<int(char const*, int, ...)>("open64")(path, flags, mode); });
}

FILE* fopen64(char const* path, char const* mode) {
  bool const writes = std::strchr(mode, 'r') == nullptr;
  if (writes && is_wanted("open") && is_under(path) && fails()) {
    errno = ENOSPC;
    return nullptr;
  }
  return next<FILE*(char const*, char const*)>("fopen64")(path, mode);
}

ssize_t write(int file, void const* bytes, size_t count) {
  if (refuses_to_write(file)) return -1;
  static auto* const real = next<ssize_t(int, void const*, size_t)>("write");
  return real(file, bytes, count);
}

ssize_t writev(int file, iovec const* parts, int count) {
  if (refuses_to_write(file)) return -1;
  static auto* const real = next<ssize_t(int, iovec const*, int)>("writev");
  return real(file, parts, count);
}

ssize_t sendfile64(int to, int from, off64_t* offset, size_t count) {
  if (refuses_to_write(to)) return -1;
  static auto* const real = next<ssize_t(int, int, off64_t*, size_t)>("sendfile64");
  return real(to, from, offset, count);
}

int fsync(int file) {
  if (is_wanted("fsync") && is_file_under(file) && fails()) {
    errno = EIO;
    return -1;
  }
  return next<int(int)>("fsync")(file);
}

int rename(char const* from, char const* to) {
  if (is_wanted("rename") && is_under(to) && fails()) {
    errno = EACCES;
    return -1;
  }
  return next<int(char const*, char const*)>("rename")(from, to);
}

int mkdir(char const* path, mode_t mode) {
  if (is_wanted("mkdir") && is_under(path) && fails()) {
    errno = ENOSPC;
    return -1;
  }
  return next<int(char const*, mode_t)>("mkdir")(path, mode);
}
}

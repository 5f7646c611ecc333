// Preloaded into a program: one of its calls of operator new throws std::bad_alloc. Only calls from
// our own code count, from main() on: nobody can catch what the program's static objects throw
// before, and what other libraries do without memory is not ours to promise.
//   FAIL_FOLDER   that of our programs
//   FAIL_PROGRAM  the name of the one in which a call fails
//   FAIL_NTH      which of its calls, from 1
//   FAIL_COUNT    a folder in which each process counts its calls: PROGRAM.PID, 64 bits

#include <dlfcn.h>
#include <fcntl.h>
#include <link.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <climits>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

namespace {

// In a file where one is asked for, so that the count outlives whatever ends the process.
class Calls {
 public:
  Calls() {
    char const* const name = program();
    if (name == nullptr) return;
    char const* const wanted = std::getenv("FAIL_PROGRAM");
    char const* const number = std::getenv("FAIL_NTH");
    if (wanted != nullptr && number != nullptr && std::strcmp(wanted, name) == 0) {
      failing_ = std::strtoull(number, nullptr, 10);
    }
    if (char const* const folder = std::getenv("FAIL_COUNT")) count_in(folder, name);
  }

  bool fails() { return ++*count_ == failing_; }

 private:
  using Count = std::atomic<std::uint64_t>;

  // nullptr if it is not ours.
  static char const* program() {
    static std::array<char, PATH_MAX> path{};
    char const* const ours = std::getenv("FAIL_FOLDER");
    if (ours == nullptr || readlink("/proc/self/exe", path.data(), path.size() - 1) < 0) {
      return nullptr;
    }
    char* const slash = std::strrchr(path.data(), '/');
    if (slash == nullptr) return nullptr;
    *slash = '\0';
    return std::strcmp(path.data(), ours) == 0 ? slash + 1 : nullptr;
  }

  void count_in(char const* folder, char const* name) {
    std::array<char, std::size_t{3} * PATH_MAX> path{};
    std::snprintf(path.data(), path.size(), "%s/%s.%d", folder, name, getpid());
    int const file = open(path.data(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (file < 0 || ftruncate(file, sizeof(Count)) != 0) return;
    void* const shared = mmap(nullptr, sizeof(Count), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    close(file);
    if (shared != MAP_FAILED) count_ = static_cast<Count*>(shared);
  }

  Count own_{0};
  Count* count_ = &own_;
  std::uint64_t failing_ = 0;
};

bool is_ours(void* caller) {
  dl_find_object found{};
  if (_dl_find_object(caller, &found) != 0 || found.dlfo_link_map == nullptr) return false;
  char const* const path = found.dlfo_link_map->l_name;
  if (path == nullptr) return false;
  char const* const slash = std::strrchr(path, '/');
  char const* const name = slash == nullptr ? path : slash + 1;
  // A program itself has no name.
  return *name == '\0' || std::strstr(name, "gpu_shading") != nullptr;
}

using Main = int(int, char**, char**);
Main* program_main = nullptr;
std::atomic<bool> begun = false;

int begin(int count, char** arguments, char** variables) {
  begun = true;
  return program_main(count, arguments, variables);
}

// Throws if this call is the one to fail.
void count(void* caller) {
  if (!begun || !is_ours(caller)) return;
  static Calls calls;
  if (calls.fails()) throw std::bad_alloc();
}

void* allocate(std::size_t size) {
  void* const memory = std::malloc(size == 0 ? 1 : size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void* allocate(std::size_t size, std::align_val_t alignment) {
  auto const step = static_cast<std::size_t>(alignment);
  void* const memory = std::aligned_alloc(step, (size + step - 1) / step * step);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

// What calls main().
extern "C" int __libc_start_main(Main* main, int count, char** arguments, Main* init,
                                 void (*fini)(), void (*loader_fini)(), void* stack_end) {
  program_main = main;
  auto* const real =
      reinterpret_cast<decltype(&__libc_start_main)>(dlsym(RTLD_NEXT, "__libc_start_main"));
  return real(begin, count, arguments, init, fini, loader_fini, stack_end);
}

void* operator new(std::size_t size) {
  count(__builtin_return_address(0));
  return allocate(size);
}

void* operator new[](std::size_t size) {
  count(__builtin_return_address(0));
  return allocate(size);
}

void* operator new(std::size_t size, std::align_val_t alignment) {
  count(__builtin_return_address(0));
  return allocate(size, alignment);
}

void* operator new[](std::size_t size, std::align_val_t alignment) {
  count(__builtin_return_address(0));
  return allocate(size, alignment);
}

void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t /*size*/) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t /*size*/) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t /*alignment*/) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t /*size*/,
                       std::align_val_t /*alignment*/) noexcept {
  std::free(memory);
}

#include "files/decoding/sandbox.h"

#include <fcntl.h>
#include <linux/landlock.h>
#include <sched.h>
#include <seccomp.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <memory>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "files/decoding/landlock.h"

namespace gpu_shading::decoding {
namespace {

[[noreturn]] void refuse(char const* call, int error) {
  throw std::system_error(error, std::generic_category(),
                          std::string("the decoding process cannot give up its rights: ") + call);
}

void limit(int resource, std::uint64_t soft, std::uint64_t hard) {
  rlimit before{};
  getrlimit(static_cast<__rlimit_resource>(resource), &before);
  rlimit const now{std::min<rlim_t>(soft, before.rlim_max),
                   std::min<rlim_t>(hard, before.rlim_max)};
  if (setrlimit(static_cast<__rlimit_resource>(resource), &now) != 0) {
    refuse("setrlimit", errno);
  }
}

class Descriptor {
 public:
  explicit Descriptor(int value) : value_(value) {}
  Descriptor(Descriptor const&) = delete;
  Descriptor& operator=(Descriptor const&) = delete;
  ~Descriptor() {
    if (value_ >= 0) close(value_);
  }
  int get() const { return value_; }

 private:
  int value_;
};

// What cannot be permitted stays forbidden.
void permit_reading(int ruleset, int what) {
  landlock_path_beneath_attr const rule{LANDLOCK_ACCESS_FS_READ_FILE, what};
  syscall(SYS_landlock_add_rule, ruleset, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
}

void forbid_files(int input, std::optional<Readable> const& readable) {
  auto const version = landlock_version();
  if (version < 1) return;  // the run warns: take_unconfined_decoding()
  constexpr int with_refer = 2;
  constexpr int with_truncate = 3;
  constexpr std::uint64_t refer = std::uint64_t{1} << 13U;
  constexpr std::uint64_t truncate = std::uint64_t{1} << 14U;
  constexpr std::uint64_t first_version = refer - 1;
  constexpr std::uint64_t reading = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
  landlock_ruleset_attr handled{};
  handled.handled_access_fs = first_version;
  if (version >= with_refer) handled.handled_access_fs |= refer;
  if (version >= with_truncate) handled.handled_access_fs |= truncate;
  if (!readable) handled.handled_access_fs &= ~reading;
  Descriptor const ruleset(
      static_cast<int>(syscall(SYS_landlock_create_ruleset, &handled, sizeof handled, 0)));
  if (ruleset.get() < 0) refuse("landlock_create_ruleset", errno);
  if (readable) {
    permit_reading(ruleset.get(), input);
    if (!readable->folder.empty()) {
      Descriptor const folder(open(readable->folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
      permit_reading(ruleset.get(), folder.get());
    }
  }
  if (syscall(SYS_landlock_restrict_self, ruleset.get(), 0) != 0) {
    refuse("landlock_restrict_self", errno);
  }
}

void require(int result, char const* call) {
  if (result >= 0) return;
  if (result == -ENOMEM) throw std::bad_alloc();
  refuse(call, -result);
}

// What is not named fails with ENOSYS, which libraries take for an older kernel.
class Filter {
 public:
  Filter() : context_(seccomp_init(SCMP_ACT_ERRNO(ENOSYS)), seccomp_release) {
    if (!context_) throw std::bad_alloc();
    require(seccomp_attr_set(context_.get(), SCMP_FLTATR_ACT_BADARCH, SCMP_ACT_KILL_PROCESS),
            "seccomp_attr_set");
  }

  void permit(int call) { add(call, {}); }

  // If (argument & mask) == wanted.
  void permit_if(int call, unsigned argument, std::uint64_t mask, std::uint64_t wanted) {
    add(call, {scmp_arg_cmp{argument, SCMP_CMP_MASKED_EQ, mask, wanted}});
  }

  void install() { require(seccomp_load(context_.get()), "seccomp_load"); }

 private:
  void add(int call, std::vector<scmp_arg_cmp> const& conditions) {
    auto const count = static_cast<unsigned>(conditions.size());
    require(seccomp_rule_add_array(context_.get(), SCMP_ACT_ALLOW, call, count, conditions.data()),
            "seccomp_rule_add");
  }

  std::unique_ptr<void, decltype(&seccomp_release)> context_;
};

void forbid_calls() {
  // Reading, memory, threads, time and the end.
  constexpr std::array permitted{SCMP_SYS(read),
                                 SCMP_SYS(pread64),
                                 SCMP_SYS(readv),
                                 SCMP_SYS(preadv),
                                 SCMP_SYS(lseek),
                                 SCMP_SYS(write),
                                 SCMP_SYS(writev),
                                 SCMP_SYS(close),
                                 SCMP_SYS(fstat),
                                 SCMP_SYS(stat),
                                 SCMP_SYS(lstat),
                                 SCMP_SYS(newfstatat),
                                 SCMP_SYS(statx),
                                 SCMP_SYS(access),
                                 SCMP_SYS(faccessat),
                                 SCMP_SYS(faccessat2),
                                 SCMP_SYS(readlink),
                                 SCMP_SYS(readlinkat),
                                 SCMP_SYS(getcwd),
                                 SCMP_SYS(getdents64),
                                 SCMP_SYS(fadvise64),
                                 SCMP_SYS(poll),
                                 SCMP_SYS(mmap),
                                 SCMP_SYS(munmap),
                                 SCMP_SYS(mprotect),
                                 SCMP_SYS(mremap),
                                 SCMP_SYS(brk),
                                 SCMP_SYS(madvise),
                                 SCMP_SYS(futex),
                                 SCMP_SYS(set_robust_list),
                                 SCMP_SYS(rseq),
                                 SCMP_SYS(sched_yield),
                                 SCMP_SYS(sched_getaffinity),
                                 SCMP_SYS(getcpu),
                                 SCMP_SYS(gettid),
                                 SCMP_SYS(getpid),
                                 SCMP_SYS(getppid),
                                 SCMP_SYS(getuid),
                                 SCMP_SYS(geteuid),
                                 SCMP_SYS(getgid),
                                 SCMP_SYS(getegid),
                                 SCMP_SYS(getrusage),
                                 SCMP_SYS(getrlimit),
                                 SCMP_SYS(sysinfo),
                                 SCMP_SYS(uname),
                                 SCMP_SYS(getrandom),
                                 SCMP_SYS(clock_gettime),
                                 SCMP_SYS(clock_getres),
                                 SCMP_SYS(clock_nanosleep),
                                 SCMP_SYS(nanosleep),
                                 SCMP_SYS(gettimeofday),
                                 SCMP_SYS(time),
                                 SCMP_SYS(rt_sigaction),
                                 SCMP_SYS(rt_sigprocmask),
                                 SCMP_SYS(rt_sigreturn),
                                 SCMP_SYS(sigaltstack),
                                 SCMP_SYS(restart_syscall),
                                 SCMP_SYS(exit),
                                 SCMP_SYS(exit_group)};
  Filter filter;
  for (auto const call : permitted) filter.permit(call);
  constexpr unsigned changing = O_ACCMODE | O_CREAT | O_TRUNC | O_APPEND;
  constexpr unsigned first = 0;
  constexpr unsigned second = 1;
  constexpr unsigned third = 2;
  filter.permit_if(SCMP_SYS(open), second, changing, O_RDONLY);
  filter.permit_if(SCMP_SYS(openat), third, changing, O_RDONLY);
  filter.permit_if(SCMP_SYS(clone), first, CLONE_THREAD, CLONE_THREAD);
  filter.permit_if(SCMP_SYS(tgkill), first, ~0U, static_cast<unsigned>(getpid()));
  // Others let the kernel signal another process, or change a file description that others have.
  for (auto const command : {F_GETFD, F_SETFD, F_GETFL}) {
    filter.permit_if(SCMP_SYS(fcntl), second, ~0U, static_cast<unsigned>(command));
  }
  filter.install();
}

}  // namespace

void end_with(int parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);
}

void confine(Limits const& limits, int input, std::optional<Readable> const& readable) {
  limit(RLIMIT_CORE, 0, 0);
  signal(SIGXFSZ, SIG_IGN);  // a write that the next limit forbids is an error, and not the end
  limit(RLIMIT_FSIZE, 0, 0);
  limit(RLIMIT_CPU, limits.seconds, limits.seconds + 1);
  if constexpr (limits_memory) limit(RLIMIT_AS, limits.memory, limits.memory);
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) refuse("PR_SET_NO_NEW_PRIVS", errno);
  forbid_files(input, readable);
  forbid_calls();
}

}  // namespace gpu_shading::decoding

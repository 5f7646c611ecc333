#include "decoding/sandbox.h"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <system_error>
#include <vector>

namespace gpu_shading::decoding {
namespace {

void limit(int resource, std::uint64_t soft, std::uint64_t hard) {
  rlimit before{};
  getrlimit(static_cast<__rlimit_resource>(resource), &before);
  rlimit const now{std::min<rlim_t>(soft, before.rlim_max),
                   std::min<rlim_t>(hard, before.rlim_max)};
  if (setrlimit(static_cast<__rlimit_resource>(resource), &now) != 0) {
    throw std::system_error(errno, std::generic_category(), "setrlimit");
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

void permit_reading(int ruleset, int what) {
  landlock_path_beneath_attr const rule{LANDLOCK_ACCESS_FS_READ_FILE, what};
  syscall(SYS_landlock_add_rule, ruleset, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
}

void forbid_files(int input, std::optional<Readable> const& readable) {
  auto const version =
      syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  if (version < 1) return;
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
  if (ruleset.get() < 0) return;
  if (readable) {
    permit_reading(ruleset.get(), input);
    if (!readable->folder.empty()) {
      Descriptor const folder(open(readable->folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
      permit_reading(ruleset.get(), folder.get());
    }
  }
  syscall(SYS_landlock_restrict_self, ruleset.get(), 0);
}

#ifdef __x86_64__

// A filter of system calls. What it does not name fails with ENOSYS, which libraries take for an
// older kernel.
class Filter {
 public:
  Filter() {
    load(offsetof(seccomp_data, arch));
    program_.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, AUDIT_ARCH_X86_64, 1, 0));
    give(SECCOMP_RET_KILL_PROCESS);
    load(offsetof(seccomp_data, nr));
  }

  void permit(long call) {
    program_.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<unsigned>(call), 0, 1));
    give(SECCOMP_RET_ALLOW);
  }

  // If (argument & mask) == wanted; otherwise it fails with EACCES.
  void permit_if(long call, std::size_t argument, unsigned mask, unsigned wanted) {
    constexpr unsigned char rest = 5;
    program_.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<unsigned>(call), 0, rest));
    load(offsetof(seccomp_data, args) + argument * sizeof(std::uint64_t));
    program_.push_back(BPF_STMT(BPF_ALU | BPF_AND | BPF_K, mask));
    program_.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, wanted, 0, 1));
    give(SECCOMP_RET_ALLOW);
    give(SECCOMP_RET_ERRNO | EACCES);
  }

  void install() {
    give(SECCOMP_RET_ERRNO | ENOSYS);
    sock_fprog const all{static_cast<unsigned short>(program_.size()), program_.data()};
    prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &all);
  }

 private:
  void load(std::size_t offset) {
    program_.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<unsigned>(offset)));
  }
  void give(unsigned result) { program_.push_back(BPF_STMT(BPF_RET | BPF_K, result)); }

  std::vector<sock_filter> program_;
};

void forbid_calls() {
  // Reading, memory, threads, time and the end.
  constexpr std::array permitted{SYS_read,
                                 SYS_pread64,
                                 SYS_readv,
                                 SYS_preadv,
                                 SYS_lseek,
                                 SYS_write,
                                 SYS_writev,
                                 SYS_close,
                                 SYS_fstat,
                                 SYS_stat,
                                 SYS_lstat,
                                 SYS_newfstatat,
                                 SYS_statx,
                                 SYS_access,
                                 SYS_faccessat,
                                 SYS_faccessat2,
                                 SYS_readlink,
                                 SYS_readlinkat,
                                 SYS_getcwd,
                                 SYS_getdents64,
                                 SYS_fcntl,
                                 SYS_fadvise64,
                                 SYS_poll,
                                 SYS_mmap,
                                 SYS_munmap,
                                 SYS_mprotect,
                                 SYS_mremap,
                                 SYS_brk,
                                 SYS_madvise,
                                 SYS_futex,
                                 SYS_set_robust_list,
                                 SYS_rseq,
                                 SYS_sched_yield,
                                 SYS_sched_getaffinity,
                                 SYS_getcpu,
                                 SYS_gettid,
                                 SYS_getpid,
                                 SYS_getppid,
                                 SYS_getuid,
                                 SYS_geteuid,
                                 SYS_getgid,
                                 SYS_getegid,
                                 SYS_getrusage,
                                 SYS_getrlimit,
                                 SYS_sysinfo,
                                 SYS_uname,
                                 SYS_getrandom,
                                 SYS_clock_gettime,
                                 SYS_clock_getres,
                                 SYS_clock_nanosleep,
                                 SYS_nanosleep,
                                 SYS_gettimeofday,
                                 SYS_time,
                                 SYS_rt_sigaction,
                                 SYS_rt_sigprocmask,
                                 SYS_rt_sigreturn,
                                 SYS_sigaltstack,
                                 SYS_restart_syscall,
                                 SYS_exit,
                                 SYS_exit_group};
  Filter filter;
  for (auto const call : permitted) filter.permit(call);
  constexpr unsigned changing = O_ACCMODE | O_CREAT | O_TRUNC | O_APPEND;
  constexpr std::size_t second = 1;
  constexpr std::size_t third = 2;
  filter.permit_if(SYS_open, second, changing, O_RDONLY);
  filter.permit_if(SYS_openat, third, changing, O_RDONLY);
  filter.permit_if(SYS_clone, 0, CLONE_THREAD, CLONE_THREAD);
  filter.permit_if(SYS_tgkill, 0, ~0U, static_cast<unsigned>(getpid()));
  filter.install();
}

#else

void forbid_calls() {}

#endif

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
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  forbid_files(input, readable);
  forbid_calls();
}

}  // namespace gpu_shading::decoding

#include <errno.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "io/import_cell.h"

#if defined(__x86_64__)
#define SKINFORGE_AUDIT_ARCH AUDIT_ARCH_X86_64
#elif defined(__aarch64__)
#define SKINFORGE_AUDIT_ARCH AUDIT_ARCH_AARCH64
#endif

namespace skinforge {

#ifdef SKINFORGE_AUDIT_ARCH
namespace {

/// What the C library needs to compute, to ask for memory, to run threads and to end; and to read and write
/// what is open.
constexpr long kAllowed[] = {SYS_read,
                             SYS_write,
                             SYS_readv,
                             SYS_writev,
                             SYS_lseek,
                             SYS_close,
                             SYS_fstat,
                             SYS_brk,
                             SYS_mmap,
                             SYS_munmap,
                             SYS_mremap,
                             SYS_mprotect,
                             SYS_madvise,
                             SYS_futex,
                             SYS_set_robust_list,
                             SYS_rseq,
                             SYS_gettid,
                             SYS_getpid,
                             SYS_sched_yield,
                             SYS_sched_getaffinity,
                             SYS_clock_gettime,
                             SYS_clock_getres,
                             SYS_gettimeofday,
                             SYS_getrandom,
                             SYS_sysinfo,
                             SYS_getrusage,
                             SYS_rt_sigaction,
                             SYS_rt_sigprocmask,
                             SYS_rt_sigreturn,
                             SYS_sigaltstack,
                             SYS_exit,
                             SYS_exit_group,
                             SYS_restart_syscall};

constexpr std::uint32_t at_argument(std::size_t i) {
  return static_cast<std::uint32_t>(offsetof(seccomp_data, args) + 8 * i);  // its low half, little-endian
}

/// A program of the kernel's packet filter (Linux, seccomp_filter.rst); it sees the number of a call and its
/// arguments, and gives what is to be done.
class Filter {
 public:
  void load(std::size_t offset) { add(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset)); }
  void finish(std::uint32_t action) { add(BPF_RET | BPF_K, action); }
  /// `action` where the loaded word is `value`.
  void if_equal(std::uint32_t value, std::uint32_t action) {
    add(BPF_JMP | BPF_JEQ | BPF_K, value, 0, 1);
    finish(action);
  }
  void unless_equal(std::uint32_t value, std::uint32_t action) {
    add(BPF_JMP | BPF_JEQ | BPF_K, value, 1, 0);
    finish(action);
  }
  /// Where the call is `number`: allowed when argument `i`, masked, is `wanted`.
  void if_argument(long number, std::size_t i, std::uint32_t mask, std::uint32_t wanted) {
    constexpr std::uint8_t kLength = 5;
    add(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(number), 0, kLength);
    load(at_argument(i));
    add(BPF_ALU | BPF_AND | BPF_K, mask);
    if_equal(wanted, SECCOMP_RET_ALLOW);
    finish(SECCOMP_RET_ERRNO | EPERM);
  }
  bool install() {
    const sock_fprog program{static_cast<unsigned short>(steps_.size()), steps_.data()};
    return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
           ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program, 0, 0) == 0;
  }

 private:
  void add(unsigned code, std::uint32_t value, std::uint8_t if_true = 0, std::uint8_t if_false = 0) {
    steps_.push_back({static_cast<std::uint16_t>(code), if_true, if_false, value});
  }

  std::vector<sock_filter> steps_;
};

}  // namespace

bool allow_only_computing() {
  Filter filter;
  filter.load(offsetof(seccomp_data, arch));
  filter.unless_equal(SKINFORGE_AUDIT_ARCH, SECCOMP_RET_KILL_PROCESS);  // its numbers mean other calls
  filter.load(offsetof(seccomp_data, nr));
  for (const long call : kAllowed) filter.if_equal(static_cast<std::uint32_t>(call), SECCOMP_RET_ALLOW);
  // The arguments of clone3 are out of sight; without it the C library takes clone.
  filter.if_equal(SYS_clone3, SECCOMP_RET_ERRNO | ENOSYS);
  filter.if_argument(SYS_clone, 0, CLONE_THREAD, CLONE_THREAD);
  filter.if_argument(SYS_tgkill, 0, ~0U, static_cast<std::uint32_t>(::getpid()));  // abort()
  filter.finish(SECCOMP_RET_ERRNO | EPERM);
  return filter.install();
}
#else
bool allow_only_computing() {
  return false;
}
#endif

}  // namespace skinforge

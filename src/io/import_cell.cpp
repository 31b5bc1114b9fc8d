#include "io/import_cell.h"

#include <fcntl.h>
#include <malloc.h>
#include <pthread.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace skinforge {
namespace {

constexpr std::size_t kGuard = std::size_t{64} << 10;  // ours: beyond the frame of any function

void limit(int resource, std::size_t value) {
  rlimit both{};
  ::getrlimit(static_cast<__rlimit_resource>(resource), &both);
  both.rlim_cur = std::min<rlim_t>(value, both.rlim_max);
  ::setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

/// Bytes of address space that the process has now: libraries, above all.
std::size_t mapped_now() {
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  const int file = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  if (file < 0) return 0;
  char text[64] = {};
  const bool is_read = ::read(file, text, sizeof text - 1) > 0;
  ::close(file);
  return is_read ? static_cast<std::size_t>(std::strtoull(text, nullptr, 10)) * page : 0;
}

std::uintptr_t stack_begin = 0;  // lowest address of the thread of `run_on_stack`

/// A fault at the end of the stack is a limit that was reached; any other is a crash.
void on_fault(int number, siginfo_t* info, void*) {
  const auto at = reinterpret_cast<std::uintptr_t>(info->si_addr);
  if (at + kGuard >= stack_begin && at < stack_begin + kGuard) ::_exit(kOutOfStack);
  ::signal(number, SIG_DFL);  // the instruction is tried again, and ends the process
}

/// Returns the signal stack of before, which belongs to the thread again before it ends: a sanitizer frees it.
stack_t watch_stack() {
  static char room[std::size_t{64} << 10];  // the handler cannot run on the stack that is full
  stack_t other{}, before{};
  other.ss_sp = room;
  other.ss_size = sizeof room;
  ::sigaltstack(&other, &before);
  pthread_attr_t attributes;
  void* begin = nullptr;
  std::size_t size = 0;
  if (::pthread_getattr_np(::pthread_self(), &attributes) != 0) return before;
  ::pthread_attr_getstack(&attributes, &begin, &size);
  ::pthread_attr_destroy(&attributes);
  stack_begin = reinterpret_cast<std::uintptr_t>(begin);
  struct sigaction action {};
  action.sa_sigaction = on_fault;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK;
  ::sigaction(SIGSEGV, &action, nullptr);
  return before;
}

struct Work {
  void (*work)(void*);
  void* data;
};

void* run_work(void* data) {
  const stack_t before = watch_stack();
  const auto* work = static_cast<Work*>(data);
  work->work(work->data);
  ::sigaltstack(&before, nullptr);
  return nullptr;
}

}  // namespace

void end_without_memory() {
  ::_exit(kOutOfMemory);
}

void enter_cell(const SandboxLimits& limits) {
  ::mallopt(M_ARENA_MAX, 1);  // a second arena would reserve 64 MB of the address space
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, static_cast<std::size_t>(limits.cpu_seconds));
  limit(RLIMIT_AS, mapped_now() + limits.address_space);
  limit(RLIMIT_NOFILE, 3);
  ::alarm(static_cast<unsigned>(limits.wall_seconds));
  allow_only_computing();
}

void run_on_stack(std::size_t bytes, void (*work)(void*), void* data) {
  Work job{work, data};
  pthread_attr_t attributes;
  pthread_t thread;
  ::pthread_attr_init(&attributes);
  ::pthread_attr_setstacksize(&attributes, bytes);
  ::pthread_attr_setguardsize(&attributes, kGuard);
  if (::pthread_create(&thread, &attributes, run_work, &job) != 0) end_without_memory();
  ::pthread_join(thread, nullptr);
  ::pthread_attr_destroy(&attributes);
}

}  // namespace skinforge

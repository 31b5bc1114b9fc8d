#include "io/sandbox.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <new>
#include <optional>

#include "base/error.h"
#include "base/text.h"
#include "io/assimp_library.h"
#include "io/assimp_reader.h"
#include "io/import_cell.h"
#include "io/raw_scene_check.h"

extern char** environ;

namespace skinforge {
namespace {

constexpr std::chrono::seconds kGrace{2};                 // ours: the child's own alarm comes first
constexpr std::uint64_t kMostSeconds = 1'000'000'000;     // what a clock can add
constexpr const char* kMark = "SKINFORGE_IMPORT_WORKER";  // in the environment of every worker

std::string& worker_path() {
  static std::string path = "/proc/self/exe";
  return path;
}

/// What the child is to do, and within which limits. No `fields` of `InputFile`: only here it crosses a
/// process.
struct Task {
  SandboxLimits limits;
  Limits of_scene;
  std::vector<InputFile> files;

  template <class Archive>
  friend void fields(Archive& a, Task& t) {
    a(t.limits.address_space, t.limits.stack, t.limits.cpu_seconds, t.limits.wall_seconds, t.of_scene);
    std::uint64_t count = t.files.size();
    a(count);
    t.files.resize(count);
    for (InputFile& file : t.files) a(file.path, file.bytes);
  }
};

/// Either an error or a scene.
struct Answer {
  std::string error;
  RawScene scene;

  template <class Archive>
  friend void fields(Archive& a, Answer& n) {
    a(n.error, n.scene);
  }
};

/// A descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor() { reset(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }
  void reset(int number = -1) {
    if (number_ >= 0) ::close(number_);
    number_ = number;
  }

 private:
  int number_;
};

[[noreturn]] void system_failed(const char* what) {
  throw Error(ExitCode::StageFailed, fmt::format("{}: {}", what, std::strerror(errno)));
}

void write_all(int descriptor, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t done = ::write(descriptor, bytes.data(), bytes.size());
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) system_failed("cannot write to the importer");
    bytes = bytes.subspan(static_cast<std::size_t>(done));
  }
}

using Clock = std::chrono::steady_clock;

/// Whether there is something to read before `deadline`.
bool wait_for_bytes(int descriptor, Clock::time_point deadline) {
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    pollfd request{descriptor, POLLIN, 0};
    constexpr long long kMost = std::numeric_limits<int>::max();
    const int ready = ::poll(&request, 1, static_cast<int>(std::clamp<long long>(left, 0, kMost)));
    if (ready > 0) return true;
    if (ready == 0) return false;
    if (errno != EINTR) system_failed("cannot listen to the importer");
  }
}

/// Up to `most` bytes; more are left unread. None when the end is not there by `deadline`.
std::optional<Bytes> read_all(int descriptor, std::size_t most,
                              Clock::time_point deadline = Clock::time_point::max()) {
  constexpr std::size_t kStep = std::size_t{1} << 20;
  Bytes bytes;
  std::size_t filled = 0;
  for (;;) {
    bytes.resize(std::max(bytes.size(), filled + kStep));
    if (deadline != Clock::time_point::max() && !wait_for_bytes(descriptor, deadline)) return std::nullopt;
    const ssize_t got = ::read(descriptor, bytes.data() + filled, bytes.size() - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) system_failed("cannot read from the importer");
    if (got == 0) break;
    filled += static_cast<std::size_t>(got);
    if (filled > most) break;
    if (filled == bytes.size()) bytes.resize(2 * filled);
  }
  bytes.resize(filled);
  return bytes;
}

// ---------------------------------------------------------------- the child

struct Job {
  const Task* task = nullptr;
  std::shared_ptr<void> source;  // not freed: the process ends after its answer
  Bytes answer;
};

void do_job(Job& job) {
  Answer answer;
  try {
    AssimpScene read = read_with_assimp(job.task->files);
    job.source = std::move(read.source);
    answer.scene = std::move(read.scene);
    job.answer = to_bytes(answer);
    return;
  } catch (const std::bad_alloc&) {
    end_without_memory();
  } catch (const std::exception& error) {
    answer.error = error.what();
  }
  job.answer = to_bytes(Answer{answer.error, {}});
}

void run_job(void* data) {
  do_job(*static_cast<Job*>(data));
}

// ---------------------------------------------------------------- the parent

/// The task as a file in memory, read position at its start.
void store(const Task& task, Descriptor& target) {
  target.reset(::memfd_create("skinforge-import", MFD_CLOEXEC));
  if (target.number() < 0) system_failed("cannot hand the file to the importer");
  write_all(target.number(), to_bytes(task));
  if (::lseek(target.number(), 0, SEEK_SET) != 0) system_failed("cannot hand the file to the importer");
}

/// A program that is started as a worker and imports in its own name does not know that it is one: it would
/// start itself again, and so on.
void refuse_in_worker() {
  if (std::getenv(kMark))
    throw Error(ExitCode::Internal,
                "this program was started as an import worker and does not answer --import-worker");
}

/// The environment, marked.
std::vector<char*> worker_environment(std::string& mark) {
  std::vector<char*> variables;
  for (char** variable = environ; *variable; ++variable) variables.push_back(*variable);
  variables.push_back(mark.data());
  variables.push_back(nullptr);
  return variables;
}

pid_t start_worker(const std::string& path, int task, int answer) {
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, task, STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, answer, STDOUT_FILENO);
  ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  ::posix_spawn_file_actions_addclosefrom_np(&actions, STDERR_FILENO + 1);
  std::string program = "skinforge", flag = "--import-worker", file = path;
  char* arguments[] = {program.data(), flag.data(), file.data(), nullptr};
  std::string mark = std::string(kMark) + "=1";
  pid_t child = 0;
  const int failure = ::posix_spawn(&child, worker_path().c_str(), &actions, nullptr, arguments,
                                    worker_environment(mark).data());
  ::posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) {
    errno = failure;
    system_failed("cannot start the importer");
  }
  return child;
}

int wait_for(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) system_failed("cannot wait for the importer");
  return status;
}

Error no_answer(const SandboxLimits& limits) {
  return {
      ExitCode::BadInput,
      fmt::format("importer did not answer for {} s; --limit import-wait=N gives more", limits.wall_seconds)};
}

std::string size_text(std::size_t bytes) {
  return bytes >> 20 > 0 ? fmt::format("{} MB", bytes >> 20) : fmt::format("{} KB", bytes >> 10);
}

/// How the child ended, unless well.
void check_end(int status, const SandboxLimits& limits) {
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  const int number = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  std::string how = fmt::format("importer crashed (signal {})", number);
  if (number == 0) how = fmt::format("importer ended with status {}", WEXITSTATUS(status));
  if (number == 0 && WEXITSTATUS(status) == kOutOfMemory)
    how = fmt::format("importer needs more than {} MB of memory; --limit import-memory=N gives more",
                      limits.address_space >> 20);
  if (number == 0 && WEXITSTATUS(status) == kOutOfStack)
    how = fmt::format("importer needs more than {} of stack; --limit import-stack=N gives more",
                      size_text(limits.stack));
  if (number == SIGXCPU || number == SIGKILL)
    how =
        fmt::format("importer took more than {} s; --limit import-seconds=N gives more", limits.cpu_seconds);
  if (number == SIGALRM) throw no_answer(limits);
  throw Error(ExitCode::BadInput, how);
}

Answer parse_answer(const Bytes& bytes) {
  try {
    return from_bytes<Answer>(bytes);
  } catch (const Error&) {
    throw Error(ExitCode::BadInput, "importer gave a broken answer");
  }
}

Answer ask_worker(const std::vector<InputFile>& files, const SandboxLimits& limits) {
  Descriptor task, answer_in, answer_out;
  store({limits, skinforge::limits(), files}, task);
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) system_failed("cannot listen to the importer");
  answer_in.reset(ends[0]);
  answer_out.reset(ends[1]);
  const pid_t child = start_worker(files.front().path, task.number(), answer_out.number());
  answer_out.reset();
  task.reset();
  const auto deadline =
      Clock::now() + std::chrono::seconds(std::min(limits.wall_seconds, kMostSeconds)) + kGrace;
  const auto bytes = read_all(answer_in.number(), limits.address_space, deadline);  // it had to fit in there
  answer_in.reset();
  if (!bytes) ::kill(child, SIGKILL);
  const int status = wait_for(child);
  if (!bytes) throw no_answer(limits);
  check_end(status, limits);
  return parse_answer(*bytes);
}

}  // namespace

RawScene read_in_child(const std::vector<InputFile>& files, const SandboxLimits& limits) {
  refuse_in_worker();
  return with_context(printable(files.front().path), [&] {
    Answer answer = ask_worker(files, limits);
    if (!answer.error.empty()) throw Error(ExitCode::BadInput, printable(answer.error));
    check_raw_scene(answer.scene);
    return std::move(answer.scene);
  });
}

void set_import_worker(std::string executable) {
  worker_path() = std::move(executable);
}

int import_worker_main(int, char**) {
  try {
    const auto task = from_bytes<Task>(*read_all(STDIN_FILENO, std::numeric_limits<std::size_t>::max()));
    set_limits(task.of_scene);
    if (task.files.empty()) return 1;
    std::set_new_handler(end_without_memory);
    load_assimp();  // in the cell no file can be opened any more
    enter_cell(task.limits);
    Job job{&task, {}, {}};
    run_on_stack(task.limits.stack, run_job, &job);
    write_all(STDOUT_FILENO, job.answer);
    ::_exit(0);
  } catch (const std::exception&) {
    return 1;
  }
}

}  // namespace skinforge

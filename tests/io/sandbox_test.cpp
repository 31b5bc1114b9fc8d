#include "io/sandbox.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/ptrace.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <optional>
#include <thread>

#include "base/archive.h"
#include "base/error.h"
#include "io/import_cell.h"
#include "testing/assets.h"
#include "testing/temporary_folder.h"

namespace skinforge {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

InputFile file_of(const std::string& path, const std::string& text) {
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  return {path, Bytes(begin, begin + text.size()), {}};
}

const char* const kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// The one-line message of a refusal, which must be the fault of the input.
std::string refusal(const std::vector<InputFile>& files, const SandboxLimits& limits = {}) {
  try {
    read_in_child(files, limits);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::BadInput);
    EXPECT_THAT(error.what(), ::testing::Not(HasSubstr("\n")));
    return error.what();
  }
  return "nothing was refused";
}

std::string refusal_of_shared(const std::string& path, const SandboxLimits& limits = {}) {
  return refusal(read_input_files(testing::shared_file(path)), limits);
}

/// Starts another program as the worker while it lives.
class OtherWorker {
 public:
  explicit OtherWorker(const char* program) { set_import_worker(program); }
  ~OtherWorker() { set_import_worker("/proc/self/exe"); }
};

TEST(Sandbox, HandsTheSceneBack) {
  const RawScene scene = read_in_child({file_of("some/folder/flat.obj", kTriangle)});
  ASSERT_EQ(scene.meshes.size(), 1u);
  ASSERT_EQ(scene.meshes[0].primitives.size(), 1u);
  EXPECT_EQ(scene.meshes[0].primitives[0].positions.size(), 3u);
}

TEST(Sandbox, PassesTheReadersMessageOn) {
  EXPECT_THAT(refusal({file_of("some/folder/bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n")}),
              StartsWith("some/folder/bad.obj: "));
}

TEST(Sandbox, UnknownFormatIsOneLine) {
  EXPECT_THAT(refusal({file_of("notes.docx", "nothing of the kind")}), StartsWith("notes.docx: "));
}

/// A program of the shell that is started as the worker.
class ScriptWorker {
 public:
  explicit ScriptWorker(const std::string& commands) {
    const std::filesystem::path path = folder_ / "worker";
    std::ofstream(path) << "#!/bin/sh\n" << commands << "\n";
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    worker_.emplace(path.c_str());
  }

 private:
  testing::TemporaryFolder folder_;
  std::optional<OtherWorker> worker_;
};

TEST(Sandbox, CrashIsOneLine) {
  const ScriptWorker worker("kill -SEGV $$");
  EXPECT_EQ(refusal({file_of("flat.obj", kTriangle)}), "flat.obj: importer crashed (signal 11)");
}

/// A COLLADA document with these nodes as its scene.
std::string scene_of(const std::string& nodes) {
  return "<COLLADA version=\"1.4.1\"><library_visual_scenes><visual_scene id=\"s\">" + nodes +
         "</visual_scene></library_visual_scenes><scene><instance_visual_scene "
         "url=\"#s\"/></scene></COLLADA>";
}

// A node that contains itself runs Assimp out of any stack; our check reads no single quotes.
TEST(Sandbox, EndlessRecursionIsOneLine) {
  const std::string cycle = "<node id='a' name='a'><instance_node url='#a'/></node>";
  EXPECT_EQ(refusal({file_of("cycle.dae", scene_of(cycle))}),
            "cycle.dae: importer needs more than 512 MB of stack; --limit import-stack=N gives more");
}

/// Nodes inside each other, so many levels deep.
std::string nested_nodes(int levels) {
  std::string nodes;
  for (int i = 0; i < levels; ++i) nodes += fmt::format("<node id=\"n{0}\" name=\"n{0}\">", i);
  for (int i = 0; i < levels; ++i) nodes += "</node>";
  return scene_of(nodes);
}

TEST(Sandbox, StackLimitIsOneLine) {
  SandboxLimits limits;
  const auto file = file_of("deep.dae", nested_nodes(1000));
  EXPECT_GE(read_in_child({file}, limits).nodes.size(), 1000u);
  limits.stack = std::size_t{128} << 10;
  EXPECT_EQ(refusal({file}, limits),
            "deep.dae: importer needs more than 128 KB of stack; --limit import-stack=N gives more");
}

TEST(Sandbox, AWorkerThatSleepsIsNotWaitedFor) {
  SandboxLimits limits;
  limits.wall_seconds = 0;
  {
    const ScriptWorker worker("exec sleep 60");
    EXPECT_EQ(refusal({file_of("flat.obj", kTriangle)}, limits),
              "flat.obj: importer did not answer for 0 s; --limit import-wait=N gives more");
  }
  limits.wall_seconds = 60;
  EXPECT_EQ(read_in_child({file_of("flat.obj", kTriangle)}, limits).meshes.size(), 1u);
}

/// What is left to a process behind the filter: the number of the first wrong answer, 0 when all are right.
int first_wrong_answer(pid_t parent, int pipe) {
  if (!allow_only_computing()) return 100;
  const auto is_refused = [](long answer) { return answer == -1 && errno == EPERM; };
  const char* const none[] = {nullptr};
  const bool answers[] = {
      is_refused(::socket(AF_INET, SOCK_STREAM, 0)),
      is_refused(::socket(AF_UNIX, SOCK_STREAM, 0)),
      is_refused(::open("/etc/hostname", O_RDONLY)),
      is_refused(::open("/tmp/skinforge-not-there", O_RDWR | O_CREAT, 0600)),
      is_refused(::unlink("/tmp/skinforge-not-there")),
      is_refused(::fork()),
      is_refused(::execve("/bin/true", const_cast<char**>(none), const_cast<char**>(none))),
      is_refused(::kill(parent, 0)),
      is_refused(::syscall(SYS_tgkill, parent, parent, 0)),
      is_refused(::ptrace(PTRACE_ATTACH, parent, nullptr, nullptr)),
      ::alarm(0) == static_cast<unsigned>(-1),
      std::vector<char>(std::size_t{64} << 20, 'x').back() == 'x',
      ::write(pipe, "x", 1) == 1,
  };
  for (std::size_t i = 0; i < std::size(answers); ++i)
    if (!answers[i]) return static_cast<int>(i) + 1;
  bool has_run = false;
  std::thread([&] { has_run = is_refused(::socket(AF_INET, SOCK_STREAM, 0)); }).join();
  return has_run ? 0 : 99;
}

// Nothing but memory, threads and what is open.
TEST(Sandbox, TheCellLeavesOnlyComputing) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const pid_t parent = ::getpid(), child = ::fork();
  if (child == 0) ::_exit(first_wrong_answer(parent, ends[1]));
  int status = 0;
  ::waitpid(child, &status, 0);
  ::close(ends[0]);
  ::close(ends[1]);
  ASSERT_TRUE(WIFEXITED(status));
  if (WEXITSTATUS(status) == 100) GTEST_SKIP() << "this kernel has no filter of system calls";
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST(Sandbox, MemoryLimitIsOneLine) {
  SKINFORGE_NEEDS_SHARED();
  EXPECT_THAT(refusal_of_shared("hostile/gen/off/count_4e9.off"),
              HasSubstr("count_4e9.off: importer needs more than 2048 MB of memory"));
}

TEST(Sandbox, SmallMemoryNeverHarmsTheParent) {
  SKINFORGE_NEEDS_SHARED();
  SandboxLimits limits;
  limits.stack = std::size_t{8} << 20;
  const auto files = read_input_files(testing::shared_file("assets/quaternius_eagle/eagle.fbx"));
  const Bytes whole = to_bytes(read_in_child(files));
  std::size_t refused = 0;
  for (std::size_t megabytes = 16; megabytes <= 256; megabytes *= 2) {
    limits.address_space = megabytes << 20;
    try {
      EXPECT_EQ(to_bytes(read_in_child(files, limits)), whole) << megabytes;
    } catch (const Error& error) {
      EXPECT_THAT(
          error.what(),
          EndsWith(fmt::format(
              "eagle.fbx: importer needs more than {} MB of memory; --limit import-memory=N gives more",
              megabytes)));
      ++refused;
    }
  }
  EXPECT_GT(refused, 0u);
}

// Nothing is wrong with these eight million faces; they take several times the one second of processor time
// that is allowed here.
TEST(Sandbox, TimeLimitIsOneLine) {
  SandboxLimits limits;
  limits.cpu_seconds = 1;
  limits.address_space = std::size_t{64} << 30;
  std::string text = kTriangle;
  for (int face = 0; face < 8'000'000; ++face) text += "f 1 2 3\n";
  EXPECT_EQ(refusal({file_of("large.obj", text)}, limits),
            "large.obj: importer took more than 1 s; --limit import-seconds=N gives more");
}

TEST(Sandbox, GarbageFromTheWorkerIsRefused) {
  const OtherWorker worker("/bin/echo");
  EXPECT_EQ(refusal({file_of("flat.obj", kTriangle)}), "flat.obj: importer gave a broken answer");
}

TEST(Sandbox, FailingWorkerIsRefused) {
  const OtherWorker worker("/bin/false");
  EXPECT_EQ(refusal({file_of("flat.obj", kTriangle)}), "flat.obj: importer ended with status 1");
}

// A program that imports although it was started as a worker must not start itself again and again.
TEST(Sandbox, WorkerThatDoesNotKnowItStopsAtOnce) {
  ::setenv("SKINFORGE_IMPORT_WORKER", "1", 1);
  try {
    read_in_child({file_of("flat.obj", kTriangle)});
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::Internal);
    EXPECT_THAT(error.what(), HasSubstr("does not answer --import-worker"));
  }
  ::unsetenv("SKINFORGE_IMPORT_WORKER");
}

TEST(Sandbox, MissingWorkerIsOurFault) {
  const OtherWorker worker("/no/such/program");
  try {
    read_in_child({file_of("flat.obj", kTriangle)});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::StageFailed);
    EXPECT_THAT(error.what(), HasSubstr("cannot start the importer"));
  }
}

/// Every foreign file of the hostile corpus: a character, or one line that begins with the path.
TEST(Sandbox, HostileFilesEndInOneLine) {
  SKINFORGE_NEEDS_SHARED();
  std::size_t files = 0, refused = 0;
  for (const char* folder : {"gen/fbx", "gen/obj", "gen/off", "gen/dae", "ufbx", "assimp"})
    for (const auto& entry :
         std::filesystem::directory_iterator(testing::shared_folder() / "hostile" / folder)) {
      const std::string path = entry.path().string(), ending = entry.path().extension().string();
      if (ending != ".fbx" && ending != ".obj" && ending != ".off" && ending != ".dae") continue;
      ++files;
      try {
        IssueSink issues;
        import_character(path, issues);
      } catch (const Error& error) {
        ++refused;
        EXPECT_EQ(error.code(), ExitCode::BadInput) << path;
        EXPECT_THAT(error.what(), StartsWith(path + ": "));
        EXPECT_THAT(error.what(), ::testing::Not(HasSubstr("\n")));
      }
    }
  EXPECT_GT(files, 50u);
  EXPECT_GT(refused, files / 2);
}

}  // namespace
}  // namespace skinforge

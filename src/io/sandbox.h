#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/limits.h"
#include "io/import.h"

/// Parsing of untrusted files in a child process: a crash, endless loop or memory bomb of a foreign parser
/// ends the child, and the parent reports one line.
namespace skinforge {

/// What the child may use.
struct SandboxLimits {
  std::size_t address_space =
      limits().import_memory;                 ///< bytes, beside what the program itself maps at its start
  std::size_t stack = limits().import_stack;  ///< bytes
  std::uint64_t cpu_seconds = limits().import_seconds;
  std::uint64_t wall_seconds = limits().import_wait;  ///< against a child that sleeps
};

/// Reads `files` with Assimp (assimp_reader.h) in a new process. The child gets the bytes, can open neither
/// files nor sockets and start no process, writes no core (import_cell.h), and hands the scene back through a
/// pipe; it is checked (`check_raw_scene`) before it is returned. Throws Error (BadInput), one line: the
/// message of the reader, "FILE: importer crashed (signal 11)", "... took more than 10 s", "... needs more
/// than ... of memory", "... of stack", "... did not answer for 120 s".
RawScene read_in_child(const std::vector<InputFile>& files, const SandboxLimits& limits = {});

/// The program started as worker; its `main` must hand `--import-worker` to `import_worker_main` before all
/// else. Default: the running program. A program that does not know the flag and imports again is stopped
/// there (Internal). Not for use while imports run.
void set_import_worker(std::string executable);

/// The worker: `PROGRAM --import-worker PATH`, files and limits on stdin, the answer on stdout; PATH is only
/// for the eyes of who lists processes. Returns the exit status.
int import_worker_main(int argc, char** argv);

}  // namespace skinforge

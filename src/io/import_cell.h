#pragma once

#include <cstddef>

#include "io/sandbox.h"

/// What the process that reads untrusted files gives up for good before it looks at them (sandbox.h).
namespace skinforge {

/// Exit statuses of the worker, from sysexits.h on upwards.
constexpr int kOutOfMemory = 75;  ///< EX_TEMPFAIL
constexpr int kOutOfStack = 76;

/// Ends the process at once: Assimp catches what it can, and would go on without the mesh that did not fit.
[[noreturn]] void end_without_memory();

/// From here on the process has this much memory and time, can open no file and no socket, leaves no core,
/// and makes no system calls but those of `allow_only_computing`, where the kernel can see to that.
void enter_cell(const SandboxLimits& limits);

/// From here on this thread, and those it starts, can call the kernel for memory, threads, time, and to read
/// and write what is open. Everything else fails with EPERM: files, network, further processes, signals to
/// others. False where the kernel or processor knows no filter; nothing is changed then.
bool allow_only_computing();

/// Runs `work(data)` on a stack of its own of so many bytes: that of the process could not grow so far any
/// more. Ends the process with `kOutOfStack` where that is not enough, with `kOutOfMemory` where there is no
/// room for it.
void run_on_stack(std::size_t bytes, void (*work)(void*), void* data);

}  // namespace skinforge

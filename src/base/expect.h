#pragma once

#include <string>

#include "base/error.h"

/// A promise between our own functions. A failure is a bug in SkinForge, never a fault of user data; kept in
/// release.
#define SF_EXPECT(condition)                                                         \
  do {                                                                               \
    if (!(condition)) ::skinforge::fail_expectation(#condition, __FILE__, __LINE__); \
  } while (false)

namespace skinforge {

[[noreturn]] inline void fail_expectation(const char* condition, const char* file, int line) {
  const std::string path(file);
  const auto src = path.rfind("src/");
  throw Error(ExitCode::Internal, "internal error: expected " + std::string(condition) + " at " +
                                      path.substr(src == std::string::npos ? 0 : src) + ":" +
                                      std::to_string(line));
}

}  // namespace skinforge

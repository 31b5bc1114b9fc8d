#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace skinforge {

/// Exit status of the tool (table in the README). Every `Error` carries the one it leads to.
enum class ExitCode {
  Ok = 0,
  StageFailed = 1,
  Usage = 2,       ///< command line or recipe
  BadInput = 3,    ///< input missing or corrupt
  Invalid = 4,     ///< validation or `expect` failed
  Different = 5,   ///< diff over threshold
  SomeFailed = 6,  ///< some recipes failed under --keep-going
  NotReproducible = 7,
  Internal = 70,
};

/// The one exception of the project: what went wrong, where, and how the process ends if nobody mends it.
/// Thrown where bad data is found; gains context at the edges (file, stage, operation); caught for good by
/// the pipeline (the stage fails) and by `main` (message and exit status).
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& sentence) : std::runtime_error(sentence), code_(code) {}

  ExitCode code() const { return code_; }

  /// The same error with "where: " in front; use at each edge that knows more about the place.
  [[nodiscard]] Error in(std::string_view where) const {
    return Error(code_, std::string(where) + ": " + what());
  }

 private:
  ExitCode code_;
};

/// Runs `body`; an `Error` that leaves it gains `where` as context.
template <class Body>
decltype(auto) with_context(std::string_view where, Body&& body) {
  try {
    return std::forward<Body>(body)();
  } catch (const Error& error) {
    throw error.in(where);
  }
}

}  // namespace skinforge

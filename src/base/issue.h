#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/archive.h"

namespace skinforge {

enum class Severity { Note, Warning };

/// Something odd but usable that was met, and what was done about it. Errors are exceptions, not issues.
struct Issue {
  std::string code;  ///< stable, kebab-case, e.g. "weights-normalised"
  Severity severity = Severity::Note;
  std::string place;    ///< "man.fbx mesh Human_Mesh", "op 1", "clip Walk"
  std::string message;  ///< one sentence with the values

  template <class Archive>
  friend void fields(Archive& a, Issue& i) {
    a(i.code, i.severity, i.place, i.message);
  }
};

/// Collects issues in the order they are met. Algorithms take one by reference and never log.
class IssueSink {
 public:
  void note(std::string code, std::string place, std::string message) {
    issues_.push_back({std::move(code), Severity::Note, std::move(place), std::move(message)});
  }
  void warn(std::string code, std::string place, std::string message) {
    issues_.push_back({std::move(code), Severity::Warning, std::move(place), std::move(message)});
  }
  void add(Issue issue) { issues_.push_back(std::move(issue)); }
  const std::vector<Issue>& issues() const { return issues_; }

 private:
  std::vector<Issue> issues_;
};

}  // namespace skinforge

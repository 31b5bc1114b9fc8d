#include "pipeline/stage.h"

#include <algorithm>

#include "base/expect.h"

namespace skinforge {

std::string_view StageInfo::prefix() const {
  if (writes.empty()) return {};
  const std::string_view first = writes.front();
  const auto slash = first.substr(0, first.find(':')).rfind('/');  // behind a colon may stand any text
  return slash == std::string_view::npos ? std::string_view() : first.substr(0, slash + 1);
}

std::string StageInfo::label() const {
  const std::string own = std::string(prefix()) + name;
  return instance.empty() ? own : own + " " + instance;
}

std::string issues_artifact(const std::string& first_output) {
  return "issues:" + first_output;
}

const std::shared_ptr<Artifact>& StageInput::shared(std::string_view name) const {
  const auto found = artifacts_.find(name);
  if (found == artifacts_.end())
    throw Error(ExitCode::Internal, "artifact \"" + std::string(name) + "\" is read but not declared");
  return found->second;
}

void StageOutput::pass(std::string_view name, const StageInput& in, std::string_view input) {
  expect_open(name);
  artifacts_.emplace(std::string(name), in.shared(input));
}

void StageOutput::expect_open(std::string_view name) const {
  SF_EXPECT(!artifacts_.contains(name));  // put once
  if (std::find(info_.writes.begin(), info_.writes.end(), name) == info_.writes.end())
    throw Error(ExitCode::Internal, "artifact \"" + std::string(name) + "\" is written but not declared");
}

std::vector<std::shared_ptr<Artifact>> StageOutput::take() const {
  std::vector<std::shared_ptr<Artifact>> artifacts;
  for (const std::string& name : info_.writes) {
    const auto found = artifacts_.find(name);
    if (found == artifacts_.end())
      throw Error(ExitCode::Internal, "artifact \"" + name + "\" is declared but not written");
    artifacts.push_back(found->second);
  }
  return artifacts;
}

}  // namespace skinforge

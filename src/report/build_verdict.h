#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "base/issue.h"

namespace skinforge {

/// How one recipe of a run came out, as a CI shows it.
struct BuildVerdict {
  std::string label = {};   ///< "recipes/centaur.json body=horse"
  std::string recipe = {};  ///< file
  int line = 1;             ///< in `recipe`: what the error is about; 1 where it is about all of it
  int column = 1;
  ExitCode code = ExitCode::Ok;
  std::string error = {};  ///< one line; empty when all is well
  std::string stage = {};  ///< that failed; empty when none did
  std::size_t stages = 0, hits = 0;
  double seconds = 0;
  std::vector<Issue> warnings = {};
};

/// Stable name of what an exit status means: "stage-failed", "bad-input", ...; rules of SARIF and types of
/// JUnit.
std::string rule_name(ExitCode code);

/// SARIF 2.1.0: an error for each recipe that failed, at its line of the recipe, and its warnings.
std::string sarif(const std::vector<BuildVerdict>& verdicts, const std::string& tool_version);

/// Workflow commands of GitHub Actions, one line each: "::error file=a.json,line=3,col=5,title=...::message".
std::string github_annotations(const std::vector<BuildVerdict>& verdicts);

/// Markdown for the summary page of a run: what failed first and why, then all recipes in a table.
std::string markdown_summary(const std::vector<BuildVerdict>& verdicts);

/// JUnit XML, one test a recipe (junit.h).
std::string junit_xml(const std::vector<BuildVerdict>& verdicts);

}  // namespace skinforge

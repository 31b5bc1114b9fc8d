#pragma once

#include <string>
#include <vector>

namespace skinforge {

/// One line of a CI's list of tests.
struct TestCase {
  std::string suite;    ///< "recipes", "diff"
  std::string name;     ///< "centaur"
  std::string failure;  ///< one sentence; empty: passed
  std::string kind;     ///< of the failure: "StageFailed", "animation"
  double seconds = 0;
};

/// JUnit XML as CI servers read it (testsuites / testsuite / testcase / failure), suites in the order in
/// which they first come. Characters that XML 1.0 has no place for become "?".
std::string junit_xml(const std::vector<TestCase>& cases);

}  // namespace skinforge

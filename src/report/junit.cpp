#include "report/junit.h"

#include <fmt/format.h>

#include <algorithm>

namespace skinforge {

namespace {
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t' ? '?' : c;
  }
  return result;
}

std::string case_xml(const TestCase& test) {
  std::string xml = fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\"",
                                escaped(test.suite), escaped(test.name), test.seconds);
  if (test.failure.empty()) return xml + "/>\n";
  return xml + fmt::format(">\n      <failure type=\"{}\" message=\"{}\"/>\n    </testcase>\n",
                           escaped(test.kind), escaped(test.failure));
}

std::string suite_xml(const std::string& suite, const std::vector<TestCase>& cases) {
  std::string body;
  std::size_t tests = 0, failures = 0;
  double seconds = 0;
  for (const TestCase& test : cases) {
    if (test.suite != suite) continue;
    body += case_xml(test);
    ++tests;
    failures += test.failure.empty() ? 0 : 1;
    seconds += test.seconds;
  }
  return fmt::format(
      "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" time=\"{:.3f}\">\n{}  </testsuite>\n",
      escaped(suite), tests, failures, seconds, body);
}
}  // namespace

std::string junit_xml(const std::vector<TestCase>& cases) {
  std::vector<std::string> suites;
  for (const TestCase& test : cases)
    if (std::find(suites.begin(), suites.end(), test.suite) == suites.end()) suites.push_back(test.suite);
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
  for (const std::string& suite : suites) xml += suite_xml(suite, cases);
  return xml + "</testsuites>\n";
}

}  // namespace skinforge

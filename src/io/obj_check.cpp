#include "io/obj_check.h"

#include <fmt/format.h>

#include <set>
#include <string_view>

#include "base/text.h"
#include "io/file_kind.h"
#include "io/obj_statements.h"

namespace skinforge {
namespace {

constexpr std::size_t kLongLine = 65'536;  // ours: bytes; a face of 4,000 corners stays below

/// How often something was met, and where first.
struct Tally {
  std::size_t count = 0, line = 0;
  void add(std::size_t at) {
    if (count++ == 0) line = at;
  }
};

std::set<std::string_view> defined_materials(const std::vector<InputFile>& files) {
  std::set<std::string_view> names;
  for (const InputFile& file : files)
    if (lower_extension(file.path) == ".mtl")
      for_each_statement(file.bytes, [&](const ObjStatement& s) {
        if (s.keyword == "newmtl") names.insert(s.rest);
      });
  return names;
}

}  // namespace

void check_obj(const std::vector<InputFile>& files, std::vector<Issue>& issues) {
  const auto defined = defined_materials(files);
  Tally empty, longer;
  std::set<std::string_view> missing;
  for_each_statement(files.front().bytes, [&](const ObjStatement& s) {
    if (s.keyword == "f" && s.rest.empty()) empty.add(s.line);
    if (s.length > kLongLine) longer.add(s.line);
    if (s.keyword == "usemtl" && !defined.contains(s.rest)) missing.insert(s.rest);
  });
  if (empty.count > 0)
    issues.push_back({"obj-face-empty", Severity::Warning, "scene",
                      fmt::format("{} faces without corners are left out, the first in line {}", empty.count,
                                  empty.line)});
  if (longer.count > 0)
    issues.push_back({"obj-line-long", Severity::Warning, "scene",
                      fmt::format("{} lines of more than {} bytes, the first is line {}", longer.count,
                                  kLongLine, longer.line)});
  for (const std::string_view name : missing)
    issues.push_back({"obj-material-missing", Severity::Warning, "material " + printable(name),
                      "no library beside the file defines it; it is grey by default"});
}

}  // namespace skinforge

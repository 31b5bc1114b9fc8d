#include "cli/khronos_validator.h"

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/child_program.h"

namespace skinforge {
namespace fs = std::filesystem;
using nlohmann::json;

namespace {
// argv: modules, file. Prints the messages as JSON.
constexpr const char* kScript = R"(
const fs = require('fs'), path = require('path');
const [modules, file] = process.argv.slice(1);
let validator;
for (const folder of modules.split(path.delimiter).filter(Boolean))
  try { validator = require(path.resolve(folder, 'gltf-validator')); break; } catch (error) {}
if (!validator) process.exit(3);
const near = (uri) => fs.promises.readFile(path.join(path.dirname(file), decodeURIComponent(uri)));
validator.validateBytes(new Uint8Array(fs.readFileSync(file)),
    { maxIssues: 0, externalResourceFunction: (uri) => near(uri).then((bytes) => new Uint8Array(bytes)) })
  .then((report) => console.log(JSON.stringify(report.issues.messages)));
)";

std::string module_folders() {
  const char* given = std::getenv("NODE_PATH");
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);  // build/release/skinforge
  return std::string(given ? given : "") + ":" +
         (program.parent_path().parent_path() / "node/node_modules").string();
}
}  // namespace

std::optional<std::vector<GltfFinding>> khronos_findings(const std::string& path) {
  const auto child = run_child({"node", "-e", kScript, module_folders(), fs::absolute(path).string()}, 60);
  if (!child || child->status != 0) return std::nullopt;
  const json messages = json::parse(child->out, nullptr, false);
  if (!messages.is_array()) return std::nullopt;
  std::vector<GltfFinding> findings;
  for (const json& message : messages) {
    const int severity = message.value("severity", 3);  // 0 error, 1 warning, 2 information, 3 hint
    if (severity > 1) continue;
    findings.push_back({severity == 0 ? GltfFinding::Level::Error : GltfFinding::Level::Warning,
                        message.value("code", ""), message.value("pointer", ""),
                        message.value("message", "")});
  }
  return findings;
}

}  // namespace skinforge

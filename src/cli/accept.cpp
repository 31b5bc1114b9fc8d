#include "cli/accept.h"

#include <fmt/core.h>

#include "pipeline/publish.h"
#include "stages/artifacts.h"
#include "stages/golden_comparison.h"

namespace skinforge {
namespace fs = std::filesystem;

void accept_model(const fs::path& reference, const std::string& from, const Bytes& bytes,
                  const std::string& text, Console& console) {
  const std::string name = reference.string();
  if (!fs::exists(reference)) {
    std::error_code error;  // of a folder that cannot be made the next line tells
    fs::create_directories(reference.parent_path(), error);
    write_output(reference, bytes);
    console.info(name + ": made");
    return;
  }
  write_output(name + ".change.md",
               fmt::format("# {} was accepted in the place of {}\n\n```\n{}```\n", from, name, text));
  write_output(reference, bytes);
  console.info(name + ": accepted; what changed is in " + name + ".change.md");
}

void accept_golden(Session& session, Console& console) {
  const Recipe& recipe = session.recipe();
  if (!recipe.golden)
    throw Error(ExitCode::Usage, recipe.where("/expect") +
                                     ": --accept needs a golden; the recipe names none "
                                     "(\"expect\": { \"golden\": \"golden/NAME.glb\" })");
  if (!session.import()) return;
  session.add_grafts();
  const ArtifactNames names;
  std::vector<std::string> wanted{names.glb(), names.validation(), names.comparison()};
  if (!recipe.expect.is_empty()) wanted.push_back(names.expectations());
  if (!session.run_for(wanted)) return;
  Engine& engine = session.engine();
  if (engine.digest(names.glb()) == engine.digest(names.golden())) return;
  accept_model(recipe.golden->file.resolved, "What " + recipe.path.filename().string() + " makes",
               engine.get<Bytes>(names.glb()), engine.get<GoldenComparison>(names.comparison()).text,
               console);
}

}  // namespace skinforge

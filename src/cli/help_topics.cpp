#include "cli/help_topics.h"

#include <map>

namespace skinforge {

namespace {
const std::map<std::string, std::string>& topics() {
  static const std::map<std::string, std::string> kTopics = {{"status", R"(Exit status
  0    all is well
  1    a stage failed, or a file could not be written
  2    a mistake on the command line or in a recipe
  3    an input is missing or corrupt
  4    a result is not what was meant: validation, "expect", a damaged cache, a file that was edited
  5    two models differ (diff), a result is unlike its golden (build), an older recipe would change (migrate --check)
  6    some recipes failed, the others are made (build --keep-going)
  7    results differ from run to run
  70   internal error: please report it
  130, 143  ended by SIGINT, SIGTERM; the next build goes on where this one stopped
  A build that fails "expect" alone, a budget (4) or the golden (5), has written its files: they are there to be looked
  at. After every other failure the output folder is as it was.
)"},
                                                             {"environment", R"(Environment
  SKINFORGE_CACHE  folder of the cache (default .skinforge/cache; --cache counts before it)
  NO_COLOR         any value: no colours and no status line
  CLICOLOR_FORCE   any value: colours even where stderr is no terminal
  CI               any value: no status line, one line a stage
  GITHUB_ACTIONS   true: errors and warnings are annotations at lines of the recipes
  NODE_PATH        where the npm package gltf-validator is looked for (validate)
)"},
                                                             {"caching", R"(The cache
  Each stage is known by a key: program, parameters, digests of what it reads. What it made lies in the cache under
  that key and is taken from there for as long as the key stays the same; paths, times, threads, comments and the order
  of keys are not in it. Everything that is read is checked; a damaged entry is made again.
  cache stats           what is in it, how often it was of use, and the time that saved
  cache gc --max-size GB --max-age DAYS   what was not asked for longest goes first
  cache pin RECIPE      the last build of a recipe stays
  cache verify          reads everything, takes away what is damaged
  build --verify        runs what is known, too, and fails (status 7) where a stage gives other bytes
  plan, explain, graph  what would run, why, and what depends on what
)"},
                                                             {"recipe", R"(Recipes
  { "recipe_version": 1, "name": "centaur", "inputs": { "horse": "horse.glb", "man": "man.glb" }, "base": "horse",
    "ops": [ { "op": "replace", "at": "Neck1", "from": "man", "joint": "Spine" } ] }
  JSON, JSON with comments or YAML. `skinforge schema` prints every key with its unit, range and default; with
  "$schema" an editor completes and checks by it. `extends`, `include`, `vars` and `matrix` build recipes of recipes;
  `skinforge expand` shows what they come to. `skinforge inspect FILE` shows the joints and clips of a model.
  `skinforge migrate FILE` brings an older recipe to the present version; comments and layout stay.
)"},
                                                             {"ci", R"(In a nightly CI
  skinforge build recipes/ --keep-going --junit junit.xml --sarif skinforge.sarif --summary summary.md
  --shard 2/5       the second of five equal shares, for several machines
  --retry-failed    runs again what failed before with the same key
  --events FILE     what happens as it happens, one JSON object a line (schema event)
  --json            the verdicts on stdout
  "expect": { "golden": "golden/centaur.glb" } in a recipe keeps its result like that file; build --accept takes a new
  one, with a note golden/centaur.glb.change.md of what changed
  diff golden.glb new.glb --html diff.html   status 5 where they differ; --accept takes the new one
  --pictures shots/     with diff: before, after and difference as PNG; --sarif and --junit: the verdicts
)"}};
  return kTopics;
}
}  // namespace

std::optional<std::string> help_topic(const std::string& topic) {
  const auto found = topics().find(topic);
  return found == topics().end() ? std::nullopt : std::optional(found->second);
}

std::vector<std::string> help_topic_names() {
  std::vector<std::string> names;
  for (const auto& [name, text] : topics()) names.push_back(name);
  return names;
}

}  // namespace skinforge

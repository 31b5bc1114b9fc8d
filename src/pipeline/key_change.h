#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/cache.h"
#include "pipeline/run_record.h"
#include "pipeline/stage_key.h"

namespace skinforge {

/// One reason why a stage has another key than in an earlier run, or none that can be used.
struct KeyChange {
  enum class Kind {
    NeverRun,   ///< the earlier run did not have the stage
    EntryLost,  ///< the same key, but its cache entry is missing or damaged
    Forgotten,  ///< the earlier run is no longer in the cache
    Tool,       ///< another build of the tool
    Version,    ///< another version of the stage
    Setting,    ///< something the person set; `name` leads to it
    Parameter,  ///< a parameter of the stage that no setting tells
    Input,      ///< an artifact that the stage reads; values are digests
    Pending,    ///< an artifact that has to be made first
    Order       ///< the same inputs in another order
  };
  Kind kind = Kind::NeverRun;
  std::string name = {};                   ///< setting, parameter or artifact
  std::optional<std::string> before = {};  ///< none: it was not there
  std::optional<std::string> after = {};   ///< none: it is gone
  bool operator==(const KeyChange&) const = default;
};

/// Whether a stage takes the setting into its own key. Null: nothing is known of settings.
using ReadsSetting = std::function<bool(const StageInfo& stage, std::string_view setting)>;

/// An earlier run of a stage.
struct EarlierRun {
  std::optional<Digest> key;         ///< none: it never ran
  std::optional<Manifest> manifest;  ///< none: no longer stored
  Settings settings;                 ///< under which it got that key
};

/// What differs between the key of a stage now and in an earlier run; empty when nothing does. Inputs that
/// are not known yet have an empty value in `now` and come as Pending. Changed settings that the stage reads
/// stand for the parameters whose values are digests only.
std::vector<KeyChange> key_changes(const StageInfo& info, const StageKey& now, const Settings& settings,
                                   const EarlierRun& earlier, const ReadsSetting& reads_setting);

/// "parameter scale: 1 -> 1.2", "input field changed".
std::string to_text(const KeyChange& change);

/// All of them in one line, at most eight: "the tool changed; input field changed; 2 more".
std::string why_run(std::span<const KeyChange> changes);

}  // namespace skinforge

#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/hash.h"

namespace skinforge {

/// What the person set, by a name that leads back to it (a JSON pointer into the recipe), as text.
using Settings = std::map<std::string, std::string>;

/// What one run of a session left behind, for "why does it run?" and "what changed since?". Information only:
/// never part of a key, and a lost record costs nothing but reasons.
struct RunRecord {
  struct Stage {
    Digest key;
    std::size_t settings = 0;  ///< index into `settings`: those of the run in which the stage got this key
    bool operator==(const Stage&) const = default;
  };
  std::map<std::string, Stage> stages;  ///< by label
  std::vector<Settings> settings;       ///< each distinct one once; none when the session has none

  bool operator==(const RunRecord&) const = default;
  /// The settings of a stage; empty when it is not there.
  const Settings& settings_of(const std::string& label) const;
  /// Notes that the stage has this key now, under these settings.
  void note(const std::string& label, const Digest& key, const Settings& now);
  /// Leaves out settings that no stage refers to any more.
  void tidy();
  /// Eight hex digits that name the run: equal for equal records, on any machine.
  std::string id() const;
};

std::string run_record_text(const RunRecord& record);
/// Reads it back; none when it is damaged or of another form.
std::optional<RunRecord> parse_run_record(std::string_view text);

}  // namespace skinforge

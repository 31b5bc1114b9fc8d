#pragma once

#include <chrono>
#include <cstdio>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "pipeline/engine.h"

namespace skinforge {

/// What happens in a build as it happens: one JSON object a line (NDJSON), for dashboards and schedulers.
/// Each has "event", "time" (seconds from the start) and, but for the first and the last, "recipe".
/// `event_schema` says the rest. Thread-safe. A stream that cannot be written any more ends in silence: a
/// build does not depend on who listens.
class EventStream {
 public:
  /// `path`: a file, made anew, or a pipe; empty: nothing is written. Throws Error (StageFailed).
  explicit EventStream(const std::string& path);
  ~EventStream();
  EventStream(const EventStream&) = delete;
  EventStream& operator=(const EventStream&) = delete;

  void build_started(std::size_t recipes);
  void recipe_started(const std::string& recipe, const std::string& variant);
  void stage_started(const StageInfo& stage);
  /// With the issues of the stage.
  void stage_finished(const StageResult& stage);
  void recipe_finished(const std::string& name, ExitCode code, const std::string& error, double seconds);
  void build_finished(ExitCode code);

 private:
  void write(const char* event, nlohmann::json more);

  std::FILE* file_ = nullptr;
  std::mutex mutex_;
  std::string recipe_, variant_;  // the one that is being built
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// JSON Schema (draft-07) of one event, as `skinforge schema event` prints it and schemas/event.schema.json
/// holds it.
std::string event_schema();

}  // namespace skinforge

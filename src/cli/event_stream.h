#pragma once

#include <chrono>
#include <cstdio>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "pipeline/engine.h"

namespace skinforge {

/// What happens in a build as it happens: one JSON object a line (NDJSON), for dashboards and schedulers.
/// Each has "event", "time" (seconds from the start) and, but for the first and the last, "recipe"; recipes
/// that are built side by side take turns. `event_schema` says the rest. Thread-safe. A stream that cannot be
/// written any more ends in silence: a build does not depend on who listens.
class EventStream {
 public:
  /// `path`: a file, made anew, or a pipe; empty: nothing is written. Throws Error (StageFailed).
  explicit EventStream(const std::string& path);
  ~EventStream();
  EventStream(const EventStream&) = delete;
  EventStream& operator=(const EventStream&) = delete;

  void build_started(std::size_t recipes);
  void build_finished(ExitCode code);

 private:
  friend class RecipeEvents;
  void write(const char* event, nlohmann::json more);

  std::FILE* file_ = nullptr;
  std::mutex mutex_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Those of one recipe. `stream` must outlive it.
class RecipeEvents {
 public:
  RecipeEvents(EventStream& stream, std::string recipe, std::string variant)
      : stream_(stream), recipe_(std::move(recipe)), variant_(std::move(variant)) {}

  void started();
  void stage_started(const StageInfo& stage);
  /// With the issues of the stage.
  void stage_finished(const StageResult& stage);
  void finished(const std::string& name, ExitCode code, const std::string& error, double seconds);

 private:
  void write(const char* event, nlohmann::json more);

  EventStream& stream_;
  std::string recipe_, variant_;
};

/// JSON Schema (draft-07) of one event, as `skinforge schema event` prints it and schemas/event.schema.json
/// holds it.
std::string event_schema();

}  // namespace skinforge

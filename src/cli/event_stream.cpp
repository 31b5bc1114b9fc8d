#include "cli/event_stream.h"

#include <nlohmann/json.hpp>

#include "base/version.h"
#include "cli/session.h"

namespace skinforge {
using nlohmann::json;

EventStream::EventStream(const std::string& path) {
  if (path.empty()) return;
  file_ = std::fopen(path.c_str(), "we");
  if (!file_) throw Error(ExitCode::StageFailed, path + ": cannot write this file");
}

EventStream::~EventStream() {
  if (file_) std::fclose(file_);
}

void EventStream::write(const char* event, json more) {
  if (!file_) return;
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start_;
  const std::lock_guard lock(mutex_);
  json line = {{"event", event}, {"time", time.count()}};
  line.update(more);
  const std::string text = line.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
  std::fputs(text.c_str(), file_);
  std::fflush(file_);  // whoever follows the file sees whole lines
}

void EventStream::build_started(std::size_t recipes) {
  write("build-started", {{"recipes", recipes}, {"version", kVersion}});
}

void EventStream::build_finished(ExitCode code) {
  write("build-finished", {{"exit_code", static_cast<int>(code)}});
}

void RecipeEvents::write(const char* event, json more) {
  more["recipe"] = recipe_;
  if (!variant_.empty()) more["variant"] = variant_;
  stream_.write(event, std::move(more));
}

void RecipeEvents::started() {
  write("recipe-started", json::object());
}

void RecipeEvents::stage_started(const StageInfo& stage) {
  write("stage-started", {{"stage", stage.label()}});
}

void RecipeEvents::stage_finished(const StageResult& stage) {
  if (!stream_.file_) return;
  json more = {{"stage", stage.info.label()},
               {"status", status_name(stage.status)},
               {"wall_seconds", stage.cost.wall_seconds},
               {"cpu_seconds", stage.cost.cpu_seconds},
               {"issues", to_json(stage.issues)}};
  if (!stage.reason.empty()) more["reason"] = stage.reason;
  if (!stage.error.empty()) more["error"] = stage.error;
  write("stage-finished", std::move(more));
}

void RecipeEvents::finished(const std::string& name, ExitCode code, const std::string& error,
                            double seconds) {
  json more = {{"name", name}, {"exit_code", static_cast<int>(code)}, {"seconds", seconds}};
  if (!error.empty()) more["error"] = error;
  write("recipe-finished", std::move(more));
}

}  // namespace skinforge

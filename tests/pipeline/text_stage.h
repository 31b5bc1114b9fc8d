#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/engine.h"

namespace skinforge::testing {

/// Artifact of the toy stages.
struct Text {
  std::string value;
  template <class Archive>
  friend void fields(Archive& a, Text& t) {
    a(t.value);
  }
};

/// How often each toy stage ran.
using Counter = std::shared_ptr<std::atomic<int>>;
inline Counter counter() {
  return std::make_shared<std::atomic<int>>(0);
}

/// Toy stage: writes `parameter` followed by everything it reads to each of its outputs, cut to `keep`
/// characters.
struct TextStage final : Stage {
  StageInfo about;
  std::string parameter;
  std::size_t keep = std::string::npos;
  Counter runs = counter();
  std::function<void(IssueSink&)> extra;

  TextStage(StageInfo i, std::string p, Counter c)
      : about(std::move(i)), parameter(std::move(p)), runs(std::move(c)) {}

  StageInfo info() const override { return about; }
  void add_to_key(Hasher& key) const override { key.add("parameter", parameter); }
  void run(const StageInput& in, StageOutput& out, IssueSink& issues) const override {
    ++*runs;
    if (extra) extra(issues);
    std::string text = parameter;
    for (const std::string& name : about.reads) text += in.get<Text>(name).value;
    for (const std::string& name : about.writes) out.put(name, Text{text.substr(0, keep)});
  }
};

inline std::unique_ptr<TextStage> text_stage(const std::string& name, std::vector<std::string> reads,
                                             std::vector<std::string> writes, const std::string& parameter,
                                             Counter runs = counter()) {
  return std::make_unique<TextStage>(
      StageInfo{.name = name, .reads = std::move(reads), .writes = std::move(writes)}, parameter,
      std::move(runs));
}

inline Bytes bytes_of(const std::string& text) {
  const auto view = std::as_bytes(std::span(text));
  return {view.begin(), view.end()};
}

inline std::string text_of(const Bytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace skinforge::testing

#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/engine.h"
#include "pipeline/schedule.h"
#include "pipeline/stage_key.h"

/// What an engine is inside: the stages of a session, the artifacts between them, and how one stage is done.
/// engine_session.cpp holds the work on one stage, engine.cpp the order of all of them.
namespace skinforge {

/// One stage and how far it got.
struct Engine::Node {
  std::unique_ptr<Stage> stage;
  StageInfo info;
  StageKey key;
  StageResult result;
  bool is_done = false;
  std::mutex remaking;
};

/// One artifact by name; no maker: a source.
struct Engine::Slot {
  std::shared_ptr<Artifact> artifact;
  Node* maker = nullptr;
};

struct Engine::Session {
  Session(Cache& c, EngineOptions o) : cache(c), options(std::move(o)) {}

  Cache& cache;
  EngineOptions options;
  FileDigests own_digests;   // where the options bring none
  mutable std::mutex mutex;  // guards artifacts of `slots` and results of `nodes` while stages run
  std::mutex observing;
  std::mutex recording;  // guards `last_run`
  std::vector<std::unique_ptr<Node>> nodes;
  std::map<std::string, Slot> slots;
  std::map<Digest, const Node*> ran;  // by key: who made its outputs first
  std::optional<RunRecord> last_run;  // as it was stored before this session
  RunRecord run_now;                  // and as this session goes on
  /// Starts the other threads of a batch: with the first stage that has to run, since hits are not worth one.
  std::function<void()> call_helpers;

  void add_source(const std::string& name, std::shared_ptr<Artifact> artifact);
  void add(std::unique_ptr<Stage> stage);
  const Slot& slot(const std::string& name) const;
  std::shared_ptr<Artifact> artifact(const std::string& name) const;
  Artifact::Loader loader(const Digest& digest);

  void compute_key(Node& node) const;
  void adopt(Node& node, const Manifest& manifest);
  const RunRecord& earlier_run();
  std::vector<KeyChange> changes(const Node& node, const RunRecord& since);
  std::string reason(const Node& node);
  std::optional<StoredFailure> remembered_failure(const Node& node);
  void remember_failure(const Node& node);
  std::vector<std::shared_ptr<Artifact>> execute(Node& node, IssueSink& issues, StageCost& cost);
  void accept(const Node& node, const std::vector<std::shared_ptr<Artifact>>& outputs);
  void store(Node& node, const std::vector<std::shared_ptr<Artifact>>& outputs);
  void ensure(const std::string& name);
  void remake(Node& node, const std::string& wanted);
  void expect_same(const Node& node, const std::vector<std::shared_ptr<Artifact>>& outputs) const;
  bool take_known(Node& node);
  void compare(Node& node);
  void tell_start(const Node& node);
  void process(Node& node);
  void process_safely(Node& node);
  void finish(Node& node);

  std::vector<Node*> pending() const;
  std::vector<Node*> needed_for(const std::vector<std::string>& artifacts) const;
  Schedule schedule(const std::vector<Node*>& nodes) const;
  void run(const std::vector<Node*>& nodes);
  const Node* failed_maker(const Node& node) const;
  StagePlan plan(Node& node);
  void remember_run();
};

}  // namespace skinforge

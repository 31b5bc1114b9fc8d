#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/version.h"
#include "pipeline/cache.h"
#include "pipeline/key_change.h"
#include "pipeline/stage.h"

namespace skinforge {

enum class StageStatus { Hit, Ran, Failed, Skipped };

/// How one stage of a session ended.
struct StageResult {
  StageInfo info;
  Digest key;  ///< zero when skipped
  StageStatus status = StageStatus::Skipped;
  std::string reason;          ///< why it ran, or which failed stage it waited for; empty for a hit
  std::vector<Issue> issues;   ///< of this run, or replayed
  StageCost cost;              ///< of this run, or for a hit of the run that was stored
  std::string error;           ///< one line, when failed
  bool is_remembered = false;  ///< failed before with the same key, and was not run now
  ExitCode code = ExitCode::Ok;
};

enum class PlanState { Hit, Run, Waits };

/// What a stage would do. `Waits`: one of its inputs is not known before another stage has run.
struct StagePlan {
  StageInfo info;
  PlanState state = PlanState::Waits;
  std::string reason;  ///< "never run", "input field changed", "parameter scale: 1 -> 1.2", "waits for place"
  std::vector<KeyChange> changes;  ///< since the last run of the session, even where the stage is a hit
};

class WorkShare;

/// Told as stages start and finish; one call at a time, from any thread.
class EngineObserver {
 public:
  virtual ~EngineObserver() = default;
  virtual void on_start(const StageInfo&) {}
  virtual void on_finish(const StageResult&) {}
};

struct EngineOptions {
  std::size_t jobs = 1;                ///< stages at a time; never changes a result
  std::string build = kVersion;        ///< id of the tool, part of every key
  std::string session = {};            ///< whose last run to compare with for reasons; empty = none
  EngineObserver* observer = nullptr;  ///< may be null
  /// Which failures would come again and are remembered until the key changes; null: none. `retry_failed`:
  /// those are tried all the same.
  std::function<bool(const StageInfo&, ExitCode)> remembers_failure = {};
  bool retry_failed = false;
  /// Stages whose result is known run all the same, and fail with NotReproducible where they give other
  /// bytes.
  bool verify = false;
  Settings settings = {};           ///< what the person set, for reasons; never part of a key
  ReadsSetting reads_setting = {};  ///< which stage takes which of them into its key
  WorkShare* share = nullptr;       ///< with other engines; null: works alone
  FileDigests* digests = nullptr;   ///< null: the engine's own, which know nothing from earlier sessions
};

/// One build session: takes stages in batches, runs them in the order of their artifacts, from the cache
/// where it can. A stage's key is the SHA-256 of tool build, name, version, parameters and the digests of
/// what it reads; so equal bytes stop a chain of re-runs. A failed stage takes its dependents with it, the
/// rest goes on.
class Engine {
 public:
  /// `cache` must outlive the engine.
  Engine(Cache& cache, EngineOptions options);
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// An artifact that no stage makes, in hand.
  template <class T>
  void put_source(const std::string& name, T value) {
    put_artifact(name, Artifact::of(std::move(value)));
  }
  /// Likewise by the digest of its bytes, with a way to load them when a stage has to run (in any thread;
  /// what it throws fails that stage). Loaded bytes of another digest are an Error (BadInput): the source
  /// changed.
  void put_source(const std::string& name, const Digest& digest, std::uint64_t size,
                  std::function<Bytes()> load);

  /// Digests of files that sources and outputs are made of.
  FileDigests& digests();

  /// Adds stages for the next `run` or `plan`. Each artifact has one maker; a stage may read what earlier
  /// batches made. Throws Error (Internal) when two stages write one artifact.
  void add(std::unique_ptr<Stage> stage);
  void add(std::vector<std::unique_ptr<Stage>> stages);

  /// Runs what was added and has not run yet. Throws only for mistakes in the graph (an artifact nobody
  /// makes, a cycle): failures of stages are in `results`.
  void run();

  /// Runs only what these artifacts need. Throws like `run`, and for an artifact that nobody makes.
  void run_for(const std::vector<std::string>& artifacts);
  /// All stages added so far, in that order.
  std::vector<StageInfo> stages() const;

  /// What `run` would do, one per stage not run yet, in the order they were added. Runs nothing. Outputs of
  /// hits count as known afterwards, so that a further batch can be planned.
  std::vector<StagePlan> plan();

  /// What differs from an earlier run of the session: one list per stage of the last `plan`, in its order.
  std::vector<std::vector<KeyChange>> changes_since(const RunRecord& run);
  /// The parameters in the key of each stage added so far, by label: what a setting moves directly.
  std::map<std::string, std::vector<HashedField>> parameters() const;

  /// One per stage run so far, in the order they were added.
  std::vector<StageResult> results() const;
  /// Whether every stage so far was a hit or ran well.
  bool is_ok() const;

  /// Whether the artifact is known: a source, or made by a stage that ran or hit.
  bool has(const std::string& name) const;
  const Digest& digest(const std::string& name) const;
  std::uint64_t size(const std::string& name) const;
  /// The value of a known artifact, e.g. the clip list that decides the next batch. Damaged or missing cache
  /// entries are made again by their stage.
  template <class T>
  const T& get(const std::string& name) {
    return loaded(name).get<T>();
  }
  /// Its bytes as stored, likewise.
  Bytes bytes(const std::string& name);

 private:
  void put_artifact(const std::string& name, std::shared_ptr<Artifact> artifact);
  const Artifact& loaded(const std::string& name);
  struct Node;
  struct Slot;
  struct Session;
  std::unique_ptr<Session> session_;
};

}  // namespace skinforge

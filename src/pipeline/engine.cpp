#include "pipeline/engine.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <set>
#include <thread>

#include "base/expect.h"
#include "pipeline/schedule.h"
#include "pipeline/stage_key.h"

namespace skinforge {

namespace {
struct Node {
  std::unique_ptr<Stage> stage;
  StageInfo info;
  StageKey key;
  StageResult result;
  bool is_done = false;
  std::mutex remaking;
};

struct Slot {
  std::shared_ptr<Artifact> artifact;
  Node* maker = nullptr;
};

double seconds_of(clockid_t clock) {
  timespec now{};
  ::clock_gettime(clock, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

std::uint64_t peak_bytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

// Measures from its making to `cost()`.
class Stopwatch {
 public:
  explicit Stopwatch(bool alone)
      : clock_(alone ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_THREAD_CPUTIME_ID),
        wall_(seconds_of(CLOCK_MONOTONIC)),
        cpu_(seconds_of(clock_)) {}
  StageCost cost() const {
    return {seconds_of(CLOCK_MONOTONIC) - wall_, seconds_of(clock_) - cpu_, peak_bytes()};
  }

 private:
  clockid_t clock_;
  double wall_, cpu_;
};
}  // namespace

struct Engine::Session {
  Session(Cache& c, EngineOptions o) : cache(c), options(std::move(o)) {}

  Cache& cache;
  EngineOptions options;
  mutable std::mutex mutex;  // guards artifacts of `slots` and results of `nodes` while stages run
  std::mutex observing;
  std::vector<std::unique_ptr<Node>> nodes;
  std::map<std::string, Slot> slots;
  std::map<Digest, const Node*> ran;  // by key: who made its outputs first
  std::optional<std::map<std::string, Digest>> last_keys;

  void add_source(const std::string& name, std::shared_ptr<Artifact> artifact);
  void add(std::unique_ptr<Stage> stage);
  const Slot& slot(const std::string& name) const;
  std::shared_ptr<Artifact> artifact(const std::string& name) const;
  Artifact::Loader loader(const Digest& digest);

  void compute_key(Node& node) const;
  void adopt(Node& node, const Manifest& manifest);
  std::string reason(const Node& node);
  std::vector<std::shared_ptr<Artifact>> execute(Node& node, IssueSink& issues, StageCost& cost);
  void accept(const Node& node, const std::vector<std::shared_ptr<Artifact>>& outputs);
  void store(Node& node, const std::vector<std::shared_ptr<Artifact>>& outputs);
  void ensure(const std::string& name);
  void remake(Node& node, const std::string& wanted);
  void process(Node& node);
  void process_safely(Node& node);
  void finish(Node& node);

  std::vector<Node*> pending() const;
  std::vector<Node*> needed_for(const std::vector<std::string>& artifacts) const;
  Schedule schedule(const std::vector<Node*>& nodes) const;
  void run(const std::vector<Node*>& nodes);
  const Node* failed_maker(const Node& node) const;
  StagePlan plan(Node& node);
  void remember_keys();
};

void Engine::Session::add_source(const std::string& name, std::shared_ptr<Artifact> artifact) {
  if (!slots.emplace(name, Slot{std::move(artifact), nullptr}).second)
    throw Error(ExitCode::Internal, "artifact \"" + name + "\" has two makers");
}

void Engine::Session::add(std::unique_ptr<Stage> stage) {
  auto node = std::make_unique<Node>();
  node->info = stage->info();
  node->stage = std::move(stage);
  SF_EXPECT(!node->info.writes.empty());
  node->info.writes.push_back(issues_artifact(node->info.writes.front()));
  for (const std::string& name : node->info.writes)
    if (!slots.emplace(name, Slot{nullptr, node.get()}).second)
      throw Error(ExitCode::Internal, "artifact \"" + name + "\" has two makers");
  nodes.push_back(std::move(node));
}

const Slot& Engine::Session::slot(const std::string& name) const {
  const auto found = slots.find(name);
  if (found == slots.end()) throw Error(ExitCode::Internal, "nobody makes artifact \"" + name + "\"");
  return found->second;
}

std::shared_ptr<Artifact> Engine::Session::artifact(const std::string& name) const {
  const std::lock_guard lock(mutex);
  return slot(name).artifact;
}

Artifact::Loader Engine::Session::loader(const Digest& digest) {
  return [this, digest] { return cache.blob(digest); };
}

void Engine::Session::compute_key(Node& node) const {
  std::vector<Digest> inputs;
  for (const std::string& name : node.info.reads) inputs.push_back(artifact(name)->digest());
  node.key = stage_key(*node.stage, node.info, options.build, inputs);
}

// Takes the outputs of an earlier run; they are loaded when somebody asks.
void Engine::Session::adopt(Node& node, const Manifest& manifest) {
  SF_EXPECT(manifest.outputs.size() == node.info.writes.size());
  const std::lock_guard lock(mutex);
  for (std::size_t i = 0; i < manifest.outputs.size(); ++i) {
    const Manifest::Output& output = manifest.outputs[i];
    slots.at(node.info.writes[i]).artifact =
        std::make_shared<Artifact>(output.digest, output.size, loader(output.digest));
  }
  node.result.status = StageStatus::Hit;
  node.result.issues = manifest.issues;
  node.result.cost = manifest.cost;
}

std::string Engine::Session::reason(const Node& node) {
  if (options.session.empty()) return "not in the cache";
  const std::lock_guard lock(mutex);
  if (!last_keys) last_keys = cache.last_keys(options.session);
  const auto last = last_keys->find(node.info.label());
  if (last == last_keys->end()) return why_run(node.info, node.key, std::nullopt, std::nullopt);
  return why_run(node.info, node.key, last->second, cache.peek(last->second));
}

std::vector<std::shared_ptr<Artifact>> Engine::Session::execute(Node& node, IssueSink& issues,
                                                                StageCost& cost) {
  StageInput::Artifacts inputs;
  for (const std::string& name : node.info.reads) {
    ensure(name);
    inputs[name] = artifact(name);
  }
  const StageInput in(std::move(inputs));
  StageOutput out(node.info);
  const Stopwatch watch(options.jobs == 1);
  node.stage->run(in, out, issues);
  cost = watch.cost();
  out.put(node.info.writes.back(), issues.issues());
  return out.take();
}

// Makes fresh outputs known. Two stages with one key (a file used under two names) must give the same bytes;
// if not, something that changes the result is missing from the key, and whichever manifest is stored last
// would answer for both.
void Engine::Session::accept(const Node& node, const std::vector<std::shared_ptr<Artifact>>& outputs) {
  const std::lock_guard lock(mutex);
  const Node& twin = *ran.emplace(node.key.digest, &node).first->second;
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const auto& other = slots.at(twin.info.writes[i]).artifact;
    if (other && other->digest() != outputs[i]->digest())
      throw Error(ExitCode::NotReproducible,
                  "gave other bytes than " + twin.info.label() + ", which has the same key (artifact \"" +
                      node.info.writes[i] + "\"): a parameter is missing from add_to_key");
  }
  for (std::size_t i = 0; i < outputs.size(); ++i) slots.at(node.info.writes[i]).artifact = outputs[i];
}

// Blobs first, the manifest that names them last; when the cache refuses, the bytes stay in memory.
void Engine::Session::store(Node& node, const std::vector<std::shared_ptr<Artifact>>& outputs) {
  Manifest manifest{.key = node.key.digest,
                    .build = node.key.build,
                    .stage = node.info.name,
                    .instance = node.info.instance,
                    .version = node.info.version,
                    .parameters = node.key.parameters,
                    .inputs = node.key.inputs,
                    .outputs = {},
                    .issues = node.result.issues,
                    .cost = node.result.cost};
  bool is_stored = true;
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const Digest& digest = outputs[i]->digest();
    manifest.outputs.push_back({node.info.writes[i], digest, outputs[i]->size()});
    if (cache.put_blob(digest, *outputs[i]->bytes()))
      outputs[i]->stored(loader(digest));
    else
      is_stored = false;
  }
  if (is_stored) cache.put(manifest);
}

// After this the artifact can be read: a lost or damaged result is made again by its stage.
void Engine::Session::ensure(const std::string& name) {
  if (artifact(name)->try_load()) return;
  Node* maker = slot(name).maker;
  SF_EXPECT(maker != nullptr);  // the loader of a source throws
  remake(*maker, name);
}

void Engine::Session::remake(Node& node, const std::string& wanted) {
  const std::lock_guard alone(node.remaking);
  if (artifact(wanted)->try_load() && artifact(wanted)->bytes()) return;  // somebody else did
  IssueSink issues;
  StageCost cost;
  const auto outputs = execute(node, issues, cost);
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const auto old = artifact(node.info.writes[i]);
    if (outputs[i]->digest() != old->digest())
      throw Error(ExitCode::NotReproducible,
                  "stage " + node.info.label() +
                      " made other bytes than before from equal inputs (artifact \"" + node.info.writes[i] +
                      "\")");
    old->restore(*outputs[i]->bytes());
  }
  {
    const std::lock_guard lock(mutex);
    node.result.status = StageStatus::Ran;
    node.result.reason = "its result in the cache was missing or damaged";
    node.result.cost = cost;
  }
  store(node, outputs);
}

void Engine::Session::process(Node& node) {
  if (const Node* failed = failed_maker(node)) {
    node.result.status = StageStatus::Skipped;
    node.result.reason =
        failed->info.label() + (failed->result.status == StageStatus::Failed ? " failed" : " was skipped");
    return;
  }
  compute_key(node);
  node.result.key = node.key.digest;
  if (const auto manifest = cache.find(node.key.digest)) return adopt(node, *manifest);

  node.result.reason = reason(node);
  if (options.observer) {
    const std::lock_guard lock(observing);
    options.observer->on_start(node.info);
  }
  IssueSink issues;
  const auto outputs = execute(node, issues, node.result.cost);
  node.result.issues = issues.issues();
  node.result.status = StageStatus::Ran;
  accept(node, outputs);
  store(node, outputs);
}

void Engine::Session::process_safely(Node& node) {
  const auto fail = [&](ExitCode code, const std::string& message) {
    node.result.status = StageStatus::Failed;
    node.result.code = code;
    node.result.error = message;
  };
  try {
    process(node);
  } catch (const Error& error) {
    fail(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    fail(ExitCode::StageFailed, "not enough memory");
  } catch (const std::exception& error) {
    fail(ExitCode::Internal, error.what());
  }
  finish(node);
}

void Engine::Session::finish(Node& node) {
  {
    const std::lock_guard lock(mutex);
    node.result.info = node.info;
    node.is_done = true;
  }
  if (!options.observer) return;
  const std::lock_guard lock(observing);
  options.observer->on_finish(node.result);
}

std::vector<Node*> Engine::Session::pending() const {
  std::vector<Node*> open;
  for (const auto& node : nodes)
    if (!node->is_done) open.push_back(node.get());
  for (const Node* node : open)
    for (const std::string& name : node->info.reads) slot(name);  // throws when nobody makes it
  return open;
}

// The pending nodes that make these artifacts, and those they need, in the order they were added.
std::vector<Node*> Engine::Session::needed_for(const std::vector<std::string>& artifacts) const {
  std::set<const Node*> needed;
  std::vector<std::string> open = artifacts;
  while (!open.empty()) {
    const Node* maker = slot(open.back()).maker;
    open.pop_back();
    if (!maker || !needed.insert(maker).second) continue;
    open.insert(open.end(), maker->info.reads.begin(), maker->info.reads.end());
  }
  std::vector<Node*> nodes_in_order = pending();
  std::erase_if(nodes_in_order, [&](const Node* node) { return !needed.contains(node); });
  return nodes_in_order;
}

Schedule Engine::Session::schedule(const std::vector<Node*>& tasks) const {
  std::map<const Node*, std::size_t> index;
  for (std::size_t i = 0; i < tasks.size(); ++i) index[tasks[i]] = i;
  std::vector<std::set<std::size_t>> waits_for(tasks.size());
  for (std::size_t i = 0; i < tasks.size(); ++i)
    for (const std::string& name : tasks[i]->info.reads)
      if (const auto maker = index.find(slot(name).maker); maker != index.end())
        waits_for[i].insert(maker->second);
  return Schedule(waits_for);
}

void Engine::Session::run(const std::vector<Node*>& tasks) {
  Schedule order = schedule(tasks);
  const auto work = [&] {
    while (const auto task = order.take()) {
      process_safely(*tasks[*task]);
      order.done(*task);
    }
  };
  std::vector<std::thread> helpers;
  for (std::size_t i = 1; i < std::min(options.jobs, tasks.size()); ++i) helpers.emplace_back(work);
  work();
  for (std::thread& helper : helpers) helper.join();
  remember_keys();
}

// The first maker of an input that failed or was skipped.
const Node* Engine::Session::failed_maker(const Node& node) const {
  const std::lock_guard lock(mutex);
  for (const std::string& name : node.info.reads) {
    const Node* maker = slot(name).maker;
    if (!maker || !maker->is_done) continue;
    if (maker->result.status == StageStatus::Failed || maker->result.status == StageStatus::Skipped)
      return maker;
  }
  return nullptr;
}

StagePlan Engine::Session::plan(Node& node) {
  for (const std::string& name : node.info.reads)
    if (!artifact(name)) return {node.info, PlanState::Waits, "waits for " + slot(name).maker->info.label()};
  compute_key(node);
  const auto manifest = cache.find(node.key.digest);
  if (!manifest) return {node.info, PlanState::Run, reason(node)};
  adopt(node, *manifest);
  return {node.info, PlanState::Hit, {}};
}

// Keeps the keys of this session for the reasons of the next; writes only when something changed.
void Engine::Session::remember_keys() {
  if (options.session.empty()) return;
  if (!last_keys) last_keys = cache.last_keys(options.session);
  std::map<std::string, Digest> keys = *last_keys;
  for (const auto& node : nodes)
    if (node->result.status == StageStatus::Hit || node->result.status == StageStatus::Ran)
      keys[node->info.label()] = node->key.digest;
  if (keys == *last_keys) return;
  cache.put_last_keys(options.session, keys);
  last_keys = std::move(keys);
}

Engine::Engine(Cache& cache, EngineOptions options)
    : session_(std::make_unique<Session>(cache, std::move(options))) {}
Engine::~Engine() = default;

void Engine::put_artifact(const std::string& name, std::shared_ptr<Artifact> artifact) {
  session_->add_source(name, std::move(artifact));
}

void Engine::put_source(const std::string& name, const Digest& digest, std::uint64_t size,
                        std::function<Bytes()> load) {
  auto checked = [digest, name, load = std::move(load)]() -> std::optional<Bytes> {
    Bytes bytes = load();
    if (sha256(bytes) != digest) throw Error(ExitCode::BadInput, name + ": changed while it was read");
    return bytes;
  };
  session_->add_source(name, std::make_shared<Artifact>(digest, size, std::move(checked)));
}

void Engine::add(std::unique_ptr<Stage> stage) {
  session_->add(std::move(stage));
}

void Engine::add(std::vector<std::unique_ptr<Stage>> stages) {
  for (auto& stage : stages) session_->add(std::move(stage));
}

void Engine::run() {
  session_->run(session_->pending());
}

void Engine::run_for(const std::vector<std::string>& artifacts) {
  session_->run(session_->needed_for(artifacts));
}

std::vector<StageInfo> Engine::stages() const {
  std::vector<StageInfo> infos;
  for (const auto& node : session_->nodes) infos.push_back(node->info);
  return infos;
}

std::vector<StagePlan> Engine::plan() {
  const std::vector<Node*> nodes = session_->pending();
  std::vector<StagePlan> plans(nodes.size());
  Schedule order = session_->schedule(nodes);
  while (const auto task = order.take()) {
    plans[*task] = session_->plan(*nodes[*task]);
    order.done(*task);
  }
  return plans;
}

std::vector<StageResult> Engine::results() const {
  std::vector<StageResult> results;
  for (const auto& node : session_->nodes)
    if (node->is_done) results.push_back(node->result);
  return results;
}

bool Engine::is_ok() const {
  return std::all_of(session_->nodes.begin(), session_->nodes.end(), [](const auto& node) {
    return !node->is_done || node->result.status == StageStatus::Hit ||
           node->result.status == StageStatus::Ran;
  });
}

bool Engine::has(const std::string& name) const {
  const auto found = session_->slots.find(name);
  return found != session_->slots.end() && found->second.artifact;
}

const Digest& Engine::digest(const std::string& name) const {
  SF_EXPECT(has(name));
  return session_->slot(name).artifact->digest();
}

std::uint64_t Engine::size(const std::string& name) const {
  SF_EXPECT(has(name));
  return session_->slot(name).artifact->size();
}

const Artifact& Engine::loaded(const std::string& name) {
  SF_EXPECT(has(name));
  session_->ensure(name);
  return *session_->slot(name).artifact;
}

Bytes Engine::bytes(const std::string& name) {
  const Artifact& artifact = loaded(name);
  std::optional<Bytes> bytes = artifact.bytes();
  if (!bytes) {
    session_->remake(*session_->slot(name).maker, name);
    bytes = artifact.bytes();
  }
  return *std::move(bytes);
}

}  // namespace skinforge

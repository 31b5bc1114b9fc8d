#include "pipeline/engine.h"

#include <algorithm>
#include <set>
#include <system_error>
#include <thread>

#include "base/expect.h"
#include "pipeline/engine_session.h"

namespace skinforge {

std::vector<Engine::Node*> Engine::Session::pending() const {
  std::vector<Node*> open;
  for (const auto& node : nodes)
    if (!node->is_done) open.push_back(node.get());
  for (const Node* node : open)
    for (const std::string& name : node->info.reads) slot(name);  // throws when nobody makes it
  return open;
}

// The pending nodes that make these artifacts, and those they need, in the order they were added.
std::vector<Engine::Node*> Engine::Session::needed_for(const std::vector<std::string>& artifacts) const {
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
  std::once_flag once;
  call_helpers = [&] {
    std::call_once(once, [&] {
      try {
        for (std::size_t i = 1; i < std::min(options.jobs, tasks.size()); ++i) helpers.emplace_back(work);
      } catch (const std::system_error&) {  // no more threads to be had; those there are do all the work
      }
    });
  };
  work();
  for (std::thread& helper : helpers) helper.join();
  remember_run();
}

StagePlan Engine::Session::plan(Node& node) {
  StagePlan plan{node.info, PlanState::Waits, {}, {}};
  std::vector<std::optional<Digest>> inputs;
  for (const std::string& name : node.info.reads) {
    const auto input = artifact(name);
    inputs.push_back(input ? std::optional(input->digest()) : std::nullopt);
    if (!input && plan.reason.empty()) plan.reason = "waits for " + slot(name).maker->info.label();
  }
  if (!plan.reason.empty()) {
    node.key = partial_stage_key(*node.stage, node.info, options.build, inputs);
    plan.changes = changes(node, earlier_run());
    return plan;
  }
  compute_key(node);
  plan.changes = changes(node, earlier_run());
  const auto manifest = cache.find(node.key.digest);
  plan.state = manifest ? PlanState::Hit : PlanState::Run;
  if (manifest)
    adopt(node, *manifest);
  else
    plan.reason = reason(node);
  if (!manifest && plan.changes.empty()) plan.changes = {{KeyChange::Kind::EntryLost}};
  return plan;
}

// Keeps the keys of this session for the reasons of the next; writes only when something changed. The run
// before moves to the past ones once.
void Engine::Session::remember_run() {
  if (options.session.empty()) return;
  const RunRecord& before = earlier_run();
  const RunRecord written = run_now;
  for (const auto& node : nodes)
    if (node->result.status == StageStatus::Hit || node->result.status == StageStatus::Ran)
      run_now.note(node->info.label(), node->key.digest, options.settings);
  run_now.tidy();
  if (run_now == written) return;
  if (written == before && !before.stages.empty()) cache.put_past_run(options.session, before);
  cache.put_last_run(options.session, run_now);
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

FileDigests& Engine::digests() {
  return session_->options.digests ? *session_->options.digests : session_->own_digests;
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

std::vector<std::vector<KeyChange>> Engine::changes_since(const RunRecord& run) {
  std::vector<std::vector<KeyChange>> changes;
  for (const Node* node : session_->pending()) changes.push_back(session_->changes(*node, run));
  return changes;
}

std::map<std::string, std::vector<HashedField>> Engine::parameters() const {
  std::map<std::string, std::vector<HashedField>> parameters;
  for (const auto& node : session_->nodes)
    parameters[node->info.label()] = stage_key(*node->stage, node->info, {}, {}).parameters;
  return parameters;
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
  const std::shared_ptr<const Bytes> bytes = artifact.bytes();
  SF_EXPECT(bytes != nullptr);
  return *bytes;
}

}  // namespace skinforge

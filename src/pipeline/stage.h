#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/hash.h"
#include "base/issue.h"
#include "pipeline/artifact.h"

namespace skinforge {

/// What a stage is called, and which artifacts it takes and makes.
struct StageInfo {
  std::string name;           ///< what it does: "import", "map_joints"
  std::string instance = {};  ///< which one, where there are several: "horse", a clip's name; never part of a
                              ///< key, so no result may depend on it
  int version = 1;            ///< raise when equal inputs give other outputs: part of the key
  std::vector<std::string> reads = {};   ///< artifacts, e.g. "character:horse"; only their digests, in this
                                         ///< order, are part of the key
  std::vector<std::string> writes = {};  ///< artifacts; each must be put

  /// What stands before the name of the first artifact written: "body/" for the stages of a recipe used as
  /// the input "body", empty for those of the recipe itself.
  std::string_view prefix() const;
  /// "import horse", "map_joints", "body/import man": one for each stage of a session.
  std::string label() const;
};

/// Name of the artifact that holds the issues of a stage (std::vector<Issue>), from the name of its first
/// output. The engine adds it to what each stage writes, so that a later stage can report them.
std::string issues_artifact(const std::string& first_output);

/// The artifacts that a stage declared in `reads`, and no others.
class StageInput {
 public:
  using Artifacts = std::map<std::string, std::shared_ptr<Artifact>, std::less<>>;
  explicit StageInput(Artifacts artifacts) : artifacts_(std::move(artifacts)) {}

  /// The value of a declared artifact: decoded when first asked for, shared with the other readers, alive
  /// while the engine is. Call it before a parallel loop rather than inside. Throws Error (Internal) for a
  /// name that was not declared, or the wrong type.
  template <class T>
  const T& get(std::string_view name) const {
    return artifact(name).get<T>();
  }
  const Digest& digest(std::string_view name) const { return artifact(name).digest(); }

 private:
  friend class StageOutput;
  const std::shared_ptr<Artifact>& shared(std::string_view name) const;
  const Artifact& artifact(std::string_view name) const { return *shared(name); }
  Artifacts artifacts_;
};

/// Takes the artifacts that a stage declared in `writes`.
class StageOutput {
 public:
  explicit StageOutput(const StageInfo& info) : info_(info) {}

  /// Hands over one declared artifact, once. Throws Error (Internal) for a name that was not declared or was
  /// put before.
  template <class T>
  void put(std::string_view name, T value) {
    expect_open(name);
    artifacts_.emplace(std::string(name), Artifact::of(std::move(value)));
  }

  /// Hands over an input as it is: nothing is copied, encoded or hashed anew.
  void pass(std::string_view name, const StageInput& in, std::string_view input);

  /// What was put, in the order of `writes`. Throws Error (Internal) when one is missing.
  std::vector<std::shared_ptr<Artifact>> take() const;

 private:
  void expect_open(std::string_view name) const;
  const StageInfo& info_;
  std::map<std::string, std::shared_ptr<Artifact>, std::less<>> artifacts_;
};

/// One step of a build. It sees only what its key hashes: the parameters it holds and the artifacts it
/// declared. Equal keys must give equal bytes, on any number of threads.
class Stage {
 public:
  virtual ~Stage() = default;
  /// Constant for the life of the stage.
  virtual StageInfo info() const = 0;
  /// Adds every parameter that can change the result, under a name that means something to the user ("why
  /// did it run?" prints it).
  virtual void add_to_key(Hasher& key) const = 0;
  /// Makes the outputs. Issues are stored with them and told again on every hit. Whatever it throws fails the
  /// stage, and nothing is stored.
  virtual void run(const StageInput& in, StageOutput& out, IssueSink& issues) const = 0;
};

}  // namespace skinforge

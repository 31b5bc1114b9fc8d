#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/hash.h"
#include "pipeline/stage.h"

namespace skinforge {

/// The key of a stage with what went into it.
struct StageKey {
  Digest digest;
  std::string build;
  std::vector<HashedField> parameters;
  std::vector<HashedField> inputs;  ///< artifact name and digest; an empty value is not known yet
};

/// SHA-256 over tool build, stage name, version, parameters and the digests of what it reads, in order
/// (`inputs`: one per `info.reads`). Names of artifacts and the instance stay out: the same work under
/// another name is a hit.
StageKey stage_key(const Stage& stage, const StageInfo& info, const std::string& build,
                   const std::vector<Digest>& inputs);

/// The same as far as it is known: no value for inputs that have to be made first, and a digest that is none.
StageKey partial_stage_key(const Stage& stage, const StageInfo& info, const std::string& build,
                           const std::vector<std::optional<Digest>>& inputs);

}  // namespace skinforge

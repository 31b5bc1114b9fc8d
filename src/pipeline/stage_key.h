#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/cache.h"
#include "pipeline/stage.h"

namespace skinforge {

/// The key of a stage with what went into it.
struct StageKey {
  Digest digest;
  std::string build;
  std::vector<HashedField> parameters;
  std::vector<HashedField> inputs;  ///< artifact name and digest
};

/// SHA-256 over tool build, stage name, version, parameters and the digests of what it reads, in order
/// (`inputs`: one per `info.reads`). Names of artifacts and the instance stay out: the same work under
/// another name is a hit.
StageKey stage_key(const Stage& stage, const StageInfo& info, const std::string& build,
                   const std::vector<Digest>& inputs);

/// Why a stage whose key is not in the cache has to run, compared with its last run: "parameter scale: 1 ->
/// 1.2; input field changed", at most eight changes. `last_key`: none if it never ran; `last`: none if that
/// run is no longer stored.
std::string why_run(const StageInfo& info, const StageKey& now, const std::optional<Digest>& last_key,
                    const std::optional<Manifest>& last);

}  // namespace skinforge

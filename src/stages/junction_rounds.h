#pragma once

#include <vector>

#include "stages/junction_symmetry.h"

namespace skinforge {

/// All junctions of a build, and what they leave of the sources.
struct JunctionRound {
  std::vector<PreservedSource> sources;  ///< by SourceId, with clean borders
  std::vector<Junction> junctions;       ///< per operation; empty where another's joins it, too
  std::vector<int> arcs;                 ///< per operation: borders left open because they end on an open hem
  JunctionFaults faults;                 ///< of all
};

/// Makes the junctions of `sites` between what `sources` preserve (Sec. 6.1). Where junctions cut preserved
/// faces those are given up and all are made anew; of all rounds the one with the least faults counts.
/// `operations`: of the recipe.
JunctionRound make_junctions(const std::vector<JunctionSite>& sites, std::vector<PreservedSource> sources,
                             std::size_t operations, const PreserveOptions& options);

}  // namespace skinforge

#pragma once

#include <span>

#include "skinning/junction_shares.h"

namespace skinforge {

struct WeightTransferOptions {
  std::size_t influences = 4;  ///< N of Sec. 7.1 at new vertices: 4 or 8
  /// Ours: passes of Laplacian smoothing over the new vertices; 0 is the paper's method. Ten were chosen by
  /// measuring (weight_transfer.md): fewer leave steps, more change nothing or let the cut to 4 joints bite.
  int smoothing_passes = 10;
};

/// The largest change of weights along one edge (`row_distance`, in [0, 2]): a large one inside a junction
/// tears it in motion.
struct WeightSteps {
  double junction = 0;    ///< over edges with a new vertex, or between preserved parts of two sources
  double neighbours = 0;  ///< over edges of preserved parts with an end within two edges of a junction
};
WeightSteps weight_steps(const SkinWeights& weights, const ResultSurface& result);

struct TransferredWeights {
  SkinWeights weights;  ///< one row a result vertex, joints of the result's skeleton; never empty, sums to 1
  WeightSteps blended;  ///< before smoothing
  WeightSteps steps;    ///< as returned
  std::size_t filled_rows = 0;  ///< rows that came out empty and were taken from a neighbour
};

/// W_R (SkinMixer Sec. 7.1). `shares` as `junction_shares` gives for the same arguments.
///  - A preserved vertex keeps its row through the joint map (`retargeted_row`): with full confidence the
///  artist's weights
///    to the bit, however many there are.
///  - A new vertex takes the retargeted rows at the closest points of the sources, mixed by its shares, then
///  smoothed, then
///    cut to the `influences` largest.
///  - A row that comes out empty takes that of the nearest vertex along the result mesh (fewest edges, then
///  the shortest
///    last edge, then the lowest id), else of the nearest in space, else joint 0 alone.
/// Throws nothing of its own. Linear but for the last resort.
TransferredWeights transfer_weights(const ResultSurface& result, std::span<const SourceSurface> sources,
                                    const JunctionShares& shares, const WeightTransferOptions& options = {});

}  // namespace skinforge

#pragma once

#include <functional>
#include <span>
#include <vector>

#include "deform/deformer.h"

namespace skinforge {

/// A frame to reproduce: where linear blending gets its matrices, and where the vertices shall be.
struct CorrectiveFrame {
  std::vector<Affine3> palette;
  std::vector<Vec3> goal;  ///< #V
};

struct CorrectiveOptions {
  std::size_t targets = 8;  ///< at most
  double enough = 0;        ///< metres: no more targets once the largest error is below; 0 = all of them
  std::size_t basis = 192;  ///< ours: at most so many frames, evenly spread, decide on the targets
};

/// Morph targets and their weights such that linear blending of (rest + sum of weight * target) comes near
/// the goals: glTF's order, morph first, skin after. All values are already rounded to float, as files hold
/// them.
struct Correctives {
  std::vector<std::vector<Vec3>> targets;    ///< [target][#V]: offsets at rest, metres
  std::vector<std::vector<double>> weights;  ///< [frame][target]; the largest of each target is 1 in size
  double before = 0;             ///< largest distance of linear blending alone from the goals, metres
  double largest = 0;            ///< the same with the targets
  double rms = 0;                ///< over all vertices of all frames
  std::vector<double> by_count;  ///< largest error with 0, 1, 2, ... targets
  std::size_t damped = 0;        ///< (vertex, frame) pairs that no offset reaches (`unpose`)
};

/// The largest distance of linear blending of (rest + sum of `blend(i)` times `targets`) from `frame(i)`,
/// over i in [0, count): how well targets do in frames that they were not made of. Metres. Parallel.
double replay_error(std::span<const Vec3> rest, const SkinWeights& weights,
                    std::span<const std::vector<Vec3>> targets, std::size_t count,
                    const std::function<CorrectiveFrame(std::size_t)>& frame,
                    const std::function<std::vector<double>(std::size_t)>& blend);

/// The few targets that lose least: goals are unposed against `weights` (those that will be written, after
/// cut and rounding), and the offsets of all frames decomposed (`find_morph_basis`); weights are the least
/// squares coefficients of each frame. `frame(i)`: called for i in [0, count), possibly twice. Zero weights
/// give rest. Cost: frames^2 * vertices for the decomposition.
Correctives bake_correctives(std::span<const Vec3> rest, const SkinWeights& weights, std::size_t count,
                             const std::function<CorrectiveFrame(std::size_t)>& frame,
                             const CorrectiveOptions& options = {});

/// The exact form for examples (ETH Eq. 7): the targets are the deltas of the examples, the weights of a
/// frame are a_j. `deformer`: of method Context, made with the weights that will be written.
Correctives example_correctives(std::span<const Vec3> rest, const SkinWeights& weights,
                                const Deformer& deformer, std::size_t count,
                                const std::function<PosedBones(std::size_t)>& frame);

}  // namespace skinforge

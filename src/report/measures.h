#pragma once

#include "report/report.h"

namespace skinforge {

struct Character;

/// Counts and size of an input; name, file, sha256, format and repairs are the caller's.
InputReport measure_input(const Character& character);

/// Counts and size of the result's mesh. `kept_faces`: how many of its faces are copies. Components and
/// inherited edges are the caller's.
MeshReport measure_mesh(const PolygonMesh& mesh, std::int64_t kept_faces);

/// Sums, influences and idle joints of a skin whose rows name joints of `skeleton`, when at most `limit`
/// influences of a row are written, and what that cuts. No vertices: sums of 0.
WeightsReport measure_weights(const SkinWeights& weights, const Skeleton& skeleton, std::size_t limit);

/// Number of keys over all tracks of a clip.
std::int64_t count_keys(const Clip& clip);

/// How an operation's placement is written down.
void set_placement(OperationReport& operation, const Similarity& model_from_input);

}  // namespace skinforge

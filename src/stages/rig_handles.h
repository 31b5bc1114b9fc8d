#pragma once

#include "stages/rigging.h"

/// Handles (ETH Sec. 4.1) from everything but the geometric rule, for a character that has its skeleton.
namespace skinforge {

/// By vertices of the model's file: a .dmat of labels by bone, or JSON {"joint name": [vertices]}. Throws
/// Error (BadInput) with file and place.
Handles read_handles(const InputFile& file, const Rigged& rigged);

/// From a painted image (PNG or JPEG) that the first UV set looks up. Throws Error (BadInput) where it is no
/// image, where `colors` names a joint that is not there, and where it holds no vertex.
Handles read_painted_handles(const InputFile& file, const std::map<std::string, Color8>& colors,
                             const Rigged& rigged);

/// The joints of `donor` that hold more than `threshold` of a row: at the same vertex where the meshes are
/// one, else at the point of the donor's surface nearest to each vertex of `character`. Joints are matched by
/// name. Throws Error (BadInput) where no joint of the donor has a name of `character`, or nothing comes out.
Handles handles_of_skin(const Character& donor, double threshold, const Character& character);

/// The handles as JSON, as `read_handles` takes them: joints in skeleton order, vertices rising.
std::string handles_json(const Rigged& rigged);

}  // namespace skinforge

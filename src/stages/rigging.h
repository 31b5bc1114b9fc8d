#pragma once

#include <string>
#include <vector>

#include "io/import.h"
#include "model/character.h"
#include "recipe/recipe.h"
#include "skeleton/pose.h"
#include "skinning/bind_skin.h"

/// A model without skin, the bones of another file, and clips of rotations become one character. Shared by
/// the import stage and by the verbs that work on single models.
namespace skinforge {

/// A character whose skin was made here, and how its parts count in the files it came from.
struct Rigged {
  Character character;
  std::vector<JointId> joint_of_bone;  ///< of the skeleton's file: bones of a .tgf, joints of a model
  std::vector<VertexId>
      vertex_of_file;  ///< vertex of the character of each vertex of an .obj or .off; else empty
  Handles handles;     ///< what held the weights
};

struct RigFiles {
  std::vector<InputFile> model;  ///< as `read_input_files` gives
  std::vector<InputFile> skeleton;
  std::optional<InputFile> handles = {};
  std::vector<InputFile> poses = {};  ///< .dmat files; a name ending in "_target" is a pose to go to
};

/// Reads and binds. Clips: those of a model that gives the skeleton, then one for each file of poses, called
/// after it. Throws Error (BadInput) with the file where something is broken or does not fit.
Rigged read_rigged(const RigFiles& files, const RecipeBind& bind, IssueSink& issues);

/// Reads one pose of a .dmat file as a pose of the character.
Pose read_pose(const InputFile& file, const Rigged& rigged);

/// Reads a shape whose vertices count as those of the model's file: #V of the character.
std::vector<Vec3> read_shape(const InputFile& file, const Rigged& rigged);

/// Handles by vertices of the model's file: a .dmat of labels by bone, or JSON {"joint name": [vertices]}.
Handles read_handles(const InputFile& file, const Rigged& rigged);

/// The weights as a table, #vertices of the file x #bones; where the file's vertices are not known, #V.
Eigen::MatrixXd weight_table(const Rigged& rigged);
/// The handles likewise, one column, bones from 0, -1 = free.
Eigen::MatrixXd handle_table(const Rigged& rigged);

}  // namespace skinforge

#pragma once

#include <map>
#include <string>
#include <vector>

#include "io/import.h"
#include "model/character.h"
#include "recipe/recipe.h"
#include "skeleton/bone_rig.h"
#include "skeleton/pose.h"
#include "skinning/bind_skin.h"

/// A model, the bones of a file, and clips become one character with a skin made here. Shared by the rig
/// stage and by the verbs that work on single models.
namespace skinforge {

/// A character whose skin was made here, and how its parts count in the files it came from.
struct Rigged {
  Character character;
  std::vector<JointId> joint_of_bone;  ///< of the skeleton's file: bones of a .tgf, joints of a model
  std::vector<VertexId>
      vertex_of_file;  ///< of an .obj or .off as the file counts; else each vertex is its own
  Handles handles;     ///< what held the weights
};

struct RigFiles {
  std::vector<InputFile> model;                    ///< as `read_input_files` gives
  std::vector<InputFile> skeleton = {};            ///< empty: the model's own, with its clips
  std::vector<InputFile> handles = {};             ///< one, of RecipeHandles::Labels and Image
  std::vector<std::vector<InputFile>> clips = {};  ///< .dmat files, or models whose clips are taken
};

/// Reads and binds. Clips: those of the model that gives the skeleton, then those of each file. A .dmat of
/// rotations is a clip called after its file; one whose name ends in "_target" is a pose to go to. Throws
/// Error (BadInput) with the file where something is broken or does not fit.
Rigged read_rigged(const RigFiles& files, const RecipeBind& bind, IssueSink& issues);

/// A model as it is, with its own skin.
Rigged as_rigged(Character character);

/// Adds the clips of a file: rotations of a .dmat at `rate_hz`, or those of a model, joints matched by name.
/// `files` as `read_input_files` gives.
void add_clips(const std::vector<InputFile>& files, double rate_hz, Rigged& rigged, IssueSink& issues);

/// Rotations of all bones of `rigged`, frame by frame, of a .dmat file. Throws Error (BadInput) with the
/// file.
RotationFrames read_frames(const InputFile& file, const Rigged& rigged);

}  // namespace skinforge

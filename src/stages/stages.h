#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "animation/completion.h"
#include "io/export.h"
#include "pipeline/stage.h"
#include "recipe/recipe.h"
#include "skeleton/graft.h"
#include "stages/artifacts.h"
#include "surface/preserved.h"
#include "surface/site_field.h"

/// The stages of a build, in order: one function each, one small file each (src/stages/<name>_stage.cpp). A
/// stage takes artifacts, calls one algorithm and stores artifacts; its parameters are what it was made with.
namespace skinforge {

using StagePointer = std::unique_ptr<Stage>;

/// file:* -> imported:<input>, contents. `files`: name of each file, the character first, then those of the
/// clip files; `clip_files`: for each clip file, how many of the last entries belong to it.
struct ImportParameters {
  std::string input;
  std::vector<std::vector<std::string>> file_names;  ///< the character's files, then each clip file's
};
StagePointer make_import_stage(const ArtifactNames& names, ImportParameters parameters);

/// file:* -> imported:<input>, contents, examples:<input>: an input whose skin is made here takes this in the
/// place of the import stage.
enum class RigRole : std::uint8_t { Model, Skeleton, HandleFile, Clips, ExampleShape, ExamplePose };
struct RigFile {
  std::string name;
  RigRole role = RigRole::Model;
  bool is_first = true;  ///< false: a file that the one before names (buffers, images)
};
struct RigParameters {
  std::string input;
  RecipeBind bind;
  std::vector<RigFile> files;  ///< in the order of file:*
};
StagePointer make_rig_stage(const ArtifactNames& names, RigParameters parameters);

/// imported:<input> -> character:<input>: poses it before it is mixed (Sec. 4.1).
StagePointer make_pose_stage(const ArtifactNames& names, const RecipeInput& input);

/// <nested>result, <nested>contents:* -> imported:<input>, contents: a finished recipe as an input of
/// another.
StagePointer make_adopt_stage(const ArtifactNames& names, const ArtifactNames& nested,
                              const RecipeInput& input);

/// character:* -> asked_placement: operations with their placements (Sec. 4.1).
StagePointer make_place_stage(const ArtifactNames& names, const Recipe& recipe);

/// character:*, asked_placement -> placement: parts turned back whose surfaces would not join (Sec. 4.1, Fig.
/// 17).
StagePointer make_turn_stage(const ArtifactNames& names, const Recipe& recipe);

/// character:*, placement -> graft (Sec. 4).
StagePointer make_graft_skeleton_stage(const ArtifactNames& names, const Recipe& recipe);

/// character:*, graft -> joint_maps (Sec. 5).
StagePointer make_map_joints_stage(const ArtifactNames& names, const Recipe& recipe);

/// character:*, placement, graft -> placed meshes, selection (Sec. 6).
StagePointer make_select_stage(const ArtifactNames& names, const Recipe& recipe);

/// placed, selection, graft -> field:<site> (Sec. 6.1).
StagePointer make_field_stage(const ArtifactNames& names, const Recipe& recipe, std::size_t site);

/// field:<site> -> vdb:<site>.
StagePointer make_vdb_stage(const ArtifactNames& names, std::size_t site);

/// placed, selection, graft, field:* -> surface (Sec. 6.1).
StagePointer make_junction_stage(const ArtifactNames& names, const Recipe& recipe);

/// character:*, surface, placed, selection, graft, joint_maps -> bound, shares, weight_record: the result
/// without clips and junction colours (Sec. 7).
StagePointer make_bind_stage(const ArtifactNames& names, const Recipe& recipe);

/// character:<input>, graft, joint_maps -> motion:<source> (Sec. 8.1).
StagePointer make_motion_stage(const ArtifactNames& names, std::size_t source, const std::string& input);

/// character:*, graft, motion:* -> clip:<name> (Sec. 8).
struct ClipRequest {
  std::size_t input = 0;
  std::size_t clip = 0;  ///< index in that input
  std::string name;      ///< in the result
  CompletionOptions options = {};
  bool is_animated = false;  ///< draw it as an animated picture
};
StagePointer make_complete_clip_stage(const ArtifactNames& names, const Recipe& recipe,
                                      std::size_t source_count, const ClipRequest& request);

/// bound, surface, graft, motion:*, clip:<name> -> quality:<name>: what goes wrong when it moves.
StagePointer make_quality_stage(const ArtifactNames& names, std::size_t source_count,
                                const ClipRequest& request);

/// result -> animated:<name>: the clip as an animated picture.
StagePointer make_animated_stage(const ArtifactNames& names, const ClipRequest& request);

/// bound, surface, placed, shares, character:* -> textured, color_steps (Sec. 7.2 and beyond).
StagePointer make_texture_stage(const ArtifactNames& names, const Recipe& recipe);

/// textured, clip:*, examples:<base> -> correctives: morph targets and their tracks.
StagePointer make_correct_stage(const ArtifactNames& names, const Recipe& recipe,
                                std::span<const ClipRequest> clips);

/// textured, clip:*, contents:*, correctives -> result, glb, obj, driver.
StagePointer make_export_stage(const ArtifactNames& names, const Recipe& recipe,
                               std::span<const ClipRequest> clips);

/// glb, result, issues of the imports -> validation: the file read back and compared. What an input has is no
/// fault.
StagePointer make_validate_stage(const ArtifactNames& names, const Recipe& recipe);

/// result, surface, quality:* -> picture:*.
StagePointer make_pictures_stage(const ArtifactNames& names, const Recipe& recipe,
                                 std::span<const ClipRequest> clips);

/// result, surface, graft -> view: where each triangle of the GLB comes from, as JSON for the report's page.
StagePointer make_view_stage(const ArtifactNames& names, const Recipe& recipe);

/// character:*, placement, graft, joint_maps -> preview_glb, preview_report: the parts side by side.
StagePointer make_preview_stage(const ArtifactNames& names, const Recipe& recipe,
                                std::span<const ClipRequest> clips);

/// File that a preview of the recipe is written to; never that of a build.
std::string preview_name(const Recipe& recipe);

/// Artifacts that hold the issues of all stages before the report.
struct IssueArtifacts {
  std::vector<std::vector<std::string>> of_input;  ///< of reading each input
  std::vector<std::string> of_build;               ///< of everything else
};

/// everything -> report.
StagePointer make_report_stage(const ArtifactNames& names, const Recipe& recipe,
                               std::span<const ClipRequest> clips, IssueArtifacts issues);

}  // namespace skinforge

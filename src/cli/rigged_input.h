#pragma once

#include "cli/command_line.h"
#include "cli/console.h"
#include "cli/output_folder.h"
#include "deform/deformer.h"
#include "stages/rigging.h"

namespace skinforge {

/// The model that a verb of the skinning toolkit works on: bound here by `bind`, and where the command line
/// names a skeleton, handles or a method; else with the skin it has. Issues are said on the console. Throws
/// Error like the readers.
Rigged read_rigged(const CommandLine& line, Console& console);

/// All files that the command line names as inputs.
std::vector<std::filesystem::path> input_files(const CommandLine& line);

/// Name of the model without folder and ending.
std::string model_name(const CommandLine& line);

/// The examples of the command line as a deformer takes them.
DeformOptions deform_options(const CommandLine& line, const Rigged& rigged);

/// Throws Error (Usage) with the nearest names.
JointId joint_named(const std::string& name, const Skeleton& skeleton);

/// The clip of the command line, or the first. Throws Error (Usage) with the nearest names; where the model
/// has none, too.
const Clip& chosen_clip(const CommandLine& line, const Character& character);

/// `count` times, evenly over the clip; of a single frame the end.
std::vector<double> frame_times(const Clip& clip, std::size_t count);

}  // namespace skinforge

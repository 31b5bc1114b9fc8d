#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/issue.h"
#include "model/transform.h"
#include "report/distribution.h"
#include "report/ledger.h"

/// What one build says about its result: plain data that the stages fill. `report_fields.h` gives every
/// member its name, unit and meaning in report.json; `report_json.h` and `report_text.h` write it. No times,
/// hosts or absolute paths, so equal builds give equal reports; what differs from run to run is in timings.h.
namespace skinforge {

struct ToolReport {
  std::string name = "skinforge";
  std::string version;
};

struct RecipeReport {
  std::string name;
  std::string sha256;
};

/// A file that went in or came out; its name without folders, or relative to the output folder.
struct FileReport {
  std::string name;
  std::int64_t bytes = 0;
  std::string sha256;
};

struct InputReport {
  std::string name;
  std::string file;
  std::string format;
  std::vector<FileReport> files;
  std::int64_t vertices = 0;
  std::int64_t faces = 0;
  std::int64_t quads = 0;
  std::int64_t joints = 0;
  std::int64_t clips = 0;
  std::int64_t materials = 0;
  std::int64_t images = 0;
  std::int64_t morph_targets = 0;
  std::array<double, 3> bind_size = {0, 0, 0};
  std::vector<Issue> repairs;
};

struct OperationReport {
  std::string kind;
  std::vector<std::string> at;
  std::string input;
  std::string joint;
  std::string fused_joint;
  double scale = 1;
  std::array<double, 4> rotation_xyzw = {0, 0, 0, 1};
  std::array<double, 3> translation = {0, 0, 0};
  double bend_deg = 0;
  double turned_deg = 0;
};

struct MappedJointReport {
  std::string joint;
  std::string image;
  double confidence = 0;
};

struct JointMapReport {
  std::int64_t source = 0;
  std::string input;
  std::vector<MappedJointReport> joints;
};

struct ResultJointReport {
  std::string joint;
  std::int64_t source = 0;
  std::string input;
  std::string source_joint;
};

/// How much colour jumps across a border.
struct ColorStepReport {
  std::int64_t edges = 0;
  double mean = 0;
  double p95 = 0;
  double max = 0;
};

struct SymmetryReport {
  std::int64_t image_operation = 0;
  std::string reason;
  std::array<double, 3> plane_normal = {0, 0, 0};
  double plane_offset = 0;
  double matched = 0;
  bool faces_symmetric = false;
  std::optional<double> mean_deviation;
  std::optional<double> max_deviation;
  std::optional<double> border_deviation;
};

struct JunctionReport {
  std::int64_t operation = 0;
  std::string rung;
  std::string reason;
  double voxel = 0;
  std::int64_t components = 0;
  std::vector<std::int64_t> border_loops;
  std::int64_t faces = 0;
  std::int64_t quads = 0;
  std::int64_t triangles = 0;
  std::int64_t boundary_edges = 0;
  std::int64_t non_manifold_edges = 0;
  std::int64_t degenerate_faces = 0;
  std::optional<std::int64_t> folded_faces;
  std::optional<std::int64_t> self_intersections;
  std::optional<std::int64_t> irregular_vertices;
  std::optional<double> border_continuation;
  std::optional<Distribution> scaled_jacobian;
  std::optional<Distribution> deviation;
  std::optional<Distribution> edge_length_ratio;
  std::optional<Distribution> border_dihedral;
  std::optional<Distribution> border_normal_step;
  std::optional<ColorStepReport> border_color_step;
  std::optional<SymmetryReport> symmetry;
};

struct MeshReport {
  std::int64_t vertices = 0;
  std::int64_t faces = 0;
  std::int64_t quads = 0;
  std::int64_t triangles = 0;
  std::int64_t kept_faces = 0;
  double kept_share = 0;
  std::int64_t components = 0;
  std::int64_t open_edges_inherited = 0;
  std::int64_t non_manifold_edges_inherited = 0;
  std::array<double, 3> bind_size = {0, 0, 0};
};

struct WeightsReport {
  std::int64_t max_influences = 0;
  std::int64_t cut_vertices = 0;
  double cut_weight_max = 0;
  double row_sum_min = 0;
  double row_sum_max = 0;
  std::int64_t unweighted_vertices = 0;
  std::vector<std::string> joints_without_weight;
  double junction_step = 0;
  double junction_step_blended = 0;
  double neighbour_step = 0;
  std::int64_t filled_vertices = 0;
};

/// A stretch of frames that a completed part takes from one clip, in order.
struct FrameRun {
  std::int64_t source = 0;
  std::string clip;
  double time = 0;
  double clip_begin = 0;
  double clip_end = 0;
  std::int64_t frames = 0;
};

/// What goes wrong when a clip moves the body, beyond what is wrong at rest and in the inputs.
struct PosedReport {
  std::int64_t frames = 0;
  double worst_time = 0;
  std::int64_t intersections = 0;
  std::int64_t folds = 0;
  double stretch = 0;
  double foot_sink = 0;
  double foot_slide = 0;
};

/// A limb that was turned for a whole clip.
struct TurnedLimb {
  std::string joint;
  double degrees = 0;
};

struct ClipReport {
  std::string name;
  std::string input;
  std::string source_clip;
  double duration = 0;
  std::int64_t keys = 0;
  std::int64_t driven_joints = 0;
  std::vector<FrameRun> completed_from;
  std::vector<TurnedLimb> turned_limbs;
  std::optional<double> mean_distance;
  std::int64_t jumps = 0;
  std::string playback;
  PosedReport posed;
  double fastest_turn = 0;
  std::string fastest_joint;
  double fastest_source_turn = 0;
  std::optional<double> turn_ratio;
};

/// One verdict on the result beside the golden of its recipe.
struct GoldenFindingReport {
  std::string group;
  std::string name;
  std::string text;
  bool is_over = false;
};

struct GoldenReport {
  std::string file;
  bool missing = false;
  std::vector<GoldenFindingReport> findings;
};

struct Report {
  std::int64_t report_version = 1;
  bool preview = false;
  ToolReport tool;
  RecipeReport recipe;
  std::vector<InputReport> inputs;
  std::vector<OperationReport> operations;
  Ledger ledger;
  std::vector<JointMapReport> joint_maps;
  std::vector<ResultJointReport> joints;
  std::vector<JunctionReport> junctions;
  MeshReport mesh;
  WeightsReport weights;
  std::vector<ClipReport> clips;
  std::vector<FileReport> outputs;
  std::optional<GoldenReport> golden;
  std::vector<Issue> issues;
};

}  // namespace skinforge

#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "source_model.h"
#include "testing/gltf_evaluator.h"
#include "testing/program.h"

namespace skinforge::testing {

/// A source of a finished character: the base, then one per operation that takes something.
struct PlacedSource {
  std::string input;
  const SourceModel* model = nullptr;
  Similarity placement;  ///< model space of the result from that of the source
  bool is_base = false;

  double diagonal() const { return placement.scale * model->character().mesh.diagonal(); }
};

/// The corner of a source that a vertex of the result was copied from.
struct Origin {
  int source = -1;  ///< -1: none, the vertex is new
  std::size_t corner = 0;
};

/// What `skinforge build RECIPE --report json` wrote, read back without the code that wrote it.
class FinishedCharacter {
 public:
  /// Builds into `folder`, where all builds share a cache. `arguments`: added to the command line.
  FinishedCharacter(const std::filesystem::path& recipe, const std::filesystem::path& folder,
                    const std::vector<std::string>& arguments = {});

  const ProgramResult& run() const { return run_; }
  const std::filesystem::path& glb_path() const { return glb_path_; }
  const GltfEvaluator& glb() const { return *glb_; }
  const nlohmann::json& report() const { return report_; }
  const nlohmann::json& recipe() const { return recipe_; }
  const std::vector<PlacedSource>& sources() const { return sources_; }
  const SourceModel& input(const std::string& name) const { return *inputs_.at(name); }
  const std::map<std::string, const SourceModel*>& inputs() const { return inputs_; }

  /// The number of an animation of the GLB; -1 when there is none of that name.
  int animation(const std::string& name) const;
  /// The number of a clip in its input.
  std::size_t source_clip(const nlohmann::json& clip_of_report) const;
  /// The input that each node of the GLB comes from; empty for those that are no joints.
  std::vector<std::string> inputs_of_nodes() const;
  bool has_operation(const std::string& kind) const;

  /// One per vertex of the GLB: the corner with the same position, normal and UV, to the last bit in the base
  /// and to rounding elsewhere.
  std::vector<Origin> origins() const;

 private:
  void read_sources(const std::filesystem::path& folder);

  ProgramResult run_;
  std::filesystem::path glb_path_;
  nlohmann::json recipe_, report_;
  std::unique_ptr<GltfEvaluator> glb_;
  std::map<std::string, const SourceModel*> inputs_;
  std::vector<PlacedSource> sources_;
};

/// The material of faces that no input had.
inline constexpr const char* kJunctionMaterial = "junction";

}  // namespace skinforge::testing

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <numeric>

#include "animation/sampling.h"
#include "cli/commands.h"
#include "cli/rigged_input.h"
#include "geometry/mesh_measures.h"
#include "io/export.h"
#include "render/skinning_pictures.h"
#include "report/text_table.h"
#include "stages/decoded_images.h"

namespace skinforge {
namespace {

/// One method over all frames.
struct MethodMeasures {
  std::string method;
  double largest = 0;  ///< distance from linear blending, share of the diagonal
  double mean = 0;
  double least_volume = 1;  ///< volume kept, of rest
  double most_volume = 1;
};

double volume_of(const PolygonMesh& mesh, std::span<const Vec3> positions) {
  double sum = 0;
  for (const auto& t : triangulate(mesh).triangles)
    sum += positions[t[0].index()].dot(positions[t[1].index()].cross(positions[t[2].index()]));
  return sum / 6;
}

class Comparison {
 public:
  Comparison(const Rigged& rigged, const Clip& clip, std::vector<double> times, std::size_t pictured)
      : character_(rigged.character), clip_(clip), times_(std::move(times)), pictured_(pictured) {
    rest_volume_ = volume_of(character_.mesh, character_.mesh.positions);
    for (const double time : times_)
      bones_.push_back(posed_bones(character_.skeleton, sample(character_.skeleton, clip_, time)));
  }

  void add(const Deformer& deformer) {
    MethodMeasures measures{.method = std::string(name_of(deformer.method()))};
    MethodFrames drawn{.title = measures.method};
    double sum = 0;
    for (std::size_t i = 0; i < times_.size(); ++i) {
      std::vector<Vec3> posed = deformer(bones_[i]);
      if (rows_.empty()) linear_.push_back(posed);
      std::vector<double> distance = distances(posed, linear_[i]);
      const double largest = *std::max_element(distance.begin(), distance.end());
      const double volume = volume_of(character_.mesh, posed) / rest_volume_;
      sum += std::accumulate(distance.begin(), distance.end(), 0.0);
      measures.largest = std::max(measures.largest, largest);
      measures.least_volume = std::min(measures.least_volume, volume);
      measures.most_volume = std::max(measures.most_volume, volume);
      if (!is_pictured(i)) continue;
      drawn.frames.push_back({times_[i], std::move(posed), {}});
      drawn.captions.push_back(
          fmt::format("{:.2f} s  volume {:.3f}  from lbs {:.2f} %", times_[i], volume, 100 * largest));
      if (!rows_.empty()) drawn.heat.push_back(std::move(distance));
    }
    measures.mean = sum / static_cast<double>(times_.size() * character_.mesh.vertex_count());
    rows_.push_back(measures);
    drawn_.push_back(std::move(drawn));
  }

  const std::vector<MethodMeasures>& rows() const { return rows_; }
  bool is_closed() const { return measure_topology(character_.mesh).is_closed(); }

  /// Heat is scaled to the largest distance of all methods, so that rows compare.
  std::vector<MethodFrames> pictures(bool with_heat) const {
    double largest = 0;
    for (const MethodMeasures& m : rows_) largest = std::max(largest, m.largest);
    std::vector<MethodFrames> scaled = drawn_;
    for (MethodFrames& method : scaled) {
      if (!with_heat) method.heat.clear();
      for (auto& frame : method.heat)
        for (double& d : frame) d = largest > 0 ? d / largest : 0;
    }
    return scaled;
  }

 private:
  bool is_pictured(std::size_t i) const {
    const std::size_t n = times_.size();
    for (std::size_t k = 0; k < pictured_; ++k)
      if (i == (pictured_ == 1 ? n - 1 : k * (n - 1) / (pictured_ - 1))) return true;
    return false;
  }
  std::vector<double> distances(const std::vector<Vec3>& a, const std::vector<Vec3>& b) const {
    std::vector<double> all;
    for (std::size_t v = 0; v < a.size(); ++v)
      all.push_back((a[v] - b[v]).norm() / character_.mesh.diagonal());
    return all;
  }

  const Character& character_;
  const Clip& clip_;
  std::vector<double> times_;
  std::size_t pictured_;
  double rest_volume_ = 1;
  std::vector<PosedBones> bones_;
  std::vector<std::vector<Vec3>> linear_;
  std::vector<MethodMeasures> rows_;
  std::vector<MethodFrames> drawn_;
};

std::string as_text(const Comparison& comparison, const Clip& clip, std::size_t frames) {
  TextTable table;
  table.add({"method", "from lbs: largest", "mean", "volume: least", "most"});
  for (const MethodMeasures& m : comparison.rows())
    table.add({m.method, fmt::format("{:.4f} %", 100 * m.largest), fmt::format("{:.4f} %", 100 * m.mean),
               fmt::format("{:.4f}", m.least_volume), fmt::format("{:.4f}", m.most_volume)});
  return fmt::format("clip \"{}\", {} frames; distances in % of the diagonal, volumes of that at rest{}\n{}",
                     clip.name, frames, comparison.is_closed() ? "" : " (open surface: a rough guide)",
                     table.str());
}

std::string as_json(const Comparison& comparison, const Clip& clip, std::size_t frames,
                    const std::vector<std::string>& files) {
  nlohmann::ordered_json json = {{"clip", clip.name}, {"frames", frames}, {"closed", comparison.is_closed()}};
  for (const MethodMeasures& m : comparison.rows())
    json["methods"].push_back({{"method", m.method},
                               {"largest_from_lbs", m.largest},
                               {"mean_from_lbs", m.mean},
                               {"least_volume", m.least_volume},
                               {"most_volume", m.most_volume}});
  json["files"] = files;
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

ExitCode compare_skinning_command(const CommandLine& line, Console& console) {
  const Rigged rigged = read_rigged(line, console);
  const Character& character = rigged.character;
  const Clip& clip = chosen_clip(line, character);
  constexpr std::size_t kPictured = 6;
  Comparison comparison(rigged, clip, frame_times(clip, line.skinning.frames),
                        std::min(kPictured, line.skinning.frames));
  IssueSink issues;
  for (int m = 0; m < kDeformMethods; ++m) {
    const auto method = DeformMethod(m);
    if (needs_examples(method) && line.skinning.examples.empty()) continue;
    comparison.add(Deformer(character.mesh, character.skeleton, character.weights, method,
                            deform_options(line, rigged), model_name(line), issues));
  }
  const std::string name = model_name(line);
  OutputFolder out(line.out.empty() ? "out/" + name : line.out, input_files(line));
  const std::vector<Raster> images = decoded_images(character, name, issues);
  for (const Issue& issue : issues.issues()) console.issue(issue);
  const Subject subject(character.mesh, character.materials, images);
  out.add(name + "_methods.png", encode_png(methods_picture(subject, comparison.pictures(false))));
  out.add(name + "_from_lbs.png", encode_png(methods_picture(subject, comparison.pictures(true))));
  const std::vector<std::string> files = out.write();
  for (const std::string& file : files) console.info("wrote " + file);
  const std::size_t frames = line.skinning.frames;
  print_data(line.json ? as_json(comparison, clip, frames, files) : as_text(comparison, clip, frames));
  return ExitCode::Ok;
}

}  // namespace skinforge

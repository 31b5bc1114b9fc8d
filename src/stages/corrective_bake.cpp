#include "stages/corrective_bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "animation/sampling.h"
#include "base/error.h"
#include "io/written_weights.h"

namespace skinforge {
namespace {

constexpr double kLongestStep = 1.0 / 30;  // ours: seconds between keys of weights

std::vector<Vec3> float_positions(const std::vector<Vec3>& positions) {
  std::vector<Vec3> rounded;
  for (const Vec3& p : positions) rounded.push_back(p.cast<float>().cast<double>());
  return rounded;
}

/// Every frame of every clip, one list.
class Frames {
 public:
  explicit Frames(const Character& character) : character_(character) {
    for (std::size_t c = 0; c < character.clips.size(); ++c) {
      first_.push_back(places_.size());
      for (const double time : corrective_times(character.clips[c])) places_.push_back({c, time});
    }
    first_.push_back(places_.size());
  }
  std::size_t size() const { return places_.size(); }
  std::size_t first(std::size_t clip) const { return first_[clip]; }
  double time(std::size_t i) const { return places_[i].second; }
  PosedBones bones(std::size_t i) const {
    return posed_bones(character_.skeleton,
                       sample(character_.skeleton, character_.clips[places_[i].first], places_[i].second));
  }

 private:
  const Character& character_;
  std::vector<std::pair<std::size_t, double>> places_;  ///< clip and time
  std::vector<std::size_t> first_;
};

// A target of the whole mesh as one of each part. A vertex that several parts share moves in each of them.
std::vector<MorphTarget> by_part(const PolygonMesh& mesh, const std::vector<std::vector<Vec3>>& targets,
                                 std::string_view method) {
  std::vector<std::vector<VertexId>> vertices(mesh.parts.size());
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    for (const VertexId v : mesh.face(FaceId(f))) vertices[mesh.face_part[f].index()].push_back(v);
  std::vector<MorphTarget> all;
  for (std::size_t part = 0; part < vertices.size(); ++part) {
    auto& list = vertices[part];
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    for (std::size_t t = 0; t < targets.size() && !list.empty(); ++t) {
      MorphTarget target{fmt::format("{}_corrective{}", method, t + 1), PartId(part), 0, {}, {}};
      for (const VertexId v : list) {
        if (targets[t][v.index()].isZero(0)) continue;
        target.vertices.push_back(v);
        target.offsets.push_back(targets[t][v.index()]);
      }
      all.push_back(std::move(target));
    }
  }
  return all;
}

std::vector<MorphTracks> tracks_of_clip(const Frames& frames, std::size_t clip, const Correctives& baked,
                                        const std::vector<MorphTarget>& targets) {
  MorphTracks track;
  for (std::size_t i = frames.first(clip); i < frames.first(clip + 1); ++i) {
    track.weights.times.push_back(frames.time(i));
    track.weights.values.push_back(baked.weights[i]);
  }
  std::vector<MorphTracks> tracks;
  for (const MorphTarget& target : targets) {
    if (!tracks.empty() && tracks.back().part == target.part) continue;
    track.part = target.part;
    tracks.push_back(track);
  }
  return tracks;
}

// Everything a run-time driver needs for a_j (ETH Eq. 8): see deform.md.
std::string driver_json(const Deformer& deformer, const Skeleton& skeleton) {
  const ExampleWeights& driver = deformer.driver();
  nlohmann::ordered_json json;
  json["kernel"] = driver.kernel() == RadialKernel::Linear ? "linear" : "gaussian";
  json["width"] = driver.width();
  for (const std::size_t j : deformer.driver_joints()) json["joints"].push_back(skeleton.joints[j].name);
  for (std::size_t c = 0; c < driver.centers().size(); ++c) {
    nlohmann::ordered_json pose;
    pose["matrices"] = std::vector<double>(driver.centers()[c].begin(), driver.centers()[c].end());
    const Eigen::VectorXd row = driver.coefficients().row(static_cast<Eigen::Index>(c));
    pose["coefficients"] = std::vector<double>(row.begin(), row.end());
    json["poses"].push_back(std::move(pose));
  }
  return json.dump(1) + "\n";
}

void report(const BakedCorrectives& baked, const BakeRequest& request, std::size_t count, std::size_t frames,
            double diagonal, const std::string& place, IssueSink& issues) {
  const auto percent = [&](double length) { return diagonal > 0 ? 100 * length / diagonal : 0; };
  issues.note(
      "correctives-baked", place,
      fmt::format("{}: {} morph targets over {} frames; largest error {:.2g} % of the diagonal ({:.2g} % "
                  "without them), rms {:.2g} %",
                  name_of(request.method), count, frames, percent(baked.largest), percent(baked.before),
                  percent(baked.rms)));
  if (request.method != DeformMethod::Context && request.enough > 0 &&
      baked.largest > request.enough * diagonal)
    issues.warn(
        "correctives-not-enough", place,
        fmt::format("{} targets leave {:.2g} % of the diagonal where {:.2g} % are wanted; allow more targets",
                    count, percent(baked.largest), 100 * request.enough));
}

}  // namespace

std::vector<double> corrective_times(const Clip& clip) {
  std::vector<double> keys{0, clip.duration};
  for (const JointTracks& tracks : clip.joints) {
    keys.insert(keys.end(), tracks.translation.times.begin(), tracks.translation.times.end());
    keys.insert(keys.end(), tracks.rotation.times.begin(), tracks.rotation.times.end());
    keys.insert(keys.end(), tracks.scale.times.begin(), tracks.scale.times.end());
  }
  std::sort(keys.begin(), keys.end());
  std::vector<double> times;
  for (const double key : keys) {
    if (key < 0 || (!times.empty() && key - times.back() < 1e-5)) continue;
    if (!times.empty()) {
      const double from = times.back();
      const int steps = static_cast<int>(std::ceil((key - from) / kLongestStep - 1e-6));
      for (int i = 1; i < steps; ++i) times.push_back(from + (key - from) * i / steps);
    }
    times.push_back(key);
  }
  return times;
}

BakedCorrectives bake_character(const Character& character, const BakeRequest& request,
                                const std::string& place, IssueSink& issues) {
  const std::vector<Vec3> rest = float_positions(character.mesh.positions);
  const SkinWeights written = written_weights(character.weights, request.influences);
  const bool is_context = request.method == DeformMethod::Context;
  DeformOptions options;
  for (const PosedShape& example : request.examples)
    options.examples.push_back({example.shape, posed_bones(character.skeleton, example.pose)});
  const Deformer deformer(character.mesh, character.skeleton, is_context ? written : character.weights,
                          request.method, std::move(options), place, issues);
  const Frames frames(character);
  const double diagonal = character.mesh.diagonal();
  const Correctives baked =
      is_context ? example_correctives(rest, written, deformer, frames.size(),
                                       [&](std::size_t i) { return frames.bones(i); })
                 : bake_correctives(rest, written, frames.size(),
                                    [&](std::size_t i) {
                                      const PosedBones bones = frames.bones(i);
                                      return CorrectiveFrame{bones.palette, deformer(bones)};
                                    },
                                    {.targets = request.targets, .enough = request.enough * diagonal});
  BakedCorrectives result{.targets = by_part(character.mesh, baked.targets, name_of(request.method)),
                          .tracks = {},
                          .driver_json = is_context ? driver_json(deformer, character.skeleton) : "",
                          .before = baked.before,
                          .largest = baked.largest,
                          .rms = baked.rms,
                          .by_count = baked.by_count};
  for (std::size_t c = 0; c < character.clips.size(); ++c)
    result.tracks.push_back(tracks_of_clip(frames, c, baked, result.targets));
  if (baked.damped > 0)
    issues.warn(
        "correctives-singular", place,
        fmt::format("{} vertices in frames have a nearly singular blended matrix (half turns against each "
                    "other), which no morph target can correct",
                    baked.damped));
  report(result, request, baked.targets.size(), frames.size(), diagonal, place, issues);
  return result;
}

namespace {

// Old and new weights of one part as one track.
WeightsTrack joined_track(const WeightsTrack& old, const std::vector<double>& defaults,
                          const WeightsTrack& added) {
  WeightsTrack track;
  track.times = added.times;
  track.times.insert(track.times.end(), old.times.begin(), old.times.end());
  std::sort(track.times.begin(), track.times.end());
  track.times.erase(std::unique(track.times.begin(), track.times.end()), track.times.end());
  for (const double time : track.times) {
    std::vector<double> values = old.is_empty() ? defaults : sample(old, time);
    const std::vector<double> more = sample(added, time);
    values.insert(values.end(), more.begin(), more.end());
    track.values.push_back(std::move(values));
  }
  return track;
}

}  // namespace

void add_correctives(Character& character, const BakedCorrectives& correctives) {
  for (std::size_t c = 0; c < character.clips.size(); ++c) {
    Clip& clip = character.clips[c];
    std::vector<MorphTracks> merged;
    for (const MorphTracks& added : correctives.tracks[c]) {
      std::vector<double> defaults;
      for (const MorphTarget& target : character.morphs)
        if (target.part == added.part) defaults.push_back(target.default_weight);
      const auto old = std::find_if(clip.morphs.begin(), clip.morphs.end(),
                                    [&](const MorphTracks& tracks) { return tracks.part == added.part; });
      merged.push_back({added.part, joined_track(old == clip.morphs.end() ? WeightsTrack() : old->weights,
                                                 defaults, added.weights)});
    }
    for (MorphTracks& tracks : clip.morphs)
      if (std::none_of(merged.begin(), merged.end(), [&](const auto& m) { return m.part == tracks.part; }))
        merged.push_back(std::move(tracks));
    std::sort(merged.begin(), merged.end(), [](const auto& a, const auto& b) { return a.part < b.part; });
    clip.morphs = std::move(merged);
  }
  character.morphs.insert(character.morphs.end(), correctives.targets.begin(), correctives.targets.end());
  std::stable_sort(character.morphs.begin(), character.morphs.end(),
                   [](const MorphTarget& a, const MorphTarget& b) { return a.part < b.part; });
}

}  // namespace skinforge

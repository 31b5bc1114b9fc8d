#include "stages/corrective_bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "animation/sampling.h"
#include "base/error.h"
#include "base/text.h"
#include "io/written_weights.h"

namespace skinforge {
namespace {

constexpr double kLongestStep = 1.0 / 30;  // ours: seconds between keys of weights

std::vector<Vec3> float_positions(const std::vector<Vec3>& positions) {
  std::vector<Vec3> rounded;
  for (const Vec3& p : positions) rounded.push_back(p.cast<float>().cast<double>());
  return rounded;
}

struct FramePlace {
  std::size_t clip;
  double time;
};

PosedBones bones_at(const Character& character, const FramePlace& place) {
  return posed_bones(character.skeleton, sample(character.skeleton, character.clips[place.clip], place.time));
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
    find_distinct();
  }
  std::size_t size() const { return places_.size(); }
  std::size_t first(std::size_t clip) const { return first_[clip]; }
  double time(std::size_t i) const { return places_[i].time; }

  /// Clips repeat poses: the different ones, and which of them each frame shows.
  std::size_t distinct_count() const { return distinct_.size(); }
  std::size_t distinct(std::size_t i) const { return which_[i]; }
  PosedBones distinct_bones(std::size_t d) const { return bones_at(character_, places_[distinct_[d]]); }

  /// The frames that have another one of the same clip behind them.
  std::vector<std::size_t> with_next() const {
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i + 1 < places_.size(); ++i)
      if (places_[i].clip == places_[i + 1].clip) all.push_back(i);
    return all;
  }
  /// Half way from a frame to the next.
  PosedBones bones_after(std::size_t i) const {
    return bones_at(character_, {places_[i].clip, (places_[i].time + places_[i + 1].time) / 2});
  }

 private:
  void find_distinct() {
    std::map<std::vector<double>, std::size_t> seen;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      std::vector<double> numbers;
      for (const Affine3& matrix : bones_at(character_, places_[i]).palette)
        numbers.insert(numbers.end(), matrix.data(), matrix.data() + matrix.matrix().size());
      const auto [known, is_new] = seen.try_emplace(std::move(numbers), distinct_.size());
      if (is_new) distinct_.push_back(i);
      which_.push_back(known->second);
    }
  }

  const Character& character_;
  std::vector<FramePlace> places_;
  std::vector<std::size_t> first_;     ///< per clip, and the end
  std::vector<std::size_t> distinct_;  ///< a frame of each different pose
  std::vector<std::size_t> which_;     ///< per frame, index into `distinct_`
};

// Largest error half way between keys, where players mix the weights of both.
double error_between_keys(const Frames& frames, const Correctives& baked, const Deformer& deformer,
                          std::span<const Vec3> rest, const SkinWeights& written) {
  const std::vector<std::size_t> keys = frames.with_next();
  const auto frame = [&](std::size_t i) {
    const PosedBones bones = frames.bones_after(keys[i]);
    return CorrectiveFrame{bones.palette, deformer(bones)};
  };
  const auto blend = [&](std::size_t i) {
    std::vector<double> row = baked.weights[frames.distinct(keys[i])];
    const std::vector<double>& next = baked.weights[frames.distinct(keys[i] + 1)];
    for (std::size_t t = 0; t < row.size(); ++t) row[t] = (row[t] + next[t]) / 2;
    return row;
  };
  return replay_error(rest, written, baked.targets, keys.size(), frame, blend);
}

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
    track.weights.values.push_back(baked.weights[frames.distinct(i)]);
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

DeformOptions deform_options(const BakeRequest& request, const Skeleton& skeleton) {
  DeformOptions options;
  options.with_rest = request.with_rest;
  options.kernel = request.kernel;
  for (const PosedShape& example : request.examples)
    options.examples.push_back({example.shape, posed_bones(skeleton, example.pose)});
  for (const std::string& name : request.joints) {
    const auto joint = skeleton.find(name);
    if (!joint)
      throw Error(ExitCode::Usage, fmt::format("correctives: no joint \"{}\"{}", printable(name),
                                               nearest_hint(name, skeleton.names())));
    options.joints.push_back(joint->index());
  }
  return options;
}

void report(const BakedCorrectives& baked, const BakeRequest& request, std::size_t count, std::size_t frames,
            double diagonal, const std::string& place, IssueSink& issues) {
  const auto percent = [&](double length) { return diagonal > 0 ? 100 * length / diagonal : 0; };
  issues.note("correctives-baked", place,
              fmt::format("{}: {} morph targets over {} different frames; largest error {:.2g} % of the "
                          "diagonal at keys and {:.2g} % "
                          "between ({:.2g} % without them), rms {:.2g} %",
                          name_of(request.method), count, frames, percent(baked.largest),
                          percent(baked.between), percent(baked.before), percent(baked.rms)));
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
  const Deformer deformer(character.mesh, character.skeleton, is_context ? written : character.weights,
                          request.method, deform_options(request, character.skeleton), place, issues);
  const Frames frames(character);
  const double diagonal = character.mesh.diagonal();
  const Correctives baked =
      is_context ? example_correctives(rest, written, deformer, frames.distinct_count(),
                                       [&](std::size_t i) { return frames.distinct_bones(i); })
                 : bake_correctives(rest, written, frames.distinct_count(),
                                    [&](std::size_t i) {
                                      const PosedBones bones = frames.distinct_bones(i);
                                      return CorrectiveFrame{bones.palette, deformer(bones)};
                                    },
                                    {.targets = request.targets, .enough = request.enough * diagonal});
  BakedCorrectives result{.targets = by_part(character.mesh, baked.targets, name_of(request.method)),
                          .tracks = {},
                          .driver_json = is_context ? driver_json(deformer, character.skeleton) : "",
                          .before = baked.before,
                          .largest = baked.largest,
                          .rms = baked.rms,
                          .between = error_between_keys(frames, baked, deformer, rest, written),
                          .by_count = baked.by_count};
  for (std::size_t c = 0; c < character.clips.size(); ++c)
    result.tracks.push_back(tracks_of_clip(frames, c, baked, result.targets));
  if (baked.damped > 0)
    issues.warn(
        "correctives-singular", place,
        fmt::format("{} vertices in frames have a nearly singular blended matrix (half turns against each "
                    "other), which no morph target can correct",
                    baked.damped));
  report(result, request, baked.targets.size(), frames.distinct_count(), diagonal, place, issues);
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

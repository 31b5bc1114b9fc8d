#pragma once

#include <optional>
#include <string>
#include <vector>

#include "field/blend.h"
#include "io/import.h"
#include "model/character.h"
#include "skeleton/graft.h"
#include "skeleton/pose.h"
#include "skinning/weight_transfer.h"
#include "surface/assemble.h"
#include "texture/color_steps.h"

/// Names and types of what passes between stages. Types that belong to one layer are used as they are; these
/// are the ones that only the pipeline needs.
namespace skinforge {

/// Names of artifacts. `prefix` keeps a recipe used as an input apart from the one that uses it.
struct ArtifactNames {
  std::string prefix;

  std::string file(const std::string& input, std::size_t i) const {
    return prefix + "file:" + input + ":" + std::to_string(i);
  }
  std::string imported(const std::string& input) const { return prefix + "imported:" + input; }
  std::string character(const std::string& input) const { return prefix + "character:" + input; }
  std::string contents(const std::string& input) const { return prefix + "contents:" + input; }
  std::string asked_placement() const { return prefix + "asked_placement"; }
  std::string placement() const { return prefix + "placement"; }
  std::string graft() const { return prefix + "graft"; }
  std::string joint_maps() const { return prefix + "joint_maps"; }
  std::string placed() const { return prefix + "placed"; }
  std::string selection() const { return prefix + "selection"; }
  std::string groups() const { return prefix + "groups"; }
  std::string field(std::size_t site) const { return prefix + "field:" + std::to_string(site); }
  std::string vdb(std::size_t site) const { return prefix + "vdb:" + std::to_string(site); }
  std::string surface() const { return prefix + "surface"; }
  std::string bound() const { return prefix + "bound"; }
  std::string weight_record() const { return prefix + "weight_record"; }
  std::string shares() const { return prefix + "shares"; }
  std::string motion(std::size_t source) const { return prefix + "motion:" + std::to_string(source); }
  std::string clip(const std::string& name) const { return prefix + "clip:" + name; }
  std::string quality(const std::string& name) const { return prefix + "quality:" + name; }
  std::string animated(const std::string& name) const { return prefix + "animated:" + name; }
  std::string textured() const { return prefix + "textured"; }
  std::string color_steps() const { return prefix + "color_steps"; }
  std::string examples(const std::string& input) const { return prefix + "examples:" + input; }
  std::string correctives() const { return prefix + "correctives"; }
  std::string driver() const { return prefix + "driver"; }
  std::string result() const { return prefix + "result"; }
  std::string glb() const { return prefix + "glb"; }
  std::string obj() const { return prefix + "obj"; }
  std::string validation() const { return prefix + "validation"; }
  std::string expectations() const { return prefix + "expectations"; }
  std::string golden() const { return prefix + "golden"; }  ///< the file; no bytes when there is none
  std::string comparison() const { return prefix + "comparison"; }
  std::string picture(const std::string& name) const { return prefix + "picture:" + name; }
  std::string view() const { return prefix + "view"; }
  std::string preview_glb() const { return prefix + "preview_glb"; }
  std::string preview_report() const { return prefix + "preview_report"; }
  std::string report() const { return prefix + "report"; }
};

/// A file that an input was read from.
struct SourceFile {
  std::string name;  ///< without folders
  Digest digest;
  std::uint64_t bytes = 0;

  template <class Archive>
  friend void fields(Archive& a, SourceFile& f) {
    a(f.name, f.digest, f.bytes);
  }
};

/// What the planning of later stages and the report need to know of an input, without decoding the character.
struct InputContents {
  std::vector<std::string> joints;
  std::vector<std::string> clips;
  std::vector<SourceFile> files;  ///< its model first; of a recipe, those of all its inputs

  template <class Archive>
  friend void fields(Archive& a, InputContents& c) {
    a(c.joints, c.clips, c.files);
  }
};

/// A shape of an input's mesh and the pose it stands in.
struct PosedShape {
  std::vector<Vec3> shape;  ///< #V
  Pose pose;                ///< one local transform a joint

  template <class Archive>
  friend void fields(Archive& a, PosedShape& s) {
    a(s.shape, s.pose);
  }
};

template <class Archive>
void fields(Archive& a, WeightSteps& s) {
  a(s.junction, s.neighbours);
}

/// How the weights of the junctions came out.
struct WeightRecord {
  WeightSteps blended;  ///< before smoothing
  WeightSteps steps;    ///< in the result
  std::uint64_t filled_rows = 0;

  template <class Archive>
  friend void fields(Archive& a, WeightRecord& r) {
    a(r.blended, r.steps, r.filled_rows);
  }
};

template <class Archive>
void fields(Archive& a, ColorSteps& s) {
  a(s.edges, s.mean, s.p95, s.largest);
}

/// How the part of an operation meets its host, and what was changed about it so that their surfaces join
/// (junction.md d.2).
struct PartTurn {
  double bend = 0;                  ///< as asked, radians; 0: the part goes on where the host ends
  double angle = 0;                 ///< turned back by, radians
  std::optional<BlendOperator> op;  ///< blended by this instead of what was asked

  template <class Archive>
  friend void fields(Archive& a, PartTurn& t) {
    a(t.bend, t.angle, t.op);
  }
};

/// The operations with their placements worked out (Sec. 4.1).
struct PlacedOperations {
  std::vector<GraftOperation> operations;
  /// Per operation, per joint of its input: what the joint is moved by on top of the placement, metres; empty
  /// for none. Only an input whose joints are matched in several places has any: the translations spread
  /// between them.
  std::vector<std::vector<Vec3>> joint_shifts;
  std::vector<PartTurn> turns;  ///< per operation; empty as asked

  template <class Archive>
  friend void fields(Archive& a, PlacedOperations& p) {
    a(p.operations, p.joint_shifts, p.turns);
  }
};

/// What goes wrong when a clip moves the finished body, at sampled frames.
struct ClipQuality {
  std::vector<double> times;                   ///< looked at, seconds
  std::uint64_t folds = 0, intersections = 0;  ///< at the worst of them
  double stretch = 0;                          ///< at the worst of them
  double worst_time = 0;                       ///< of the worst frame, seconds
  std::vector<FaceId> worst_faces;             ///< that fold or cut there, rising
  double foot_sink = 0, foot_slide = 0;        ///< metres, m/s

  bool is_faulty() const { return folds > 0 || intersections > 0; }
  template <class Archive>
  friend void fields(Archive& a, ClipQuality& q) {
    a(q.times, q.folds, q.intersections, q.stretch, q.worst_time, q.worst_faces, q.foot_sink, q.foot_slide);
  }
};

/// The joined surface and the junctions in it, one per operation.
struct SurfaceResult {
  JoinedSurface joined;
  std::vector<Junction> junctions;
  std::vector<FaceSet> kept;       ///< per source: the faces that stayed
  std::vector<std::int32_t> arcs;  ///< per operation: borders left open because they end on an open hem

  template <class Archive>
  friend void fields(Archive& a, SurfaceResult& s) {
    a(s.joined, s.junctions, s.kept, s.arcs);
  }
};

}  // namespace skinforge

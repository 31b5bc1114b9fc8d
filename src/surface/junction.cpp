#include "surface/junction.h"

#include <algorithm>
#include <optional>

#include "surface/borders.h"
#include "surface/bridge.h"
#include "surface/field_junction.h"
#include "surface/junction_faults.h"
#include "surface/quad_cap.h"
#include "surface/untangle.h"

namespace skinforge {
namespace {

constexpr std::size_t kMostTangles = 64;  // ours: more than a few do not come apart by moving vertices

// One way to make a junction.
struct Attempt {
  TrianglePatch patch;
  std::size_t quads = 0;
  JunctionRung rung = JunctionRung::None;
  JunctionFaults faults;
};

// Keeps the best of the attempts; of equals the first.
class Ladder {
 public:
  Ladder(const std::vector<JunctionLoop>& loops, const KeptSurface& kept) : loops_(loops), kept_(kept) {}

  bool is_done() const { return best_ && !best_->faults.any(); }
  bool is_empty() const { return !best_; }
  const std::optional<Attempt>& best() const { return best_; }

  void offer(const TrianglePatch& patch, JunctionRung rung) {
    take_if_better(patch, rung);
    if (best_->faults.self_intersections > 0 && best_->faults.self_intersections <= kMostTangles)
      take_if_better(untangled(best_->patch, loops_, kept_), best_->rung);
  }

  // For what costs something else: takes it only if it has no fault at all.
  void offer_if_sound(TrianglePatch patch, JunctionRung rung) {
    if (!faults_of(patch, loops_, kept_).any()) best_ = Attempt{std::move(patch), 0, rung, {}};
  }

  // Takes quads in the place of triangles unless they bring faults; then says which.
  std::string offer_quads(const QuadPatch& quads, JunctionRung rung) {
    const TrianglePatch patch = halved(quads);
    const JunctionFaults faults = faults_of(patch, loops_, kept_);
    if (faults > best_->faults) return describe(faults);
    best_ = Attempt{patch, quads.quads.size(), rung, faults};
    return {};
  }

 private:
  void take_if_better(const TrianglePatch& patch, JunctionRung rung) {
    const JunctionFaults faults = faults_of(patch, loops_, kept_);
    if (!best_ || faults < best_->faults) best_ = Attempt{patch, 0, rung, faults};
  }

  const std::vector<JunctionLoop>& loops_;
  const KeptSurface& kept_;
  std::optional<Attempt> best_;
};

// The parts of a patch, those that were made of quads as such.
QuadPatch together(const TrianglePatch& patch, const std::vector<PatchPart>& parts,
                   const std::vector<std::optional<QuadPatch>>& quads) {
  QuadPatch whole{
      {patch.positions.begin(), patch.positions.begin() + static_cast<std::ptrdiff_t>(patch.fixed)},
      {},
      {},
      patch.fixed};
  for (std::size_t p = 0; p < parts.size(); ++p)
    add_part(whole, parts[p], quads[p] ? *quads[p] : triangles_of(parts[p]));
  return whole;
}

// The image of the quads of a part's image.
QuadPatch image_of_quads(std::size_t p, const std::vector<PatchPart>& parts,
                         const std::vector<std::optional<QuadPatch>>& quads, const PatchMirror& mirror) {
  const std::size_t other = image_of_part(parts, p, mirror)->part;
  return reflected(*quads[other], image_of_part(parts, other, mirror)->borders,
                   std::span(parts[p].patch.positions).first(parts[p].patch.fixed));
}

// A tube of quads in the place of a part: the image of another part's, or a symmetric one, if that is wanted
// and can be; else any.
std::optional<QuadPatch> tube_for(std::size_t p, const std::vector<PatchPart>& parts,
                                  const std::vector<std::optional<QuadPatch>>& quads,
                                  const FieldJunction& from_field, const PatchMirror* mirror,
                                  std::string& fault) {
  const auto image = mirror ? image_of_part(parts, p, *mirror) : std::nullopt;
  if (image && image->part < p && quads[image->part]) return image_of_quads(p, parts, quads, *mirror);
  if (image && image->part == p)
    if (auto tube = from_field.tube(parts[p], fault, &image->borders)) return tube;
  fault.clear();
  return from_field.tube(parts[p], fault);
}

// Tubes of quads in the place of the parts, one after the other, where they are sound.
void try_tubes(Ladder& ladder, const FieldJunction& from_field, const std::vector<JunctionLoop>& loops,
               const PatchMirror* mirror, std::string& reason) {
  const TrianglePatch patch = ladder.best()->patch;
  const std::vector<PatchPart> parts = split_parts(patch, loops);
  std::vector<std::optional<QuadPatch>> quads(parts.size());
  std::size_t made = 0;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    std::string fault;
    quads[p] = tube_for(p, parts, quads, from_field, mirror, fault);
    if (quads[p]) {
      const bool all_made = ++made == parts.size();
      fault = ladder.offer_quads(together(patch, parts, quads),
                                 all_made ? JunctionRung::Tube : JunctionRung::Field);
      if (!fault.empty()) quads[p].reset(), --made;
    }
    if (!fault.empty() && reason.empty()) reason = "no tube of quads: " + fault;
  }
}

// A cap of quads, symmetric if that is wanted and can be.
std::optional<QuadPatch> cap_for(std::size_t p, const std::vector<PatchPart>& parts,
                                 const std::vector<std::optional<QuadPatch>>& quads,
                                 const std::vector<JunctionLoop>& loops, const PatchMirror* mirror) {
  const auto image = mirror ? image_of_part(parts, p, *mirror) : std::nullopt;
  if (image && image->part < p && quads[image->part]) return image_of_quads(p, parts, quads, *mirror);
  const JunctionLoop& loop = loops[parts[p].loops[0]];
  if (image && image->part == p)
    if (auto cap = quad_cap(loop, &image->borders)) return cap;
  return quad_cap(loop);
}

// Caps of quads in the place of triangles where there are good ones, if together they are sound.
void try_quad_caps(Ladder& ladder, const std::vector<JunctionLoop>& loops, const PatchMirror* mirror) {
  const std::vector<PatchPart> parts = split_parts(ladder.best()->patch, loops);
  std::vector<std::optional<QuadPatch>> quads;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (parts[p].loops.size() != 1) return;
    quads.push_back(cap_for(p, parts, quads, loops, mirror));
  }
  ladder.offer_quads(together(ladder.best()->patch, parts, quads), JunctionRung::Cap);
}

// Wide clearance leaves the zip room to turn; a narrow one keeps rings apart where borders are close. Where
// the surface is thinner than the borders' edges are long, only a finer mesh stays free of cuts: as little
// finer as may be.
void try_field(Ladder& ladder, const std::vector<JunctionLoop>& loops, const SiteField& field,
               const KeptSurface& kept, const PatchMirror* mirror, std::string& reason) {
  const FieldJunction from_field(loops, field, kept);
  std::vector<TrianglePatch> zipped;
  for (const double clearance : {1.0, 0.5, 0.25}) {
    std::string fault;
    if (auto patch = from_field.zipped(clearance, fault)) zipped.push_back(std::move(*patch));
    if (reason.empty()) reason = fault;
  }
  for (const TrianglePatch& patch : zipped)
    if (!ladder.is_done()) ladder.offer(from_field.remeshed(patch, 1), JunctionRung::Field);
  for (const double length_scale : {0.8, 0.65, 0.5, 0.35, 0.25})
    for (const TrianglePatch& patch : zipped)
      if (!ladder.is_done())
        ladder.offer_if_sound(from_field.remeshed(patch, length_scale), JunctionRung::Field);
  if (!ladder.is_empty()) reason.clear();
  if (ladder.is_done()) try_tubes(ladder, from_field, loops, mirror, reason);  // what has faults is made anew
}

void try_without_field(Ladder& ladder, const std::vector<JunctionLoop>& loops, const PatchMirror* mirror,
                       JunctionRung rung) {
  for (const bool is_fair : {true, false})
    if (!ladder.is_done()) ladder.offer(bridge_or_cap(loops, is_fair), rung);
  if (ladder.is_done() && rung == JunctionRung::Cap) try_quad_caps(ladder, loops, mirror);
}

}  // namespace

Junction build_junction(std::vector<JunctionLoop> loops, const SiteField& field, const KeptSurface& kept,
                        const PatchMirror* mirror) {
  Junction junction;
  junction.loops = std::move(loops);
  junction.voxel = field.is_empty() ? 0 : field.voxel();
  if (junction.loops.empty()) {
    junction.reason = "no cut loop: the parts are joined rigidly";
    return junction;
  }
  const auto is_host = [](const JunctionLoop& l) { return l.is_host; };
  const bool has_host = std::any_of(junction.loops.begin(), junction.loops.end(), is_host);
  const bool has_donor = !std::all_of(junction.loops.begin(), junction.loops.end(), is_host);
  Ladder ladder(junction.loops, kept);
  if (has_host && has_donor && !field.is_empty())
    try_field(ladder, junction.loops, field, kept, mirror, junction.reason);
  if (ladder.is_empty() || (!ladder.is_done() && bridge_joins_all(junction.loops, kept))) {
    if (!ladder.is_empty()) junction.reason = "from the field: " + describe(ladder.best()->faults);
    try_without_field(ladder, junction.loops, mirror,
                      has_host && has_donor ? JunctionRung::Bridge : JunctionRung::Cap);
  }
  junction.patch = ladder.best()->patch;
  junction.quads = ladder.best()->quads;
  junction.rung = ladder.best()->rung;
  junction.faults = ladder.best()->faults;
  return junction;
}

Junction mirrored_junction(const Junction& junction, const PatchMirror& borders,
                           std::vector<JunctionLoop> loops) {
  Junction image = junction;
  image.loops = std::move(loops);
  image.patch = lay_borders(image.loops).patch;
  for (std::size_t v = junction.patch.fixed; v < junction.patch.positions.size(); ++v)
    image.patch.positions.push_back(borders.plane.mirrored(junction.patch.positions[v]));
  const auto name = [&](std::int32_t v) {
    return static_cast<std::size_t>(v) < junction.patch.fixed ? borders.image[static_cast<std::size_t>(v)]
                                                              : v;
  };
  for (std::size_t t = 0; t < junction.patch.triangles.size(); ++t) {
    const std::size_t from = t < 2 * junction.quads ? t ^ 1U : t;  // the halves of a quad change places
    const auto& [a, b, c] = junction.patch.triangles[from];
    image.patch.triangles.push_back({name(a), name(c), name(b)});
  }
  return image;
}

}  // namespace skinforge

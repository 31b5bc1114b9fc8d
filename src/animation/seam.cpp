#include "animation/seam.h"

#include <algorithm>
#include <cmath>

#include "animation/skin_balls.h"

namespace skinforge {
namespace {

bool is_in(const std::vector<SourceId>& sources, SourceId source) {
  return std::find(sources.begin(), sources.end(), source) != sources.end();
}

// Null where the set has no frames.
const SeamBalls* balls_at(const MotionSet& set, std::size_t site) {
  const auto found = std::find_if(set.seams.begin(), set.seams.end(),
                                  [&](const SeamBalls& balls) { return balls.site == site; });
  return found == set.seams.end() ? nullptr : &*found;
}

}  // namespace

std::vector<BallTrack> SeamSide::tracks(std::size_t first, std::size_t count) const {
  using Places = Eigen::Map<const Eigen::ArrayXf>;
  const std::size_t frames = set->poses.size();
  std::vector<BallTrack> tracks;
  for (std::size_t b = 0; b < balls->bind.size(); ++b) {
    const auto along = [&](std::size_t axis) {
      return Places(balls->places.data() + (3 * b + axis) * frames + first, static_cast<Eigen::Index>(count));
    };
    tracks.push_back(BallTrack{{along(0), along(1), along(2)}});
  }
  return tracks;
}

double Seam::radii(std::size_t driver_ball, std::size_t part_ball) const {
  return driver.scale * driver.set->balls[driver_ball].radius +
         part.scale * part.set->balls[part_ball].radius;
}

double Seam::touching(std::size_t driver_ball, std::size_t part_ball, double thickness) const {
  const double sum = radii(driver_ball, part_ball);
  const double at_rest = (driver.balls->bind[driver_ball] - part.balls->bind[part_ball]).norm();
  return std::min(thickness * sum, at_rest);
}

std::vector<Seam> seams_between(std::span<const Character* const> characters, const Graft& graft,
                                std::span<const MotionSet* const> motions, const DrivingClip& driver,
                                const PartToComplete& part) {
  const GraftSource& base = graft.sources.front();
  const double diagonal = base.model_from_input.scale * characters[base.input]->mesh.diagonal();
  std::vector<Seam> seams;
  for (std::size_t s = 0; s < graft.sites.size() && diagonal > 0; ++s) {
    const std::optional<Meeting> meeting = meeting_at(graft, graft.sites[s]);
    if (!meeting) continue;
    const SourceId above = meeting->above.source, below = meeting->below.source;
    const bool drives_above = is_in(driver.sources, above) && is_in(part.sources, below);
    const bool drives_below = is_in(driver.sources, below) && is_in(part.sources, above);
    if (!drives_above && !drives_below) continue;
    const GraftSource &host = graft.sources[above.index()], &donor = graft.sources[below.index()];
    const Affine3& joint_from_host = characters[host.input]->skeleton[meeting->above.joint].joint_from_model;
    const double scale_above = 1 / scale_of(joint_from_host), host_scale = host.model_from_input.scale;
    const MotionSet &upper_set = *motions[above.index()], &lower_set = *motions[below.index()];
    const SeamSide upper{above, &upper_set, balls_at(upper_set, s), 1 / scale_above},
        lower{below, &lower_set, balls_at(lower_set, s),
              donor.model_from_input.scale / (host_scale * scale_above)};
    if (!upper.balls || !lower.balls) continue;
    const double unit = host_scale * scale_above / diagonal;
    seams.push_back(drives_above ? Seam{s, upper, lower, unit} : Seam{s, lower, upper, unit});
  }
  return seams;
}

}  // namespace skinforge

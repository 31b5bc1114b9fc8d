#include "surface/quad_cap.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "base/expect.h"
#include "surface/improve_faces.h"
#include "surface/quad_gate.h"
#include "surface/symmetric_table.h"

namespace skinforge {
namespace {

constexpr std::size_t kTried = 3;  // ours: grids of each kind that are made and compared
constexpr double kGain = 1e-3;     // ours: less is no gain, so equals do not hang on the last bit

// A way to lay the grid, and how well its corners and sides suit the border; less is better.
struct Layout {
  double cost = 0;
  int start = 0, width = 0, height = 0;
  bool has_ring = false;
};

// 0 where a border runs straight on, 1 where it turns by a right angle.
std::vector<double> turns_of(const std::vector<Vec3>& loop) {
  std::vector<double> turns;
  const std::size_t n = loop.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3 before = (loop[k] - loop[(k + n - 1) % n]).normalized(),
               after = (loop[(k + 1) % n] - loop[k]).normalized();
    turns.push_back(std::acos(std::clamp(before.dot(after), -1.0, 1.0)) / (std::acos(-1.0) / 2));
  }
  return turns;
}

class Layouts {
 public:
  explicit Layouts(const std::vector<Vec3>& loop) : loop_(loop), turns_(turns_of(loop)), until_{0} {
    for (std::size_t k = 0; k < 2 * loop.size(); ++k)
      until_.push_back(until_.back() + (loop[(k + 1) % loop.size()] - loop[k % loop.size()]).norm());
  }

  // The best ones of a kind, best first; with a reflection those that it maps onto themselves.
  std::vector<Layout> best(bool has_ring, std::optional<LoopReflection> reflection) const {
    const int n = static_cast<int>(loop_.size()), half = (n - n % 2) / 2;
    std::vector<Layout> all;
    if (n % 2 == 1 && !has_ring) return all;
    for (int width = 1; width < half; ++width)
      for (int start = 0; start < n; ++start)
        if (!reflection || is_symmetric(start, width, half - width, *reflection))
          all.push_back({cost(start, width, half - width), start, width, half - width, has_ring});
    std::stable_sort(all.begin(), all.end(),
                     [](const Layout& a, const Layout& b) { return a.cost < b.cost; });
    all.resize(std::min(all.size(), kTried));
    return all;
  }

 private:
  // Whether the corners of a grid are each other's images.
  bool is_symmetric(int start, int width, int height, LoopReflection reflection) const {
    const int n = static_cast<int>(loop_.size());
    if (n % 2 == 1) return false;
    std::set<int> corners, images;
    for (const int c : {start, start + width, start + width + height, start + 2 * width + height}) {
      corners.insert(c % n);
      images.insert(((reflection.sum - c) % n + n) % n);
    }
    return corners == images;
  }

  double length(int from, int edges) const {
    const auto begin = static_cast<std::size_t>(from) % loop_.size();
    return until_[begin + static_cast<std::size_t>(edges)] - until_[begin];
  }

  // Rounded: of equal layouts the first is taken, not the one with the lower last bit.
  double cost(int start, int width, int height) const {
    const int corner[4] = {start, start + width, start + width + height, start + 2 * width + height};
    const double whole = until_[loop_.size()];
    const double sides[4] = {length(corner[0], width), length(corner[1], height), length(corner[2], width),
                             length(corner[3], height)};
    double corners = 0;
    for (const int c : corner)
      corners += 1 - std::min(1.0, turns_[static_cast<std::size_t>(c) % loop_.size()]);
    const double unlike = std::abs(sides[0] - sides[2]) + std::abs(sides[1] - sides[3]);
    const double slender = std::abs(sides[0] + sides[2] - sides[1] - sides[3]);
    return std::round(4096 * (corners + 4 * unlike / whole + 2 * slender / whole)) / 4096;
  }

  const std::vector<Vec3>& loop_;
  std::vector<double> turns_, until_;
};

// Of the area that a loop goes around.
Vec3 normal_of(const std::vector<Vec3>& loop) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k + 1 < loop.size(); ++k) sum += (loop[k] - loop[0]).cross(loop[k + 1] - loop[0]);
  return sum;
}

std::optional<QuadPatch> placed(const JunctionLoop& loop, const Layout& layout,
                                const std::vector<Support>& supports, const PatchMirror* borders) {
  QuadPatch patch = cap_faces(static_cast<int>(loop.positions.size()), layout.start, layout.width,
                              layout.height, layout.has_ring);
  std::copy(loop.positions.begin(), loop.positions.end(), patch.positions.begin());
  for (int pass = 0; pass < 2; ++pass)  // the second with diagonals that suit the places of the first
    patch.positions = fair(halved(patch), supports).positions;
  const Vec3 up = normal_of(loop.positions);
  const WantedSurface surface{[](const Vec3& p) { return p; }, [&](const Vec3&) { return up; }};
  std::optional<PatchMirror> mirror;
  if (borders) {
    mirror = mirror_of(patch, *borders);
    if (!mirror) return std::nullopt;
    make_symmetric(patch, *mirror);
  }
  for (const FaceGoal goal : {FaceGoal::All, FaceGoal::Worst})
    improve_faces(patch, surface, goal, mirror ? &*mirror : nullptr);
  return patch;
}

}  // namespace

QuadPatch cap_faces(int border, int start, int width, int height, bool has_ring) {
  const int around = 2 * (width + height);
  SF_EXPECT(around == border || (has_ring && around == border - 1));
  QuadPatch patch;
  patch.fixed = static_cast<std::size_t>(border);
  std::int32_t next = border;
  std::vector<std::int32_t> ring;  // around the grid, from its first corner
  for (int k = 0; k < around; ++k) ring.push_back(has_ring ? next++ : (start + k) % border);
  const auto outer = [&](int k) { return (start + k) % border; };
  for (int k = 0; has_ring && k < around; ++k)
    patch.quads.push_back({outer(k), outer(k + 1), ring[(k + 1) % around], ring[k]});
  if (around < border) patch.triangles.push_back({outer(around), outer(around + 1), ring[0]});
  const std::int32_t inside = next;
  const auto vertex = [&](int x, int y) -> std::int32_t {
    if (y == 0) return ring[x];
    if (x == width) return ring[width + y];
    if (y == height) return ring[width + height + (width - x)];
    if (x == 0) return ring[(2 * width + height + (height - y)) % around];
    return inside + (x - 1) + (width - 1) * (y - 1);
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      patch.quads.push_back({vertex(x, y), vertex(x + 1, y), vertex(x + 1, y + 1), vertex(x, y + 1)});
  const int inner = (width - 1) * (height - 1);
  patch.positions.assign(static_cast<std::size_t>(inside + inner), Vec3::Zero());
  return patch;
}

std::optional<QuadPatch> quad_cap(const JunctionLoop& loop, const PatchMirror* mirror) {
  if (loop.positions.size() < 4) return std::nullopt;
  std::optional<LoopReflection> reflection;
  if (mirror) {
    std::vector<std::int32_t> own(loop.positions.size());
    std::iota(own.begin(), own.end(), 0);
    reflection = loop_reflection(own, mirror->image);
    if (!reflection) return std::nullopt;
  }
  const Layouts layouts(loop.positions);
  std::optional<QuadPatch> best;
  double quality = -3;
  for (const bool is_fair : {true, false}) {
    const std::vector<Support> supports = is_fair ? supports_of({loop}) : std::vector<Support>();
    for (const bool has_ring : {false, true})
      for (const Layout& layout : layouts.best(has_ring, reflection)) {
        auto patch = placed(loop, layout, supports, mirror);
        const double found = patch ? least_scaled_jacobian(*patch) : quality;
        if (found > quality + kGain) best = std::move(patch), quality = found;
      }
    if (quality >= kLeastJacobian) return best;  // a membrane only where the fair one is poor
  }
  return std::nullopt;
}

}  // namespace skinforge

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/expect.h"
#include "field/signed_distance.h"

namespace skinforge {
namespace {

using Index3 = std::array<std::int32_t, 3>;

// Corners of a cell, as steps along the axes: around the face below, seen from above, then the one above.
constexpr std::array<Index3, 8> kCorners = {
    {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}, {0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}}};

// Edges of a cell, from the corner of lower coordinates.
constexpr std::array<std::array<int, 2>, 12> kEdges = {
    {{0, 1}, {1, 2}, {3, 2}, {0, 3}, {4, 5}, {5, 6}, {7, 6}, {4, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

// Faces of a cell: corners around it, edge k from corner k to the next, and the step to the cell across.
struct CellFace {
  std::array<int, 4> corners, edges;
  Index3 across;
};
constexpr std::array<CellFace, 6> kFaces = {{{{0, 1, 5, 4}, {0, 9, 4, 8}, {0, 0, -1}},
                                             {{1, 2, 6, 5}, {1, 10, 5, 9}, {1, 0, 0}},
                                             {{3, 2, 6, 7}, {2, 10, 6, 11}, {0, 0, 1}},
                                             {{0, 3, 7, 4}, {3, 11, 7, 8}, {-1, 0, 0}},
                                             {{0, 1, 2, 3}, {0, 1, 2, 3}, {0, -1, 0}},
                                             {{4, 5, 6, 7}, {4, 5, 6, 7}, {0, 1, 0}}}};

// Which corners of a cell are inside: bit c for corner c.
using Signs = std::uint8_t;

bool is_inside(Signs signs, int corner) {
  return (signs >> corner & 1) != 0;
}

// Whether corners of one side lie across from each other on a face, so that it does not say which of them
// are joined.
bool is_ambiguous(Signs signs, const CellFace& face) {
  const auto& c = face.corners;
  return is_inside(signs, c[0]) == is_inside(signs, c[2]) &&
         is_inside(signs, c[1]) == is_inside(signs, c[3]) && is_inside(signs, c[0]) != is_inside(signs, c[1]);
}

// The only ambiguous face of a cell that has little of the inside; -1 for others.
int lone_ambiguous_face(Signs signs) {
  constexpr int kLittle = 3;  // corners
  if (std::popcount(signs) > kLittle) return -1;
  int found = -1;
  for (int f = 0; f < 6; ++f) {
    if (!is_ambiguous(signs, kFaces[f])) continue;
    if (found >= 0) return -1;
    found = f;
  }
  return found;
}

// The edges of a cell that the surface crosses, by the sheet that crosses them: sheet of each edge, -1 where
// none does.
struct Sheets {
  std::array<std::int8_t, 12> of_edge;
  int count = 0;
};

// Sheets that end on the same line of a face are one. Across an ambiguous face the inside is joined, or, if
// not `joins_inside`, the outside.
Sheets sheets_of(Signs signs, bool joins_inside) {
  std::array<int, 12> root;
  for (int e = 0; e < 12; ++e) root[e] = e;
  const auto find = [&](int e) {
    while (root[e] != e) e = root[e];
    return e;
  };
  for (const CellFace& face : kFaces) {
    std::array<int, 4> crossed{};
    int count = 0;
    for (int k = 0; k < 4; ++k)
      if (is_inside(signs, face.corners[k]) != is_inside(signs, face.corners[(k + 1) % 4]))
        crossed[count++] = face.edges[k];
    if (count == 2) root[find(crossed[0])] = find(crossed[1]);
    if (count < 4) continue;
    for (int k = 0; k < 4; ++k)  // around each corner that is cut off: the edges before and behind it
      if (is_inside(signs, face.corners[k]) != joins_inside)
        root[find(face.edges[(k + 3) % 4])] = find(face.edges[k]);
  }
  Sheets sheets;
  sheets.of_edge.fill(-1);
  std::array<int, 12> number;
  number.fill(-1);
  for (int e = 0; e < 12; ++e) {
    if (is_inside(signs, kEdges[e][0]) == is_inside(signs, kEdges[e][1])) continue;
    int& own = number[find(e)];
    if (own < 0) own = sheets.count++;
    sheets.of_edge[e] = static_cast<std::int8_t>(own);
  }
  return sheets;
}

// For all cells, and for both ways to join.
const std::array<std::array<Sheets, 256>, 2>& all_sheets() {
  static const auto all = [] {
    std::array<std::array<Sheets, 256>, 2> result;
    for (int signs = 0; signs < 256; ++signs)
      for (const bool joins_inside : {false, true})
        result[joins_inside][signs] = sheets_of(static_cast<Signs>(signs), joins_inside);
    return result;
  }();
  return all;
}

// The quad across an edge of the lattice, along x, y or z from a point: the four cells around it, as steps
// from the point, and which of their edges it is.
struct Around {
  std::array<Index3, 4> cells;
  std::array<int, 4> edges;
};
constexpr std::array<Around, 3> kAround = {
    {{{{{0, 0, 0}, {0, -1, 0}, {0, -1, -1}, {0, 0, -1}}}, {0, 4, 6, 2}},
     {{{{0, 0, 0}, {0, 0, -1}, {-1, 0, -1}, {-1, 0, 0}}}, {8, 11, 10, 9}},
     {{{{0, 0, 0}, {0, -1, 0}, {-1, -1, 0}, {-1, 0, 0}}}, {3, 7, 5, 1}}}};

Index3 operator+(const Index3& a, const Index3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

class Contouring {
 public:
  explicit Contouring(const DistanceField& field)
      : field_(field), lattice_(field.lattice), cell_(lattice_.count(), -1) {}

  IsoSurface surface() {
    visit({0, 0, 0}, kSpans.front(), 0);
    return std::move(surface_);
  }

 private:
  // Points of the lattice are visited in the order of OpenVDB's tree, whose dual contouring this follows:
  // cubes of 4096, 128 and 8, each x by x.
  static constexpr std::array<std::int32_t, 5> kSpans = {1 << 30, 4096, 128, 8, 1};

  // A cell with the vertices made in it so far, by sheet.
  struct Cell {
    Signs signs;
    const Sheets* sheets;
    std::array<std::int32_t, 4> vertices;
  };

  void visit(const Index3& begin, std::int32_t span, std::size_t level) {
    if (span == 1) return visit_point(begin);
    if (span == kSpans[3] && !changes_sign(begin)) return;
    const std::int32_t step = kSpans[level + 1];
    const auto end = [&](int axis) { return std::min(begin[axis] + span, lattice_.size[axis]); };
    for (std::int32_t i = begin[0]; i < end(0); i += step)
      for (std::int32_t j = begin[1]; j < end(1); j += step)
        for (std::int32_t k = begin[2]; k < end(2); k += step) visit({i, j, k}, step, level + 1);
  }

  // Whether there are both sides among the points of a cube of 8 and those behind it.
  bool changes_sign(const Index3& begin) const {
    const auto end = [&](int axis) { return std::min(begin[axis] + kSpans[3] + 1, lattice_.size[axis]); };
    const bool first = is_inside_at(begin);
    for (std::int32_t k = begin[2]; k < end(2); ++k)
      for (std::int32_t j = begin[1]; j < end(1); ++j) {
        const float* row = field_.values.data() + lattice_.index(0, j, k);
        for (std::int32_t i = begin[0]; i < end(0); ++i)
          if ((row[i] < 0) != first) return true;
      }
    return false;
  }

  bool is_inside_at(const Index3& p) const { return field_.values[lattice_.index(p[0], p[1], p[2])] < 0; }

  bool is_cell(const Index3& p) const {
    for (int axis = 0; axis < 3; ++axis)
      if (p[axis] < 0 || p[axis] + 1 >= lattice_.size[axis]) return false;
    return true;
  }

  void visit_point(const Index3& p) {
    const bool inside = is_inside_at(p);
    for (int axis = 0; axis < 3; ++axis) {
      Index3 next = p;
      if (++next[axis] >= lattice_.size[axis] || is_inside_at(next) == inside) continue;
      const Around& around = kAround[axis];
      if (!std::all_of(around.cells.begin(), around.cells.end(),
                       [&](const Index3& c) { return is_cell(p + c); }))
        continue;  // on a face of the lattice
      std::array<std::int32_t, 4> quad{};
      const bool is_reversed = inside == (axis == 2);
      for (int c = 0; c < 4; ++c) {
        const int from = is_reversed ? 3 - c : c;
        quad[c] = vertex(p + around.cells[from], around.edges[from]);
      }
      add(quad);
    }
  }

  void add(const std::array<std::int32_t, 4>& q) {
    // Ours: the second diagonal must be shorter by a thousandth, far above the rounding of points, so that no
    // last bit chooses between the equal diagonals of a symmetric surface.
    constexpr double kClearlyShorter = 0.999;
    const auto length2 = [&](int a, int b) {
      return (surface_.positions[q[a]] - surface_.positions[q[b]]).squaredNorm();
    };
    if (length2(1, 3) >= kClearlyShorter * length2(0, 2)) {
      surface_.triangles.push_back({q[0], q[1], q[2]});
      surface_.triangles.push_back({q[0], q[2], q[3]});
    } else {
      surface_.triangles.push_back({q[0], q[1], q[3]});
      surface_.triangles.push_back({q[1], q[2], q[3]});
    }
  }

  std::int32_t vertex(const Index3& at, int edge) {
    std::int32_t& number = cell_[lattice_.index(at[0], at[1], at[2])];
    if (number < 0) {
      number = static_cast<std::int32_t>(cells_.size());
      const Signs signs = signs_of(at);
      cells_.push_back({signs, &all_sheets()[joins_inside(at, signs)][signs], {-1, -1, -1, -1}});
    }
    Cell& cell = cells_[static_cast<std::size_t>(number)];
    const int sheet = cell.sheets->of_edge[edge];
    std::int32_t& vertex = cell.vertices[sheet];
    if (vertex < 0) {
      vertex = static_cast<std::int32_t>(surface_.positions.size());
      surface_.positions.push_back(lattice_.origin + lattice_.voxel * place(at, *cell.sheets, sheet));
    }
    return vertex;
  }

  // Beyond the lattice its values go on.
  Signs signs_of(const Index3& at) const {
    unsigned signs = 0;
    for (int c = 0; c < 8; ++c) {
      Index3 p = at + kCorners[c];
      for (int axis = 0; axis < 3; ++axis) p[axis] = std::clamp(p[axis], 0, lattice_.size[axis] - 1);
      if (is_inside_at(p)) signs |= 1u << c;
    }
    return static_cast<Signs>(signs);
  }

  // Two cells that share their lone ambiguous face keep the inside apart there; elsewhere it is joined, so
  // that both sides of a face always agree.
  bool joins_inside(const Index3& at, Signs signs) const {
    const int face = lone_ambiguous_face(signs);
    if (face < 0) return true;
    const int other = lone_ambiguous_face(signs_of(at + kFaces[face].across));
    return other < 0 || at + kFaces[face].across + kFaces[other].across != at;
  }

  // The mean of the points where a sheet crosses the edges of its cell, in voxels. In float, as OpenVDB has
  // it.
  Vec3 place(const Index3& at, const Sheets& sheets, int sheet) const {
    Vec3 sum = Vec3::Zero();
    int count = 0;
    for (int e = 0; e < 12; ++e) {
      if (sheets.of_edge[e] != sheet) continue;
      const Index3 &from = kCorners[kEdges[e][0]], &to = kCorners[kEdges[e][1]];
      const double a = value(at + from), b = value(at + to), crossing = -a / (b - a);
      for (int axis = 0; axis < 3; ++axis) sum[axis] += from[axis] == to[axis] ? from[axis] : crossing;
      ++count;
    }
    sum *= 1.0 / count;
    Vec3 result;
    for (int axis = 0; axis < 3; ++axis) result[axis] = static_cast<float>(at[axis] + sum[axis]);
    return result;
  }

  double value(const Index3& p) const { return field_.values[lattice_.index(p[0], p[1], p[2])]; }

  const DistanceField& field_;
  const Lattice& lattice_;
  std::vector<std::int32_t> cell_;  // by the lattice point below it: its number, -1 for none
  std::vector<Cell> cells_;
  IsoSurface surface_;
};

}  // namespace

IsoSurface extract_iso_surface(const DistanceField& field) {
  SF_EXPECT(field.values.size() == field.lattice.count());
  if (field.values.empty()) return {};
  return Contouring(field).surface();
}

}  // namespace skinforge

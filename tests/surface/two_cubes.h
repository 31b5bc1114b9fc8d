#pragma once

#include "surface/assemble.h"
#include "surface/shapes.h"

namespace skinforge::testing {

/// Unit cubes at z = 0 and z = 2, the lower without its top, the upper without its bottom, and the four walls
/// between them as a junction: with it the surface is a closed box of 1 x 1 x 3.
struct TwoCubes {
  std::vector<PolygonMesh> meshes = {quad_cube(), quad_cube(Vec3(0, 0, 2))};
  std::vector<PreservedSource> sources;
  std::vector<JunctionLoop> loops;
  KeptSurface kept;

  TwoCubes() {
    const std::vector<FaceSet> faces = {{1, 0, 1, 1, 1, 1}, {0, 1, 1, 1, 1, 1}};
    for (std::size_t s = 0; s < 2; ++s) {
      sources.push_back({&meshes[s], {}});
      sources[s].selection.kept = faces[s];
      for (const char k : faces[s]) sources[s].selection.face_site.push_back(k ? -1 : 0);
      std::vector<JunctionLoop> arcs;
      for (JunctionLoop& loop :
           loops_of_sites(sources[s], SourceId(s), std::vector<std::size_t>{0}, s == 0, arcs))
        loops.push_back(std::move(loop));
    }
    kept = kept_surface(sources);
  }
  TwoCubes(const TwoCubes&) = delete;
  TwoCubes& operator=(const TwoCubes&) = delete;

  /// Fixed vertices 0 .. 3 run along the lower border (4, 5, 7, 6 of its cube), 4 .. 7 along the upper one
  /// (0, 2, 3, 1 of its cube). Per wall the lower and the upper edge, from left to right as seen from
  /// outside.
  TrianglePatch borders() const {
    TrianglePatch patch;
    for (const JunctionLoop& loop : loops)
      patch.positions.insert(patch.positions.end(), loop.positions.begin(), loop.positions.end());
    patch.fixed = patch.positions.size();
    return patch;
  }
  static void add_quad(TrianglePatch& patch, int a, int b, int c, int d) {
    patch.triangles.push_back({a, b, c});
    patch.triangles.push_back({a, c, d});
  }

  /// Four walls of one quad each.
  TrianglePatch walls() const {
    TrianglePatch patch = borders();
    const int above[4] = {4, 7, 6, 5};
    for (int i = 0; i < 4; ++i) add_quad(patch, i, (i + 1) % 4, above[(i + 1) % 4], above[i]);
    return patch;
  }

  /// Four walls of two quads each: new vertices 8 .. 11 half way up.
  TrianglePatch halved_walls() const {
    TrianglePatch patch = borders();
    const int above[4] = {4, 7, 6, 5};
    for (int i = 0; i < 4; ++i) patch.positions.push_back(patch.positions[i] + Vec3(0, 0, 0.5));
    for (int i = 0; i < 4; ++i) {
      const int j = (i + 1) % 4;
      add_quad(patch, i, j, 8 + j, 8 + i);
      add_quad(patch, 8 + i, 8 + j, above[j], above[i]);
    }
    return patch;
  }

  JoinedSurface joined(const TrianglePatch& patch) const {
    Junction junction;
    junction.loops = loops;
    junction.patch = patch;
    return assemble_surface(sources, std::vector<Junction>{junction});
  }
};

}  // namespace skinforge::testing

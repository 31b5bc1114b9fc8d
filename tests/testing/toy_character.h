#pragma once

#include <cmath>
#include <string>

#include "io/export.h"
#include "model/character.h"

namespace skinforge::testing {

/// A small character with one of everything that a file can carry. Two parts: "body", a 2 x 1 x 1 box of 6
/// quads in two materials with UVs and colours, bound to the chain root - middle - tip along x; "face", a
/// pentagon, a concave hexagon and a triangle with two morph targets. Three clips with the three
/// interpolations. Passes `validate`.
class ToyCharacter {
 public:
  static Character make() {
    ToyCharacter toy;
    toy.add_skeleton();
    toy.add_materials();
    toy.add_body();
    toy.add_face();
    toy.add_weights();
    toy.add_clips();
    return toy.c_;
  }

 private:
  void add_skeleton() {
    c_.name = "toy";
    Transform step;
    step.translation = Vec3(1, 0, 0);
    step.rotation = Quat(Eigen::AngleAxisd(0.3, Vec3(1, 2, 2) / 3));
    step.scale = Vec3(1, 1, 1.5);
    Affine3 world = Affine3::Identity();
    for (const char* name : {"root", "middle", "tip"}) {
      Joint joint;
      joint.name = name;
      joint.parent = c_.skeleton.joints.empty() ? JointId() : JointId(c_.skeleton.size() - 1);
      if (joint.parent.is_valid()) joint.bind = step;
      world = world * joint.bind.matrix();
      joint.joint_from_model = world.inverse();
      c_.skeleton.joints.push_back(joint);
    }
  }

  void add_materials() {
    for (const int shade : {40, 200}) {
      Raster raster{2, 2, std::vector<std::uint8_t>(16, static_cast<std::uint8_t>(shade))};
      for (std::size_t i = 3; i < 16; i += 4) raster.rgba[i] = 255;
      c_.images.push_back({"image " + std::to_string(shade), "image/png", encode_png(raster)});
    }
    Material plain;
    plain.name = "plain";
    plain.base_color = Vec4(0.5, 0.25, 1, 0.75);
    plain.metallic = 0;
    plain.emissive = Vec3(2, 1, 0);
    plain.alpha_mode = AlphaMode::Mask;
    plain.alpha_cutoff = 0.25;
    plain.double_sided = true;
    Material textured;
    textured.name = "textured";
    textured.base_color_texture = TextureRef{
        ImageId(0), 0, Wrap::MirroredRepeat, Wrap::ClampToEdge, true, 1, Vec2(0.5, 0), Vec2(2, 1), 0.25};
    textured.normal_texture = TextureRef{ImageId(1)};
    textured.normal_texture->amount = 0.5;
    textured.unlit = true;
    c_.materials = {plain, textured};
  }

  void add_corner(VertexId vertex, const Vec3& normal, const Vec2& uv, const Vec4& color) {
    c_.mesh.corners.push_back(vertex);
    c_.mesh.normals.push_back(normal);
    c_.mesh.uvs[0].push_back(uv);
    c_.mesh.colors.push_back(color);
  }
  void end_face(MaterialId material, PartId part) {
    c_.mesh.face_begin.push_back(static_cast<std::int32_t>(c_.mesh.corners.size()));
    c_.mesh.face_material.push_back(material);
    c_.mesh.face_part.push_back(part);
  }

  void add_body() {
    PolygonMesh& mesh = c_.mesh;
    mesh.face_begin = {0};
    mesh.uvs.resize(1);
    mesh.parts.push_back({"body", 1, true, true});
    for (int i = 0; i < 8; ++i) mesh.positions.push_back(Vec3(2 * (i & 1), i >> 1 & 1, i >> 2));
    const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                             {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    const Vec2 square[4] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    for (int f = 0; f < 6; ++f) {
      const Vec3 a = mesh.positions[std::size_t(faces[f][1])] - mesh.positions[std::size_t(faces[f][0])];
      const Vec3 b = mesh.positions[std::size_t(faces[f][3])] - mesh.positions[std::size_t(faces[f][0])];
      for (int k = 0; k < 4; ++k)
        add_corner(VertexId(faces[f][k]), a.cross(b).normalized(), square[k],
                   Vec4(0.1 * f, 0.5, 0.25 * k, 1));
      end_face(MaterialId(f < 2 ? 0 : 1), PartId(0));
    }
  }

  /// Polygons in the plane x = 3, seen from +x.
  void add_face() {
    PolygonMesh& mesh = c_.mesh;
    mesh.parts.push_back({"face", 0, true, false});
    const auto first = static_cast<std::int32_t>(mesh.positions.size());
    for (int i = 0; i < 5; ++i) {
      const double angle = 2 * 3.14159265358979 * i / 5;
      mesh.positions.push_back(Vec3(3, std::cos(angle), std::sin(angle)));
    }
    // An L: its inner corner is at (0, 0) and a fan can only start there or at the outer corner.
    const double l[6][2] = {{-1, -1}, {1, -1}, {1, 0}, {0, 0}, {0, 1}, {-1, 1}};
    for (const auto& p : l) mesh.positions.push_back(Vec3(3, p[0] + 4, p[1]));
    add_polygon(first, 5);
    add_polygon(first + 5, 6);
    add_polygon(first + 5, 3);
    c_.morphs.push_back({"smile",
                         PartId(1),
                         0.25,
                         {VertexId(first), VertexId(first + 3)},
                         {Vec3(0, 0.5, 0), Vec3(0, 0, -1)}});
    c_.morphs.push_back({"frown", PartId(1), 0, {VertexId(first + 1)}, {Vec3(0.125, 0, 0)}});
  }
  void add_polygon(std::int32_t first, std::int32_t size) {
    for (std::int32_t i = 0; i < size; ++i)
      add_corner(VertexId(first + i), Vec3::UnitX(), Vec2::Zero(), Vec4::Zero());
    end_face(MaterialId(), PartId(1));
  }

  void add_weights() {
    for (std::size_t v = 0; v < c_.mesh.vertex_count(); ++v) {
      const double t = std::min(c_.mesh.positions[v].x() / 3, 1.0);
      const std::vector<Influence> row = {{JointId(0), 1 - t}, {JointId(1), 0.1}, {JointId(2), t}};
      c_.weights.push_row(normalised_row(row));
    }
  }

  void add_clips() {
    const auto turn = [](double angle) { return Quat(Eigen::AngleAxisd(angle, Vec3::UnitY())); };
    Clip bend{"bend", 1, {}, {}};
    bend.joints.push_back(
        {JointId(1), {}, {Interpolation::Linear, {0, 0.5, 1}, {turn(0), turn(0.5), turn(1)}}, {}});
    bend.joints.push_back({JointId(2),
                           {Interpolation::Step, {0, 0.5, 1}, {Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(1, 0, 0)}},
                           {},
                           {}});
    bend.morphs.push_back({PartId(1), {Interpolation::Linear, {0, 1}, {{0, 0.5}, {1, 0.25}}}});
    Clip spline{"spline", 0.7, {}, {}};
    spline.joints.push_back(
        {JointId(0),
         {Interpolation::CubicSpline,
          {0.1, 0.7},
          {Vec3(0, 0, 0), Vec3(0.1, 0.2, 0.3), Vec3(1, 1, 1), Vec3(-1, 0, 0), Vec3(1, 2, 3), Vec3(0, 0, 0)}},
         {},
         {Interpolation::Linear, {0, 0.7}, {Vec3(1, 1, 1), Vec3(2, 2, 2)}}});
    Clip still{"still", 2, {}, {}};
    c_.clips = {bend, spline, still};
  }

  Character c_;
};

}  // namespace skinforge::testing

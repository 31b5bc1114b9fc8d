#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/issue.h"
#include "model/clip.h"
#include "model/material.h"
#include "model/transform.h"

namespace skinforge {

/// A scene as its file has it: permissive, nothing settled. Readers fill it, `build_character` settles every quirk once.
/// Units and axes are those of the file; `metres_from_file` says how to leave them.
struct RawScene {
  struct Node {
    std::string name;  ///< may be empty or used twice
    std::int32_t parent = -1;
    Transform local;               ///< the file's default pose
    std::optional<Affine3> matrix; ///< set when the file gives a matrix that has no TRS form
    std::int32_t mesh = -1;
    std::int32_t skin = -1;

    template <class Archive>
    friend void fields(Archive& a, Node& n) {
      a(n.name, n.parent, n.local, n.matrix, n.mesh, n.skin);
    }
  };

  /// Polygons of one material. Vertices as the file has them (unwelded where it splits them).
  struct Primitive {
    std::int32_t material = -1;
    std::vector<Vec3> positions;              ///< mesh space
    std::vector<Vec3> normals;                ///< per vertex, or empty
    std::vector<std::vector<Vec2>> uvs;       ///< per set, per vertex; glTF convention (v down)
    std::vector<Vec4> colors;                 ///< per vertex, or empty
    std::vector<std::int32_t> face_begin = {0};
    std::vector<std::int32_t> corners;        ///< vertex of each corner
    std::vector<std::int32_t> weight_begin;   ///< #V + 1, or empty when not skinned
    std::vector<std::int32_t> weight_joint;   ///< index into the joints of the node's skin
    std::vector<double> weight_value;         ///< as stored: may be NaN, negative, unnormalised
    std::vector<std::vector<Vec3>> morph_offsets;  ///< per target, per vertex

    template <class Archive>
    friend void fields(Archive& a, Primitive& p) {
      a(p.material, p.positions, p.normals, p.uvs, p.colors, p.face_begin, p.corners, p.weight_begin,
        p.weight_joint, p.weight_value, p.morph_offsets);
    }
  };

  struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;
    std::vector<std::string> morph_names;
    std::vector<double> morph_weights;  ///< defaults

    template <class Archive>
    friend void fields(Archive& a, Mesh& m) {
      a(m.name, m.primitives, m.morph_names, m.morph_weights);
    }
  };

  struct Skin {
    std::string name;
    std::vector<std::int32_t> joints;       ///< nodes
    std::vector<Affine3> inverse_bind;      ///< joint_from_mesh, one per joint, or empty = identity

    template <class Archive>
    friend void fields(Archive& a, Skin& s) {
      a(s.name, s.joints, s.inverse_bind);
    }
  };

  /// Tracks of one node; times in seconds.
  struct NodeTracks {
    std::int32_t node = -1;
    Vec3Track translation;
    QuatTrack rotation;
    Vec3Track scale;
    WeightsTrack morph_weights;

    template <class Archive>
    friend void fields(Archive& a, NodeTracks& t) {
      a(t.node, t.translation, t.rotation, t.scale, t.morph_weights);
    }
  };

  struct Animation {
    std::string name;
    std::vector<NodeTracks> nodes;

    template <class Archive>
    friend void fields(Archive& a, Animation& n) {
      a(n.name, n.nodes);
    }
  };

  Similarity metres_from_file;  ///< to metres, Y up, right-handed
  bool skin_ignores_mesh_node = true;  ///< glTF: skinned vertices are placed by the joints alone
  bool triangles_only = true;          ///< the format has no polygons: quads may be recovered
  std::vector<Node> nodes;
  std::vector<Mesh> meshes;
  std::vector<Skin> skins;
  std::vector<Material> materials;
  std::vector<Image> images;
  std::vector<Animation> animations;
  std::vector<Issue> issues;  ///< met while reading

  template <class Archive>
  friend void fields(Archive& a, RawScene& s) {
    a(s.metres_from_file, s.skin_ignores_mesh_node, s.triangles_only, s.nodes, s.meshes, s.skins, s.materials,
      s.images, s.animations, s.issues);
  }
};

}  // namespace skinforge

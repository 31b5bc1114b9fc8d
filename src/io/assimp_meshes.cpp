#include "io/assimp_meshes.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

#include "io/assimp_values.h"

namespace skinforge {
namespace {

/// The first node of that name, parents first; null where there is none.
const aiNode* find_node(const aiNode* root, const aiString& name) {
  std::vector<const aiNode*> open = {root};
  while (!open.empty()) {
    const aiNode* node = open.back();
    open.pop_back();
    if (node->mName == name) return node;
    for (unsigned c = node->mNumChildren; c-- > 0;) open.push_back(node->mChildren[c]);
  }
  return nullptr;
}

/// One bind of one joint: the node and the bits of its matrix. A node whose geometries were bound
/// differently stands in the skin once for each bind.
using BindKey = std::pair<std::int32_t, std::array<float, 12>>;

BindKey bind_key(std::int32_t node, const aiMatrix4x4& offset) {
  BindKey key{node, {}};
  std::memcpy(key.second.data(), &offset.a1, sizeof key.second);
  return key;
}

/// What all vertices of one node go through before the file's node transform applies.
struct VertexMap {
  Affine3 points;
  Mat3 normals;
};

class MeshReader {
 public:
  MeshReader(const aiScene& source, const NodeIndex& index, const std::vector<std::int32_t>& material,
             RawScene& scene)
      : source_(source), index_(index), material_(material), scene_(scene) {}

  void read(const aiNode& node, std::int32_t target, const Affine3& geometric) {
    map_ = {geometric, geometric.linear().inverse().transpose()};
    skin_ = {};
    slots_.clear();
    RawScene::Mesh mesh;
    mesh.name = to_text(source_.mMeshes[node.mMeshes[0]]->mName);
    collect_morphs(node, mesh);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) add_primitive(*source_.mMeshes[node.mMeshes[i]], mesh);
    if (mesh.primitives.empty()) return;
    RawScene::Node& owner = scene_.nodes[static_cast<std::size_t>(target)];
    owner.mesh = static_cast<std::int32_t>(scene_.meshes.size());
    scene_.meshes.push_back(std::move(mesh));
    if (skin_.joints.empty()) return;
    owner.skin = static_cast<std::int32_t>(scene_.skins.size());
    skin_.name = owner.name;
    scene_.skins.push_back(std::move(skin_));
  }

 private:
  static std::string morph_name(const aiMesh& mesh, unsigned target) {
    const std::string name = to_text(mesh.mAnimMeshes[target]->mName);
    return name.empty() ? fmt::format("shape{}", target) : name;
  }

  /// Targets by name: Assimp may give the parts of one mesh different lists.
  void collect_morphs(const aiNode& node, RawScene::Mesh& mesh) const {
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      const aiMesh& part = *source_.mMeshes[node.mMeshes[i]];
      for (unsigned t = 0; t < part.mNumAnimMeshes; ++t) {
        const std::string name = morph_name(part, t);
        if (std::find(mesh.morph_names.begin(), mesh.morph_names.end(), name) != mesh.morph_names.end())
          continue;
        mesh.morph_names.push_back(name);
        const double weight = part.mAnimMeshes[t]->mWeight;
        mesh.morph_weights.push_back(weight == 1 ? 0 : weight);  // a lone FBX shape always says 1
      }
    }
  }

  void add_primitive(const aiMesh& mesh, RawScene::Mesh& target) {
    RawScene::Primitive p;
    p.material = mesh.mMaterialIndex < material_.size() ? material_[mesh.mMaterialIndex] : -1;
    read_faces(mesh, p);
    if (p.corners.empty()) return;
    read_vertices(mesh, p);
    read_weights(mesh, p);
    read_morphs(mesh, target, p);
    target.primitives.push_back(std::move(p));
  }

  /// The corner at which a face begins: files leave open how a quad is split, so it begins at an end of its
  /// shorter diagonal (a tie takes corner 0).
  static unsigned first_corner(const aiMesh& mesh, const aiFace& face) {
    if (face.mNumIndices != 4) return 0;
    const auto at = [&](unsigned c) { return to_vec3(mesh.mVertices[face.mIndices[c]]); };
    return (at(3) - at(1)).squaredNorm() < (at(2) - at(0)).squaredNorm() ? 1 : 0;
  }

  void read_faces(const aiMesh& mesh, RawScene::Primitive& p) {
    std::size_t thin = 0;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices < 3) {
        ++thin;
        continue;
      }
      const unsigned first = first_corner(mesh, face);
      for (unsigned c = 0; c < face.mNumIndices; ++c)
        p.corners.push_back(static_cast<std::int32_t>(face.mIndices[(first + c) % face.mNumIndices]));
      p.face_begin.push_back(static_cast<std::int32_t>(p.corners.size()));
    }
    if (thin > 0)
      scene_.issues.push_back({"points-and-lines-dropped", Severity::Warning, "mesh " + to_text(mesh.mName),
                               fmt::format("{} points or lines", thin)});
  }

  void read_vertices(const aiMesh& mesh, RawScene::Primitive& p) const {
    const std::size_t count = mesh.mNumVertices;
    for (std::size_t v = 0; v < count; ++v) p.positions.push_back(map_.points * to_vec3(mesh.mVertices[v]));
    for (std::size_t v = 0; mesh.mNormals && v < count; ++v)
      p.normals.push_back((map_.normals * to_vec3(mesh.mNormals[v])).stableNormalized());
    for (unsigned set = 0; set < AI_MAX_NUMBER_OF_TEXTURECOORDS && mesh.mTextureCoords[set]; ++set) {
      p.uvs.emplace_back();
      for (std::size_t v = 0; v < count; ++v)
        p.uvs.back().emplace_back(mesh.mTextureCoords[set][v].x, 1.0 - mesh.mTextureCoords[set][v].y);
    }
    for (std::size_t v = 0; mesh.mColors[0] && v < count; ++v) {
      const aiColor4D& c = mesh.mColors[0][v];
      p.colors.emplace_back(c.r, c.g, c.b, c.a);
    }
  }

  /// Where a bone stands in the skin of the current node; -1 when its node is unknown.
  std::int32_t slot_of(const aiBone& bone) {
    const aiNode* node = bone.mNode ? bone.mNode : find_node(source_.mRootNode, bone.mName);
    const auto found = index_.find(node);
    if (found == index_.end()) return -1;
    const auto [slot, is_new] = slots_.try_emplace(bind_key(found->second, bone.mOffsetMatrix),
                                                   static_cast<std::int32_t>(skin_.joints.size()));
    if (is_new) {
      skin_.joints.push_back(found->second);
      skin_.inverse_bind.push_back(to_affine(bone.mOffsetMatrix));
    }
    return slot->second;
  }

  void read_weights(const aiMesh& mesh, RawScene::Primitive& p) {
    if (mesh.mNumBones == 0) return;
    std::vector<std::vector<std::pair<std::int32_t, double>>> rows(mesh.mNumVertices);
    std::size_t lost = 0;
    for (unsigned b = 0; b < mesh.mNumBones; ++b) {
      const aiBone& bone = *mesh.mBones[b];
      const std::int32_t slot = slot_of(bone);
      for (unsigned w = 0; w < bone.mNumWeights; ++w) {
        const aiVertexWeight& weight = bone.mWeights[w];
        if (slot < 0 || weight.mVertexId >= mesh.mNumVertices)
          ++lost;
        else
          rows[weight.mVertexId].emplace_back(slot, weight.mWeight);
      }
    }
    if (lost > 0)
      scene_.issues.push_back({"weights-without-target", Severity::Warning, "mesh " + to_text(mesh.mName),
                               fmt::format("{} weights name a joint or vertex that is not there", lost)});
    p.weight_begin = {0};
    for (const auto& row : rows) {
      for (const auto& [slot, value] : row) {
        p.weight_joint.push_back(slot);
        p.weight_value.push_back(value);
      }
      p.weight_begin.push_back(static_cast<std::int32_t>(p.weight_joint.size()));
    }
  }

  void read_morphs(const aiMesh& mesh, const RawScene::Mesh& target, RawScene::Primitive& p) const {
    p.morph_offsets.assign(target.morph_names.size(), std::vector<Vec3>(mesh.mNumVertices, Vec3::Zero()));
    for (unsigned t = 0; t < mesh.mNumAnimMeshes; ++t) {
      const aiAnimMesh& shape = *mesh.mAnimMeshes[t];
      if (!shape.mVertices || shape.mNumVertices != mesh.mNumVertices) continue;
      const auto name = std::find(target.morph_names.begin(), target.morph_names.end(), morph_name(mesh, t));
      auto& offsets = p.morph_offsets[static_cast<std::size_t>(name - target.morph_names.begin())];
      for (std::size_t v = 0; v < offsets.size(); ++v)
        offsets[v] = map_.points.linear() * (to_vec3(shape.mVertices[v]) - to_vec3(mesh.mVertices[v]));
    }
  }

  const aiScene& source_;
  const NodeIndex& index_;
  const std::vector<std::int32_t>& material_;
  RawScene& scene_;
  VertexMap map_;
  RawScene::Skin skin_;
  std::map<BindKey, std::int32_t> slots_;
};

}  // namespace

void read_meshes(const aiScene& source, const NodeIndex& index, const std::vector<Affine3>& geometric,
                 const std::vector<std::int32_t>& material, RawScene& scene) {
  std::vector<std::pair<std::int32_t, const aiNode*>> owners;
  for (const auto& [node, target] : index)
    if (node->mNumMeshes > 0) owners.emplace_back(target, node);
  std::sort(owners.begin(), owners.end());
  MeshReader reader(source, index, material, scene);
  for (const auto& [target, node] : owners)
    reader.read(*node, target, geometric[static_cast<std::size_t>(target)]);
}

}  // namespace skinforge

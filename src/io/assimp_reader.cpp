#include "io/assimp_reader.h"

#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <memory>
#include <optional>
#include <string_view>

#include "base/error.h"
#include "base/text.h"
#include "io/assimp_animations.h"
#include "io/assimp_materials.h"
#include "io/assimp_meshes.h"
#include "io/assimp_values.h"
#include "io/dae_check.h"
#include "io/fbx_animation.h"
#include "io/fbx_scene.h"
#include "io/file_kind.h"
#include "io/memory_io_system.h"
#include "io/obj_check.h"
#include "io/trs.h"

namespace skinforge {
namespace {

constexpr double kShear = 1e-4;  // a float matrix that went through a chain of products is this far from TRS
constexpr std::string_view kPivotMark = "_$AssimpFbx$_";  // Assimp's names for the steps of an FBX transform

/// A scene as it is read with the settings that `design/dependencies.md` measured; owns it.
class Reading {
 public:
  Reading(const std::vector<InputFile>& files, bool keep_pivots) : system_(files) {
    const std::unique_ptr<aiPropertyStore, decltype(&aiReleasePropertyStore)> settings(
        aiCreatePropertyStore(), &aiReleasePropertyStore);
    aiSetImportPropertyInteger(settings.get(), AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, keep_pivots);
    aiSetImportPropertyInteger(settings.get(), AI_CONFIG_IMPORT_REMOVE_EMPTY_BONES, 0);
    aiSetImportPropertyInteger(settings.get(), AI_CONFIG_IMPORT_FBX_READ_ANIMATIONS, !keep_pivots);
    scene_.reset(aiImportFileExWithProperties(files.front().path.c_str(), aiProcess_PopulateArmatureData,
                                              &system_.callbacks(), settings.get()));
    if (!scene_ || !scene_->mRootNode) throw Error(ExitCode::BadInput, reason());
  }
  const aiScene& scene() const { return *scene_; }
  const MemoryIoSystem& files() const { return system_; }

 private:
  static std::string reason() {
    const std::string text = aiGetErrorString();
    return text.empty() ? "no importer knows this file" : text;
  }

  MemoryIoSystem system_;
  std::unique_ptr<const aiScene, decltype(&aiReleaseImport)> scene_{nullptr, &aiReleaseImport};
};

/// All nodes, parents first, children in their order, without recursion.
std::vector<const aiNode*> preorder(const aiNode* root) {
  std::vector<const aiNode*> order, open = {root};
  while (!open.empty()) {
    const aiNode* node = open.back();
    open.pop_back();
    order.push_back(node);
    for (unsigned c = node->mNumChildren; c-- > 0;) open.push_back(node->mChildren[c]);
  }
  return order;
}

/// Assimp puts a root of its own above what the file has.
bool is_added_root(const aiScene& source) {
  const aiNode& root = *source.mRootNode;
  return root.mTransformation.IsIdentity() && root.mNumMeshes == 0 && root.mNumChildren > 0;
}

std::vector<bool> animated_names(const aiScene& source, const std::vector<const aiNode*>& nodes) {
  std::map<std::string, std::size_t> by_name;
  for (std::size_t n = 0; n < nodes.size(); ++n) by_name.try_emplace(to_text(nodes[n]->mName), n);
  std::vector<bool> animated(nodes.size(), false);
  for (unsigned a = 0; a < source.mNumAnimations; ++a)
    for (unsigned c = 0; c < source.mAnimations[a]->mNumChannels; ++c) {
      const auto found = by_name.find(to_text(source.mAnimations[a]->mChannels[c]->mNodeName));
      if (found != by_name.end()) animated[found->second] = true;
    }
  return animated;
}

void set_local(RawScene::Node& node, const Affine3& matrix) {
  const TrsForm form = to_trs(matrix);
  node.local = form.transform;
  if (form.error > kShear) node.matrix = matrix;
}

NodeIndex read_nodes(const aiScene& source, RawScene& scene) {
  std::vector<const aiNode*> nodes = preorder(source.mRootNode);
  if (is_added_root(source) && !animated_names(source, nodes)[0]) nodes.erase(nodes.begin());
  NodeIndex index;
  for (const aiNode* node : nodes) {
    index[node] = static_cast<std::int32_t>(scene.nodes.size());
    RawScene::Node& target = scene.nodes.emplace_back();
    target.name = to_text(node->mName);
    const auto parent = index.find(node->mParent);
    if (parent != index.end()) target.parent = parent->second;
    set_local(target, to_affine(node->mTransformation));
  }
  return index;
}

std::size_t occurrences(const Bytes& bytes, std::string_view word) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  std::size_t count = 0;
  for (auto at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

/// The table of defaults names each property once; more often means that a node has its own.
bool may_have_geometric_transforms(const InputFile& file) {
  for (const char* word : {"GeometricTranslation", "GeometricRotation", "GeometricScaling"})
    if (occurrences(file.bytes, word) > 1) return true;
  return false;
}

/// The geometric transform of each mesh node, by the node's name: with its pivots kept, Assimp writes it as
/// nodes right above.
std::map<std::string, Affine3> geometric_transforms(const aiScene& pivots) {
  std::map<std::string, Affine3> result;
  for (const aiNode* node : preorder(pivots.mRootNode)) {
    Affine3 product = Affine3::Identity();
    for (const aiNode* step = node->mParent; step; step = step->mParent) {
      const std::string name = to_text(step->mName);
      const auto mark = name.find(kPivotMark);
      if (mark == std::string::npos || name.compare(mark + kPivotMark.size(), 9, "Geometric") != 0) break;
      if (name.ends_with("Inverse")) break;
      product = to_affine(step->mTransformation) * product;
    }
    if (!product.isApprox(Affine3::Identity(), 0)) result.emplace(to_text(node->mName), product);
  }
  return result;
}

/// Takes the geometric transforms out of the nodes, where Assimp puts them without the pivots, and returns
/// them: in FBX they act on the vertices alone, neither on children nor in the bind matrices.
std::vector<Affine3> split_geometric(const std::vector<InputFile>& files, RawScene& scene) {
  std::vector<Affine3> geometric(scene.nodes.size(), Affine3::Identity());
  if (!may_have_geometric_transforms(files.front())) return geometric;
  const Reading pivots(files, true);
  const auto found = geometric_transforms(pivots.scene());
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
    RawScene::Node& node = scene.nodes[n];
    const auto entry = found.find(node.name);
    if (entry == found.end() || std::abs(entry->second.linear().determinant()) == 0) continue;
    geometric[n] = entry->second;
    const Affine3 local = node.matrix.value_or(node.local.matrix());
    node.matrix.reset();
    set_local(node, local * entry->second.inverse());
  }
  return geometric;
}

Vec3 axis(const aiMetadata& data, const char* index_key, const char* sign_key, int fallback) {
  std::int32_t index = fallback, sign = 1;
  data.Get(index_key, index);
  data.Get(sign_key, sign);
  Vec3 direction = Vec3::Zero();
  direction[std::clamp(index, 0, 2)] = sign < 0 ? -1 : 1;
  return direction;
}

/// FBX global settings: centimetres per unit, and which axes point right, up and to the viewer.
Similarity metres_from_fbx(const aiScene& source, RawScene& scene) {
  Similarity s;
  if (!source.mMetaData) return s;
  const aiMetadata& data = *source.mMetaData;
  double centimetres = 1;
  float narrow = 0;
  if (!data.Get("UnitScaleFactor", centimetres) && data.Get("UnitScaleFactor", narrow))
    centimetres = static_cast<double>(narrow);
  if (!(centimetres > 0) || !std::isfinite(centimetres)) centimetres = 1;
  s.scale = centimetres / 100;
  const Vec3 up = axis(data, "UpAxis", "UpAxisSign", 1), front = axis(data, "FrontAxis", "FrontAxisSign", 2);
  const Vec3 right = axis(data, "CoordAxis", "CoordAxisSign", 0);
  if (std::abs(up.dot(front)) > 0) return s;
  Mat3 turn;
  turn << up.cross(front).transpose(), up.transpose(), front.transpose();
  s.rotation = Quat(turn).normalized();
  if (up.cross(front) != right)
    scene.issues.push_back({"axes-left-handed", Severity::Warning, "scene",
                            "the axes of the file are left-handed; taken as right-handed"});
  return s;
}

/// Materials that neither give a colour nor a texture: what they look like is the default of the format.
void note_missing_colors(const FbxScene& fbx, RawScene& scene) {
  for (const std::int64_t id : fbx.all("Material")) {
    const FbxNode& material = *fbx.object(id);
    if (fbx_has(material, "DiffuseColor") || fbx_has(material, "Diffuse") || !fbx.sources(id).empty())
      continue;
    scene.issues.push_back({"material-without-colour", Severity::Note, "material " + printable(fbx.name(id)),
                            "the file gives neither colour nor texture; it is grey by default"});
  }
}

constexpr int kNewestVersion = 7700;

/// The FBX file as we read it ourselves, beside Assimp. A form that we do not understand is no fault of the
/// file as long as Assimp does; what `check_fbx` finds is.
class FbxSide {
 public:
  explicit FbxSide(const InputFile& file) {
    try {
      file_ = parse_fbx(file.bytes);
    } catch (const Error& error) {
      trouble_ = error.what();
      return;
    }
    scene_.emplace(file_.root);
    check_fbx(*scene_);
  }
  FbxSide(const FbxSide&) = delete;  // its parts point at each other
  FbxSide& operator=(const FbxSide&) = delete;

  void add_to(RawScene& scene) const {
    if (file_.version > kNewestVersion)
      scene.issues.push_back({"fbx-version", Severity::Warning, "scene",
                              fmt::format("FBX version {} is newer than {}", file_.version, kNewestVersion)});
    if (scene_) {
      note_missing_colors(*scene_, scene);
      restore_fbx_curves(*scene_, scene);
    } else {
      scene.issues.push_back({"fbx-unchecked", Severity::Warning, "scene",
                              "the file could not be checked, and curves are read as keys: " + trouble_});
    }
  }

 private:
  FbxFile file_;
  std::optional<FbxScene> scene_;
  std::string trouble_;
};

struct Source {
  std::optional<FbxSide> fbx;
  std::optional<Reading> reading;
};

}  // namespace

AssimpScene read_with_assimp(const std::vector<InputFile>& files) {
  const auto owner = std::make_shared<Source>();
  std::optional<FbxSide>& fbx = owner->fbx;
  RawScene scene;
  const std::string extension = lower_extension(files.front().path);
  if (extension == ".fbx") fbx.emplace(files.front());
  if (extension == ".dae") check_dae(files.front(), scene.issues);
  if (extension == ".obj") check_obj(files, scene.issues);
  const Reading& reading = owner->reading.emplace(files, false);
  const aiScene& source = reading.scene();
  scene.skin_ignores_mesh_node = false;
  scene.triangles_only = false;
  const NodeIndex index = read_nodes(source, scene);
  std::vector<Affine3> geometric(scene.nodes.size(), Affine3::Identity());
  if (fbx) {
    scene.metres_from_file = metres_from_fbx(source, scene);
    geometric = split_geometric(files, scene);
  }
  const auto material = read_materials(source, fbx.has_value(), reading.files(), scene);
  read_meshes(source, index, geometric, material, scene);
  read_animations(source, index, scene);
  if (fbx) fbx->add_to(scene);
  return {std::move(scene), owner};
}

}  // namespace skinforge

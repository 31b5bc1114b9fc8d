#include "io/fbx_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "base/error.h"
#include "base/limits.h"
#include "base/text.h"

namespace skinforge {
namespace {

/// Frames per second of the time modes of the FBX SDK (FbxTime::EMode).
double rate_of_mode(std::int64_t mode, double custom) {
  constexpr std::array<double, 18> kRates = {30,    120, 100, 60,   50,     48, 30, 30, 29.97,
                                             29.97, 25,  24,  1000, 23.976, 0,  96, 72, 59.94};
  if (mode == 14 && custom > 0) return custom;
  return mode >= 0 && mode < 18 && mode != 14 ? kRates[static_cast<std::size_t>(mode)] : 30;
}

const FbxNode* property(const FbxNode& object, const std::string& name) {
  const FbxNode* table = object.child("Properties70");
  if (!table) return nullptr;
  for (const FbxNode& entry : table->children)
    if (entry.text(0) == name) return &entry;
  return nullptr;
}

/// A property that names one of a few: `fallback` when it is not there, 0 when it is no number that 64 bits
/// hold.
std::int64_t choice(const FbxNode& object, const std::string& name, std::int64_t fallback) {
  const FbxNode* entry = property(object, name);
  return entry && entry->values.size() >= 5 ? entry->integer(4) : fallback;
}

Quat euler(const Vec3& degrees_xyz, int order) {
  static constexpr std::array<std::array<int, 3>, 6> kOrders = {
      {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}, {1, 0, 2}, {2, 0, 1}, {2, 1, 0}}};
  Quat turn = Quat::Identity();
  for (const int axis : kOrders[static_cast<std::size_t>(order)])
    if (degrees_xyz[axis] != 0)
      turn = Quat(Eigen::AngleAxisd(radians(degrees_xyz[axis]), Vec3::Unit(axis))) * turn;
  return turn;
}

/// Models that a model hangs under.
std::vector<FbxScene::Link> parents_of(const FbxScene& scene, std::int64_t model) {
  std::vector<FbxScene::Link> parents;
  for (const FbxScene::Link& link : scene.targets(model)) {
    const FbxNode* target = scene.object(link.object);
    if (link.property.empty() && target && target->name == "Model") parents.push_back(link);
  }
  return parents;
}

/// How often a model stands at the root of the scene.
double copies_at_root(const FbxScene& scene, std::int64_t model) {
  for (const FbxScene::Link& link : scene.targets(model))
    if (link.object == 0 && link.property.empty()) return static_cast<double>(link.times);
  return 0;
}

/// Takes away models without parents until none is left, or only cycles and what hangs under them; counts the
/// nodes that they become, as Assimp makes a copy of a model under each of its parents.
class TreeCheck {
 public:
  explicit TreeCheck(const FbxScene& scene) : scene_(scene) {
    for (const std::int64_t model : scene.all("Model")) {
      copies_[model] = copies_at_root(scene, model);
      parents_[model] = parents_of(scene, model);
      for (const FbxScene::Link& parent : parents_[model])
        children_[parent.object].push_back({model, {}, parent.times});
      if (parents_[model].empty())
        roots_.push_back(model);
      else
        left_[model] = parents_[model].size();
    }
  }

  void run() {
    double nodes = 0;
    while (!roots_.empty()) {
      const std::int64_t root = roots_.back();
      roots_.pop_back();
      nodes += copies_[root];
      if (nodes > static_cast<double>(limits().nodes))
        throw Error(ExitCode::BadInput,
                    fmt::format("FBX: with node \"{}\" under each of its parents {} nodes, {}",
                                printable(scene_.name(root)), nodes, limit_hint("nodes")));
      for (const FbxScene::Link& child : children_[root]) {
        copies_[child.object] += copies_[root] * static_cast<double>(child.times);
        if (--left_[child.object] > 0) continue;
        left_.erase(child.object);
        roots_.push_back(child.object);
      }
    }
    if (!left_.empty()) refuse_cycle();
  }

 private:
  [[noreturn]] void refuse_cycle() {
    std::int64_t here = left_.begin()->first;
    for (std::set<std::int64_t> path; path.insert(here).second;) {
      const auto& above = parents_[here];
      here = std::find_if(above.begin(), above.end(), [&](const FbxScene::Link& parent) {
               return left_.count(parent.object) > 0;
             })->object;
    }
    throw Error(ExitCode::BadInput,
                fmt::format("FBX: node \"{}\" is its own ancestor", printable(scene_.name(here))));
  }

  const FbxScene& scene_;
  std::map<std::int64_t, std::vector<FbxScene::Link>> parents_, children_;
  std::map<std::int64_t, double> copies_;
  std::map<std::int64_t, std::size_t> left_;  ///< parents not yet taken away
  std::vector<std::int64_t> roots_;
};

/// Returns the number of vertices.
std::size_t check_geometry(const FbxNode& geometry) {
  const std::vector<double> coordinates = numbers_of(geometry.child("Vertices"));
  const std::vector<double> corners = numbers_of(geometry.child("PolygonVertexIndex"));
  const std::size_t count = coordinates.size() / 3;
  if (count > limits().vertices)
    throw Error(ExitCode::BadInput, fmt::format("FBX: {} vertices, {}", count, limit_hint("vertices")));
  for (const double corner : corners) {
    const double vertex = corner < 0 ? -corner - 1 : corner;  // the last of a face is written as ~index
    if (!(vertex < static_cast<double>(count)))
      throw Error(ExitCode::BadInput, fmt::format("FBX: a face uses vertex {} of {}", vertex, count));
  }
  return count;
}

/// `counts`: vertices by geometry.
void check_cluster(const FbxScene& scene, std::int64_t cluster,
                   const std::map<std::int64_t, std::size_t>& counts) {
  const std::vector<double> vertices = numbers_of(scene.object(cluster)->child("Indexes"));
  std::optional<std::size_t> least;  // vertices of the smallest geometry that it deforms
  for (const FbxScene::Link& skin : scene.targets(cluster))
    for (const FbxScene::Link& geometry : scene.targets(skin.object))
      if (const auto count = counts.find(geometry.object); count != counts.end())
        least = std::min(least.value_or(count->second), count->second);
  if (!least) return;
  for (const double vertex : vertices)
    if (!(vertex >= 0 && vertex < static_cast<double>(*least)))
      throw Error(ExitCode::BadInput, fmt::format("FBX: cluster \"{}\" weights vertex {} of {}",
                                                  printable(scene.name(cluster)), vertex, *least));
}

}  // namespace

FbxScene::FbxScene(const FbxNode& root) : root_(root) {
  if (const FbxNode* list = root.child("Objects"))
    for (const FbxNode& object : list->children) objects_.emplace(object.integer(0), &object);
  const FbxNode* list = root.child("Connections");
  std::map<std::tuple<std::int64_t, std::int64_t, std::string>, std::pair<std::size_t, std::size_t>> known;
  for (std::size_t i = 0; list && i < list->children.size(); ++i) {
    const FbxNode& c = list->children[i];
    if (c.values.size() < 3) continue;
    const std::string property = c.text(0) == "OP" ? c.text(3) : "";
    auto &sources = sources_[c.integer(2)], &targets = targets_[c.integer(1)];
    const auto [link, is_new] =
        known.try_emplace({c.integer(1), c.integer(2), property}, sources.size(), targets.size());
    if (is_new) {
      sources.push_back({c.integer(1), property, 0});
      targets.push_back({c.integer(2), property, 0});
    }
    ++sources[link->second.first].times;
    ++targets[link->second.second].times;
  }
}

const FbxNode* FbxScene::object(std::int64_t id) const {
  const auto found = objects_.find(id);
  return found == objects_.end() ? nullptr : found->second;
}

std::vector<std::int64_t> FbxScene::all(const std::string& node_name) const {
  std::vector<std::int64_t> ids;
  const FbxNode* list = root_.child("Objects");
  for (std::size_t i = 0; list && i < list->children.size(); ++i) {
    const FbxNode& node = list->children[i];
    if (node.name == node_name && object(node.integer(0)) == &node) ids.push_back(node.integer(0));
  }
  return ids;
}

const std::vector<FbxScene::Link>& FbxScene::sources(std::int64_t id) const {
  static const std::vector<Link> none;
  const auto found = sources_.find(id);
  return found == sources_.end() ? none : found->second;
}

const std::vector<FbxScene::Link>& FbxScene::targets(std::int64_t id) const {
  static const std::vector<Link> none;
  const auto found = targets_.find(id);
  return found == targets_.end() ? none : found->second;
}

std::string FbxScene::name(std::int64_t id) const {
  const FbxNode* node = object(id);
  const std::string text = node ? node->text(1) : "";
  const auto binary = text.find('\0');
  if (binary != std::string::npos) return text.substr(0, binary);
  const auto ascii = text.find("::");
  return ascii == std::string::npos ? text : text.substr(ascii + 2);
}

double FbxScene::frame_rate() const {
  const FbxNode* settings = root_.child("GlobalSettings");
  if (!settings) return 30;
  return rate_of_mode(choice(*settings, "TimeMode", 0), fbx_number(*settings, "CustomFrameRate").value_or(0));
}

bool fbx_has(const FbxNode& object, const std::string& name) {
  return property(object, name) != nullptr;
}

Vec3 fbx_vector(const FbxNode& object, const std::string& name, const Vec3& fallback) {
  const FbxNode* entry = property(object, name);
  return entry && entry->values.size() >= 7 ? Vec3(entry->number(4), entry->number(5), entry->number(6))
                                            : fallback;
}

std::optional<double> fbx_number(const FbxNode& object, const std::string& name) {
  const FbxNode* entry = property(object, name);
  if (!entry || entry->values.size() < 5) return std::nullopt;
  return entry->number(4);
}

FbxTransform::FbxTransform(const FbxNode& model)
    : translation(fbx_vector(model, "Lcl Translation", Vec3::Zero())),
      rotation_deg(fbx_vector(model, "Lcl Rotation", Vec3::Zero())),
      scale(fbx_vector(model, "Lcl Scaling", Vec3::Ones())),
      rotation_offset(fbx_vector(model, "RotationOffset", Vec3::Zero())),
      rotation_pivot(fbx_vector(model, "RotationPivot", Vec3::Zero())),
      scaling_offset(fbx_vector(model, "ScalingOffset", Vec3::Zero())),
      scaling_pivot(fbx_vector(model, "ScalingPivot", Vec3::Zero())),
      before(euler(fbx_vector(model, "PreRotation", Vec3::Zero()), 0)),
      after(euler(fbx_vector(model, "PostRotation", Vec3::Zero()), 0).conjugate()),
      order(static_cast<int>(std::clamp<std::int64_t>(choice(model, "RotationOrder", 0), 0, 5))) {}

bool FbxTransform::has_pivots() const {
  return !rotation_offset.isZero(0) || !rotation_pivot.isZero(0) || !scaling_offset.isZero(0) ||
         !scaling_pivot.isZero(0);
}

double FbxTransform::reach() const {
  return std::max({translation.norm(), rotation_offset.norm(), rotation_pivot.norm(), scaling_offset.norm(),
                   scaling_pivot.norm()});
}

Transform FbxTransform::local(const Vec3& t, const Vec3& degrees_xyz, const Vec3& s) const {
  Transform result;
  result.rotation = before * euler(degrees_xyz, order) * after;
  result.scale = s;
  const Vec3 inner = scaling_offset + scaling_pivot - rotation_pivot - s.cwiseProduct(scaling_pivot);
  result.translation = t + rotation_offset + rotation_pivot + result.rotation * inner;
  return result;
}

void check_fbx(const FbxScene& scene) {
  TreeCheck(scene).run();
  std::map<std::int64_t, std::size_t> counts;
  for (const std::int64_t id : scene.all("Geometry"))
    if (const FbxNode& geometry = *scene.object(id); geometry.child("PolygonVertexIndex"))
      counts[id] = check_geometry(geometry);
  for (const std::int64_t id : scene.all("Deformer")) check_cluster(scene, id, counts);
}

}  // namespace skinforge

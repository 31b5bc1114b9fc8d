#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "io/gltf_rule_context.h"

namespace skinforge {

namespace {
constexpr double kWeightSum = 2e-7;  // for each weight above 0; source: the Khronos validator

class PrimitiveRules {
 public:
  PrimitiveRules(const JsonPlace& primitive, std::size_t joint_count, GltfRules& rules)
      : rules_(rules),
        primitive_(primitive),
        attributes_(primitive.get("attributes")),
        joint_count_(joint_count) {}

  void check() {
    if (const auto position = accessor_of("POSITION")) check_positions(*position);
    if (has_format("NORMAL", "VEC3")) check_unit(*accessor_of("NORMAL"));
    if (has_format("TANGENT", "VEC4")) check_unit(*accessor_of("TANGENT"));
    check_indices();
    for (std::size_t set = 0; attributes_.has("JOINTS_" + std::to_string(set)); ++set) ++sets_;
    std::size_t weight_sets = 0;
    while (attributes_.has("WEIGHTS_" + std::to_string(weight_sets))) ++weight_sets;
    if (weight_sets != sets_)
      rules_.error("MESH_PRIMITIVE_JOINTS_WEIGHTS_MISMATCH", attributes_.place(),
                   fmt::format("{} sets of joints and {} of weights", sets_, weight_sets));
    else if (sets_ > 0)
      check_weights();
  }

 private:
  std::optional<std::size_t> accessor_of(const std::string& name) const {
    const auto reference = attributes_.find(name);
    if (!reference) return std::nullopt;
    return reference->index(rules_.document.accessors.size(), "accessor");
  }

  // Whether the attribute is there and of that type; told where it is of another.
  bool has_format(const std::string& name, const char* type) {
    const auto accessor = accessor_of(name);
    if (!accessor) return false;
    const std::string& found = rules_.document.accessors[*accessor].type;
    if (found == type) return true;
    rules_.error("MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT", attributes_.get(name).place(),
                 fmt::format("{} instead of {}", found, type));
    return false;
  }

  void check_positions(std::size_t accessor) {
    count_ = rules_.document.accessors[accessor].count;
    const auto place = rules_.document.root.get("accessors").at(accessor);
    if (!place.has("min") || !place.has("max"))
      rules_.error("MESH_PRIMITIVE_POSITION_ACCESSOR_WITHOUT_BOUNDS", place.place(),
                   "positions need their smallest and largest values (min, max)");
    for (const std::string& name : attributes_.keys())
      if (rules_.document.accessors[*accessor_of(name)].count != count_)
        rules_.error("MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT", attributes_.get(name).place(),
                     "not as many values as there are positions");
  }

  void check_unit(std::size_t accessor) {
    const GltfValues& values = rules_.values(accessor);
    std::size_t bad = 0;
    for (std::size_t i = 0; i < values.count; ++i) {
      const double* v = values[i];
      const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
      if (std::isfinite(length) && std::abs(length - 1) > kUnitVector) ++bad;
    }
    if (bad > 0)
      rules_.error("ACCESSOR_VECTOR3_NON_UNIT", rules_.accessor_pointer(accessor),
                   fmt::format("{} of {} vectors are not of unit length", bad, values.count));
  }

  void check_indices() {
    const auto reference = primitive_.find("indices");
    if (!reference) return;
    const std::size_t accessor = reference->index(rules_.document.accessors.size(), "accessor");
    const GltfValues& values = rules_.values(accessor);
    const auto outside = std::count_if(values.numbers.begin(), values.numbers.end(),
                                       [&](double index) { return index >= static_cast<double>(count_); });
    if (outside > 0)
      rules_.error("ACCESSOR_INDEX_OOB", rules_.accessor_pointer(accessor),
                   fmt::format("{} indices name no vertex (there are {})", outside, count_));
  }

  void check_weights() {
    for (std::size_t set = 0; set < sets_; ++set) {
      const std::string joints = "JOINTS_" + std::to_string(set), weights = "WEIGHTS_" + std::to_string(set);
      if (!has_format(joints, "VEC4") || !has_format(weights, "VEC4")) return;
      joints_.push_back(&rules_.values(*accessor_of(joints)));
      weights_.push_back(&rules_.values(*accessor_of(weights)));
      if (joints_.back()->count < count_ || weights_.back()->count < count_)
        return;  // told as unequal counts
    }
    const GltfAccessor& accessor = rules_.document.accessors[*accessor_of("WEIGHTS_0")];
    if (accessor.component_type == gltf::kUnsignedByte) step_ = 0.5 / 255;
    if (accessor.component_type == gltf::kUnsignedShort) step_ = 0.5 / 65535;
    for (std::size_t v = 0; v < count_; ++v) check_vertex(v);
    const auto joints = rules_.accessor_pointer(*accessor_of("JOINTS_0"));
    const auto weights = rules_.accessor_pointer(*accessor_of("WEIGHTS_0"));
    tell("ACCESSOR_JOINTS_INDEX_OOB", joints, outside_, "joints that the skin does not have");
    tell("ACCESSOR_JOINTS_INDEX_DUPLICATE", joints, twice_, "a joint with several weights");
    tell("ACCESSOR_WEIGHTS_NEGATIVE", weights, negative_, "negative weights");
    tell("ACCESSOR_WEIGHTS_NON_NORMALIZED", weights, not_one_, "weights that do not sum to 1");
    if (unused_ > 0)
      rules_.warning("ACCESSOR_JOINTS_USED_ZERO_WEIGHT", joints,
                     fmt::format("{} of {} vertices name a joint with weight 0", unused_, count_));
  }

  void tell(const char* code, const std::string& pointer, std::size_t vertices, const char* what) {
    if (vertices > 0)
      rules_.error(code, pointer, fmt::format("{} of {} vertices have {}", vertices, count_, what));
  }

  void check_vertex(std::size_t v) {
    std::set<double> seen;
    double sum = 0;
    std::size_t used = 0;
    bool is_twice = false, is_outside = false, is_negative = false, is_unused = false;
    for (std::size_t set = 0; set < sets_; ++set)
      for (std::size_t k = 0; k < 4; ++k) {
        const double joint = (*joints_[set])[v][k], weight = (*weights_[set])[v][k];
        is_negative = is_negative || weight < 0;
        is_outside = is_outside || joint >= static_cast<double>(joint_count_);
        is_unused = is_unused || (weight == 0 && joint != 0);
        if (weight != 0) is_twice = !seen.insert(joint).second || is_twice;  // NaN counts
        if (!(weight > 0)) continue;
        sum += weight;
        ++used;
      }
    twice_ += is_twice;
    outside_ += is_outside && joint_count_ > 0;
    negative_ += is_negative;
    unused_ += is_unused;
    not_one_ += std::isfinite(sum) && std::abs(sum - 1) > tolerance(used);
  }

  // Integers are exact up to half a step of each weight.
  double tolerance(std::size_t used) const {
    return step_ > 0 ? step_ : kWeightSum * static_cast<double>(std::max<std::size_t>(used, 1));
  }

  GltfRules& rules_;
  JsonPlace primitive_, attributes_;
  std::size_t joint_count_, count_ = 0, sets_ = 0;
  std::vector<const GltfValues*> joints_, weights_;  // per set
  double step_ = 0;                                  // half a step of integer weights; 0: they are floats
  std::size_t twice_ = 0, outside_ = 0, negative_ = 0, unused_ = 0, not_one_ = 0;  // vertices
};

// Joints of the smallest skin that shows each mesh; 0 where none does.
std::vector<std::size_t> joint_counts(const GltfDocument& document, std::size_t meshes) {
  std::vector<std::size_t> counts(meshes, 0);
  const auto skins = document.root.objects("skins");
  for (const JsonPlace& node : document.root.objects("nodes")) {
    const auto mesh = node.find("mesh"), skin = node.find("skin");
    if (!mesh || !skin) continue;
    const std::size_t joints = skins[skin->index(skins.size(), "skin")].get("joints").size();
    std::size_t& count = counts[mesh->index(meshes, "mesh")];
    count = count == 0 ? joints : std::min(count, joints);
  }
  return counts;
}
}  // namespace

void check_meshes(GltfRules& rules) {
  const auto meshes = rules.document.root.objects("meshes");
  const auto joints = joint_counts(rules.document, meshes.size());
  for (std::size_t m = 0; m < meshes.size(); ++m)
    for (const JsonPlace& primitive : meshes[m].required_objects("primitives"))
      PrimitiveRules(primitive, joints[m], rules).check();
}

}  // namespace skinforge

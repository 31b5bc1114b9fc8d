#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace skinforge::testing {

/// A second, plain glTF reader and player for tests, which shares no code with the one under src/io: it
/// answers where each vertex of a file is at a time of an animation, by the formulas of glTF 2.0. Trusts its
/// input; knows GLB, data URIs and files beside the asset, all component types, morph targets, all three
/// interpolations; no sparse accessors. Weights of a vertex: those that are not positive numbers are left
/// out, the rest is scaled to sum 1; a vertex without any takes its skin's first joint. All answers: world
/// space, every vertex of every mesh node, in node order, primitive order, vertex order.
class GltfEvaluator {
 public:
  using Points = std::vector<Eigen::Vector3d>;

  explicit GltfEvaluator(const std::string& path) {
    const std::string file = read_file(path);
    if (file.compare(0, 4, "glTF") == 0) {
      std::uint32_t length = 0;
      std::memcpy(&length, file.data() + 12, 4);
      json_ = Json::parse(file.substr(20, length));
      if (file.size() > 20 + length + 8) buffers_.push_back(file.substr(20 + length + 8));
    } else {
      json_ = Json::parse(file);
    }
    const auto list = json_.value("buffers", Json::array());
    for (std::size_t i = buffers_.size(); i < list.size(); ++i)
      buffers_.push_back(load(list[i].at("uri"), path));
    parents_.assign(nodes().size(), -1);
    for (std::size_t n = 0; n < nodes().size(); ++n)
      for (const int child : nodes()[n].value("children", std::vector<int>()))
        parents_[child] = static_cast<int>(n);
  }

  const nlohmann::json& json() const { return json_; }
  int animation_count() const {
    return json_.contains("animations") ? static_cast<int>(json_["animations"].size()) : 0;
  }
  std::string animation_name(int animation) const { return json_["animations"][animation].value("name", ""); }

  /// Time of the last key of an animation, in seconds.
  double duration(int animation) const {
    double last = 0;
    for (const Json& sampler : json_["animations"][animation]["samplers"])
      last = std::max(last, numbers(sampler["input"]).back());
    return last;
  }

  /// The pose of the file's nodes.
  Points default_pose() const { return points(rest()); }

  /// The pose of an animation at a time; before the first and after the last key of a sampler that key holds.
  Points pose(int animation, double time) const { return points(states(animation, time)); }

  /// Local transforms (parent_from_node) of all nodes at a time of an animation.
  std::vector<Eigen::Affine3d> local_transforms(int animation, double time) const {
    std::vector<Eigen::Affine3d> all;
    for (const NodeState& state : states(animation, time)) all.push_back(local(state));
    return all;
  }

  /// Name of a node; "node<index>" where the file has none.
  std::string node_name(std::size_t node) const {
    const std::string name = nodes()[node].value("name", "");
    return name.empty() ? "node" + std::to_string(node) : name;
  }

  /// The values of a vertex attribute, one row a vertex, in the order of the points; empty rows where a
  /// primitive has no such attribute.
  std::vector<std::vector<double>> attribute(const std::string& name) const {
    std::vector<std::vector<double>> rows;
    for_each_primitive([&](const Json& node, const Json& primitive) {
      const std::size_t begin = rows.size(), count = vertex_count(primitive);
      rows.resize(begin + count);
      if (!primitive["attributes"].contains(name)) return;
      const std::vector<double>& values = numbers(primitive["attributes"][name]);
      const std::size_t width = values.size() / std::max<std::size_t>(count, 1);
      for (std::size_t v = 0; v < count; ++v)
        rows[begin + v].assign(values.data() + v * width, values.data() + (v + 1) * width);
      if (name.starts_with("JOINTS_") && node.contains("skin"))
        for (std::size_t v = begin; v < rows.size(); ++v)
          for (double& joint : rows[v])
            joint = json_["skins"][node["skin"].get<int>()]["joints"][static_cast<std::size_t>(joint)];
    });
    return rows;
  }

  struct Triangle {
    std::array<std::size_t, 3> vertices{};  ///< places in the list of points
    std::string material;                   ///< its name
  };

  std::vector<Triangle> triangles() const {
    std::vector<Triangle> all;
    std::size_t begin = 0;
    for_each_primitive([&](const Json&, const Json& primitive) {
      const std::size_t count = vertex_count(primitive);
      std::vector<double> corners(count);
      for (std::size_t i = 0; i < count; ++i) corners[i] = static_cast<double>(i);
      if (primitive.contains("indices")) corners = numbers(primitive["indices"]);
      const std::string material =
          primitive.contains("material")
              ? json_["materials"][primitive["material"].get<std::size_t>()].value("name", "")
              : "";
      for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
        all.push_back({.vertices = {}, .material = material});
        for (std::size_t k = 0; k < 3; ++k)
          all.back().vertices[k] = begin + static_cast<std::size_t>(corners[i + k]);
      }
      begin += count;
    });
    return all;
  }

  /// Keys of each rotation that an animation drives: the node, the times, and the value at each time.
  struct RotationKeys {
    std::size_t node = 0;
    std::string interpolation;
    std::vector<double> times;
    std::vector<Eigen::Quaterniond> values;
  };

  std::vector<RotationKeys> rotation_keys(int animation) const {
    std::vector<RotationKeys> all;
    const Json& a = json_["animations"][animation];
    for (const Json& channel : a["channels"]) {
      if (channel["target"]["path"] != "rotation" || !channel["target"].contains("node")) continue;
      const Json& sampler = a["samplers"][channel["sampler"].get<int>()];
      RotationKeys keys{.node = channel["target"]["node"],
                        .interpolation = sampler.value("interpolation", "LINEAR"),
                        .times = numbers(sampler["input"]),
                        .values = {}};
      for (const double time : keys.times)
        keys.values.push_back(Eigen::Quaterniond(sample(sampler, time, "rotation").data()).normalized());
      all.push_back(std::move(keys));
    }
    return all;
  }

  /// Skinned vertices as they are stored (mesh space, where the bind matrices apply), others in the default
  /// pose.
  Points bind_pose() const {
    Points all;
    const auto state = rest();
    const auto world = world_matrices(state);
    for (std::size_t n = 0; n < nodes().size(); ++n) {
      if (!nodes()[n].contains("mesh")) continue;
      for (const Json& primitive : json_["meshes"][nodes()[n]["mesh"].get<int>()]["primitives"])
        for (const Eigen::Vector3d& p : morphed(primitive, {}))
          all.push_back(nodes()[n].contains("skin") ? p : Eigen::Vector3d(world[n] * p));
    }
    return all;
  }

 private:
  using Json = nlohmann::json;

  struct NodeState {
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
    Eigen::Vector3d scale = Eigen::Vector3d::Ones();
    Eigen::Affine3d matrix = Eigen::Affine3d::Identity();
    bool has_matrix = false;
    std::vector<double> weights;
  };

  const Json& nodes() const { return json_["nodes"]; }

  std::vector<NodeState> states(int animation, double time) const {
    std::vector<NodeState> state = rest();
    const Json& a = json_["animations"][animation];
    for (const Json& channel : a["channels"]) {
      if (!channel["target"].contains("node")) continue;
      NodeState& node = state[channel["target"]["node"].get<std::size_t>()];
      const std::string path = channel["target"]["path"];
      const std::vector<double> value = sample(a["samplers"][channel["sampler"].get<int>()], time, path);
      if (path == "translation") node.translation = Eigen::Vector3d(value.data());
      if (path == "scale") node.scale = Eigen::Vector3d(value.data());
      if (path == "rotation") node.rotation = Eigen::Quaterniond(value.data()).normalized();
      if (path == "weights") node.weights = value;
      node.has_matrix = false;
    }
    return state;
  }

  template <class Visit>
  void for_each_primitive(const Visit& visit) const {
    for (const Json& node : nodes())
      if (node.contains("mesh"))
        for (const Json& primitive : json_["meshes"][node["mesh"].get<int>()]["primitives"])
          visit(node, primitive);
  }

  std::size_t vertex_count(const Json& primitive) const {
    return json_["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()]["count"];
  }

  static std::string read_file(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error("no file " + path.string());
    return {std::istreambuf_iterator<char>(file), {}};
  }

  static std::string load(const std::string& uri, const std::string& asset) {
    if (uri.compare(0, 5, "data:") != 0) return read_file(std::filesystem::path(asset).parent_path() / uri);
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned bits = 0;
    int held = 0;
    for (std::size_t i = uri.find(',') + 1; i < uri.size() && uri[i] != '='; ++i) {
      bits = bits * 64 + static_cast<unsigned>(digits.find(uri[i]));
      held += 6;
      if (held < 8) continue;
      held -= 8;
      bytes += static_cast<char>(bits >> held);
      bits &= (1u << held) - 1;
    }
    return bytes;
  }

  template <class T>
  static double number(const char* data, bool normalized) {
    T value;
    std::memcpy(&value, data, sizeof value);
    const auto number = static_cast<double>(value);
    return normalized ? std::max(number / static_cast<double>(std::numeric_limits<T>::max()), -1.0) : number;
  }

  static int width_of(const Json& accessor) {
    const std::string type = accessor["type"];
    return type == "SCALAR" ? 1 : type == "MAT4" ? 16 : type.back() - '0';
  }

  // Elements of an accessor, decoded once.
  const std::vector<double>& numbers(const Json& index) const {
    const auto [place, is_new] = decoded_.try_emplace(index.get<int>());
    if (is_new) place->second = decode(json_["accessors"][index.get<int>()]);
    return place->second;
  }

  std::vector<double> decode(const Json& a) const {
    if (a.contains("sparse")) throw std::runtime_error("sparse accessors are not for this evaluator");
    const int type = a["componentType"], width = width_of(a);
    const int size = type < 5122 ? 1 : type < 5124 ? 2 : 4;
    const bool normalized = a.value("normalized", false);
    std::vector<double> values(a["count"].get<std::size_t>() * static_cast<std::size_t>(width), 0.0);
    if (!a.contains("bufferView")) return values;
    const Json& view = json_["bufferViews"][a["bufferView"].get<int>()];
    const std::size_t stride = view.value("byteStride", static_cast<std::size_t>(size * width));
    const std::size_t begin =
        view.value("byteOffset", std::size_t{0}) + a.value("byteOffset", std::size_t{0});
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::size_t element = i / static_cast<std::size_t>(width),
                        part = i % static_cast<std::size_t>(width);
      const char* at = buffers_[view["buffer"].get<std::size_t>()].data() + begin + element * stride +
                       part * static_cast<std::size_t>(size);
      switch (type) {
        case 5120:
          values[i] = number<std::int8_t>(at, normalized);
          break;
        case 5121:
          values[i] = number<std::uint8_t>(at, normalized);
          break;
        case 5122:
          values[i] = number<std::int16_t>(at, normalized);
          break;
        case 5123:
          values[i] = number<std::uint16_t>(at, normalized);
          break;
        case 5125:
          values[i] = number<std::uint32_t>(at, normalized);
          break;
        default:
          values[i] = number<float>(at, false);
      }
    }
    return values;
  }

  std::vector<NodeState> rest() const {
    std::vector<NodeState> all;
    for (const Json& node : nodes()) {
      NodeState s;
      const auto t = node.value("translation", std::vector<double>{0, 0, 0});
      const auto r = node.value("rotation", std::vector<double>{0, 0, 0, 1});
      const auto c = node.value("scale", std::vector<double>{1, 1, 1});
      s.translation = Eigen::Vector3d(t.data());
      s.rotation = Eigen::Quaterniond(r.data()).normalized();
      s.scale = Eigen::Vector3d(c.data());
      if (node.contains("matrix")) {
        const auto m = node["matrix"].get<std::vector<double>>();
        s.matrix.matrix() = Eigen::Map<const Eigen::Matrix4d>(m.data());
        s.has_matrix = true;
      }
      if (node.contains("mesh"))
        s.weights = node.value(
            "weights", json_["meshes"][node["mesh"].get<int>()].value("weights", std::vector<double>()));
      all.push_back(s);
    }
    return all;
  }

  static Eigen::Quaterniond slerp(const Eigen::Quaterniond& a, Eigen::Quaterniond b, double t) {
    if (a.dot(b) < 0) b.coeffs() = -b.coeffs();
    const double angle = 2 * std::atan2((a.coeffs() - b.coeffs()).norm(), (a.coeffs() + b.coeffs()).norm());
    const double sine = std::sin(angle);
    Eigen::Quaterniond result;
    if (sine < 1e-6)  // the limit of the formula below, to 1e-12
      result.coeffs() = (1 - t) * a.coeffs() + t * b.coeffs();
    else
      result.coeffs() =
          a.coeffs() * (std::sin((1 - t) * angle) / sine) + b.coeffs() * (std::sin(t * angle) / sine);
    return result.normalized();
  }

  std::vector<double> sample(const Json& sampler, double time, const std::string& path) const {
    const std::vector<double>& times = numbers(sampler["input"]);
    const std::vector<double>& values = numbers(sampler["output"]);
    const std::string mode = sampler.value("interpolation", "LINEAR");
    const std::size_t per_key = mode == "CUBICSPLINE" ? 3 : 1, width = values.size() / times.size() / per_key;
    const auto at = [&](std::size_t key, std::size_t slot) {
      const double* begin = values.data() + (key * per_key + slot) * width;
      return Eigen::Map<const Eigen::VectorXd>(begin, static_cast<Eigen::Index>(width));
    };
    const std::size_t middle = per_key == 3 ? 1 : 0;
    Eigen::VectorXd result;
    std::size_t next = 0;
    while (next < times.size() && times[next] <= time) ++next;
    if (next == 0) {
      result = at(0, middle);
    } else if (next == times.size() || mode == "STEP") {
      result = at(next - 1, middle);
    } else {
      const double step = times[next] - times[next - 1], t = (time - times[next - 1]) / step;
      if (per_key == 3) {
        const double t2 = t * t, t3 = t2 * t;
        result = (2 * t3 - 3 * t2 + 1) * at(next - 1, 1) + step * (t3 - 2 * t2 + t) * at(next - 1, 2) +
                 (-2 * t3 + 3 * t2) * at(next, 1) + step * (t3 - t2) * at(next, 0);
      } else if (path == "rotation") {
        const Eigen::Quaterniond a(at(next - 1, 0).data()), b(at(next, 0).data());
        result = slerp(a.normalized(), b.normalized(), t).coeffs();
      } else {
        result = (1 - t) * at(next - 1, 0) + t * at(next, 0);
      }
    }
    return {result.data(), result.data() + result.size()};
  }

  std::vector<Eigen::Affine3d> world_matrices(const std::vector<NodeState>& state) const {
    std::vector<Eigen::Affine3d> world(state.size());
    for (std::size_t n = 0; n < state.size(); ++n) {
      world[n] = local(state[n]);
      for (int p = parents_[n]; p >= 0; p = parents_[static_cast<std::size_t>(p)])
        world[n] = local(state[static_cast<std::size_t>(p)]) * world[n];
    }
    return world;
  }

  static Eigen::Affine3d local(const NodeState& s) {
    if (s.has_matrix) return s.matrix;
    return Eigen::Translation3d(s.translation) * s.rotation * Eigen::Scaling(s.scale);
  }

  Points morphed(const Json& primitive, const std::vector<double>& weights) const {
    std::vector<double> p = numbers(primitive["attributes"]["POSITION"]);
    const Json targets = primitive.value("targets", Json::array());
    for (std::size_t t = 0; t < std::min(targets.size(), weights.size()); ++t) {
      if (!targets[t].contains("POSITION")) continue;
      const std::vector<double> offset = numbers(targets[t]["POSITION"]);
      for (std::size_t i = 0; i < p.size(); ++i) p[i] += weights[t] * offset[i];
    }
    Points points;
    for (std::size_t i = 0; i < p.size(); i += 3) points.emplace_back(p[i], p[i + 1], p[i + 2]);
    return points;
  }

  std::vector<Eigen::Affine3d> palette(const Json& skin, const std::vector<Eigen::Affine3d>& world) const {
    std::vector<Eigen::Affine3d> matrices;
    for (const int joint : skin["joints"]) matrices.push_back(world[static_cast<std::size_t>(joint)]);
    if (!skin.contains("inverseBindMatrices")) return matrices;
    const std::vector<double> inverse = numbers(skin["inverseBindMatrices"]);
    for (std::size_t j = 0; j < matrices.size(); ++j)
      matrices[j] = matrices[j] * Eigen::Affine3d(Eigen::Map<const Eigen::Matrix4d>(inverse.data() + 16 * j));
    return matrices;
  }

  Points skinned(const Json& primitive, const Points& rest,
                 const std::vector<Eigen::Affine3d>& palette) const {
    std::vector<std::vector<double>> joints, weights;
    const Json& attributes = primitive["attributes"];
    for (int s = 0; attributes.contains("JOINTS_" + std::to_string(s)); ++s) {
      joints.push_back(numbers(attributes["JOINTS_" + std::to_string(s)]));
      weights.push_back(numbers(attributes["WEIGHTS_" + std::to_string(s)]));
    }
    Points points;
    for (std::size_t v = 0; v < rest.size(); ++v) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      double total = 0;
      for (std::size_t s = 0; s < joints.size(); ++s)
        for (std::size_t k = 4 * v; k < 4 * v + 4; ++k)
          if (weights[s][k] > 0) {
            sum += weights[s][k] * (palette[static_cast<std::size_t>(joints[s][k])] * rest[v]);
            total += weights[s][k];
          }
      points.push_back(total > 0 ? Eigen::Vector3d(sum / total) : Eigen::Vector3d(palette[0] * rest[v]));
    }
    return points;
  }

  Points points(const std::vector<NodeState>& state) const {
    Points all;
    const auto world = world_matrices(state);
    for (std::size_t n = 0; n < nodes().size(); ++n) {
      const Json& node = nodes()[n];
      if (!node.contains("mesh")) continue;
      for (const Json& primitive : json_["meshes"][node["mesh"].get<int>()]["primitives"]) {
        const Points rest = morphed(primitive, state[n].weights);
        const bool is_skinned = node.contains("skin") && primitive["attributes"].contains("JOINTS_0");
        Points placed;
        if (is_skinned)
          placed = skinned(primitive, rest, palette(json_["skins"][node["skin"].get<int>()], world));
        for (std::size_t v = 0; v < rest.size(); ++v)
          all.push_back(is_skinned ? placed[v] : Eigen::Vector3d(world[n] * rest[v]));
      }
    }
    return all;
  }

  nlohmann::json json_;
  std::vector<std::string> buffers_;
  std::vector<int> parents_;
  mutable std::map<int, std::vector<double>> decoded_;  // by accessor
};

/// World positions of all vertices at a time of an animation (`GltfEvaluator`).
inline std::vector<Eigen::Vector3d> evaluate_gltf(const std::string& path, int animation_index, double time) {
  return GltfEvaluator(path).pose(animation_index, time);
}

/// World positions of all vertices in the pose of the file's nodes.
inline std::vector<Eigen::Vector3d> evaluate_gltf_default_pose(const std::string& path) {
  return GltfEvaluator(path).default_pose();
}

/// Positions of all vertices as bound (`GltfEvaluator::bind_pose`).
inline std::vector<Eigen::Vector3d> evaluate_gltf_bind_pose(const std::string& path) {
  return GltfEvaluator(path).bind_pose();
}

}  // namespace skinforge::testing

#include "stages/rig_handles.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/text.h"
#include "geometry/triangle_bvh.h"
#include "io/export.h"
#include "io/file_kind.h"
#include "io/image_codec.h"
#include "io/number_table.h"
#include "skinning/weight_rows.h"

namespace skinforge {
namespace {

[[noreturn]] void refuse(const std::string& sentence) {
  throw Error(ExitCode::BadInput, sentence);
}

JointId joint_named(const std::string& name, const Skeleton& skeleton) {
  const auto joint = skeleton.find(name);
  if (!joint) refuse(fmt::format("no joint \"{}\"{}", printable(name), nearest_hint(name, skeleton.names())));
  return *joint;
}

bool is_empty(const Handles& handles) {
  return std::none_of(handles.begin(), handles.end(), [](JointId joint) { return joint.is_valid(); });
}

/// Vertex lists by joint.
class HandleLists {
 public:
  explicit HandleLists(const Rigged& rigged)
      : rigged_(rigged), handles_(rigged.character.mesh.vertex_count()) {}

  Handles read(const InputFile& file) {
    const auto json = nlohmann::json::parse(file.bytes.begin(), file.bytes.end(), nullptr, false, true);
    if (!json.is_object()) refuse("expected an object {\"joint\": [vertices]}");
    for (const auto& [name, vertices] : json.items()) {
      const JointId joint = joint_named(name, rigged_.character.skeleton);
      if (!vertices.is_array()) refuse(fmt::format("\"{}\": expected a list", printable(name)));
      for (const auto& vertex : vertices) hold(vertex, joint);
    }
    return std::move(handles_);
  }

 private:
  void hold(const nlohmann::json& vertex, JointId joint) {
    const Skeleton& skeleton = rigged_.character.skeleton;
    const std::size_t count = rigged_.vertex_of_file.size();
    if (!vertex.is_number_unsigned() || vertex.get<std::size_t>() >= count)
      refuse(fmt::format("\"{}\": vertices are numbers from 0 to {}", printable(skeleton[joint].name),
                         count - 1));
    const auto v = vertex.get<std::size_t>();
    JointId& held = handles_[rigged_.vertex_of_file[v].index()];
    if (held.is_valid() && held != joint)
      refuse(fmt::format("vertex {} is held by \"{}\" and by \"{}\"", v, printable(skeleton[held].name),
                         printable(skeleton[joint].name)));
    held = joint;
  }

  const Rigged& rigged_;
  Handles handles_;
};

Handles labels_of_table(const Eigen::MatrixXd& table, const Rigged& rigged) {
  const Handles of_file = handles_of_labels(table, rigged.vertex_of_file.size(), rigged.joint_of_bone);
  Handles handles(rigged.character.mesh.vertex_count());
  for (std::size_t i = 0; i < of_file.size(); ++i)
    if (of_file[i].is_valid()) handles[rigged.vertex_of_file[i].index()] = of_file[i];
  return handles;
}

// The donor's rows at the points of its surface nearest to `points`.
SkinWeights nearest_rows(const Character& donor, std::span<const Vec3> points) {
  const std::vector<VertexTriangle> triangles = triangulate(donor.mesh).triangles;
  std::vector<std::array<std::int32_t, 3>> soup;
  for (const VertexTriangle& t : triangles) soup.push_back({t[0].value, t[1].value, t[2].value});
  const TriangleBvh bvh(donor.mesh.positions, soup);
  SkinWeights rows;
  for (const Vec3& p : points) {
    const ClosestPoint at = bvh.closest(p);
    if (at.triangle < 0)
      rows.push_row({});
    else
      rows.push_row(
          interpolate_row(donor.weights, triangles[static_cast<std::size_t>(at.triangle)], at.barycentric));
  }
  return rows;
}

// The joint of `skeleton` of each joint of `donor`; invalid where there is none of that name.
std::vector<JointId> joints_by_name(const Skeleton& donor, const Skeleton& skeleton) {
  std::vector<JointId> image;
  for (const Joint& joint : donor.joints) image.push_back(skeleton.find(joint.name).value_or(JointId()));
  return image;
}

}  // namespace

Handles read_handles(const InputFile& file, const Rigged& rigged) {
  const bool is_json = lower_extension(file.path) == ".json";
  const Eigen::MatrixXd table = is_json ? Eigen::MatrixXd() : read_dmat(file);
  return with_context(printable(file.path), [&] {
    return is_json ? HandleLists(rigged).read(file) : labels_of_table(table, rigged);
  });
}

Handles read_painted_handles(const InputFile& file, const std::map<std::string, Color8>& colors,
                             const Rigged& rigged) {
  return with_context(printable(file.path), [&] {
    std::vector<LabelColor> labels;
    for (const auto& [name, color] : colors)
      labels.push_back({color, joint_named(name, rigged.character.skeleton)});
    const std::string mime = inspect_image(file.bytes).mime;
    const Raster image = decode_image({.name = file.path, .mime = mime, .bytes = file.bytes});
    Handles handles = handles_of_image(rigged.character.mesh, labels, image);
    if (is_empty(handles))
      refuse(
          "no vertex of the model looks up a pixel of a label's colour; labels must be painted over the "
          "first UV set "
          "in colours that are exact to 8 of 255");
    return handles;
  });
}

Handles handles_of_skin(const Character& donor, double threshold, const Character& character) {
  const Skeleton& skeleton = character.skeleton;
  const std::vector<JointId> image = joints_by_name(donor.skeleton, skeleton);
  if (std::none_of(image.begin(), image.end(), [](JointId joint) { return joint.is_valid(); }))
    refuse(
        fmt::format("no joint of the skin is called as one of the skeleton; the first are \"{}\" and \"{}\"",
                    printable(donor.skeleton.joints[0].name), printable(skeleton.joints[0].name)));
  const bool is_same = donor.mesh.positions == character.mesh.positions;
  Handles handles =
      handles_of_weights(is_same ? donor.weights : nearest_rows(donor, character.mesh.positions), threshold);
  for (JointId& joint : handles)
    if (joint.is_valid()) joint = image[joint.index()];
  if (is_empty(handles))
    refuse(fmt::format("no vertex has a joint with more than {} of its weight", threshold));
  return handles;
}

std::string handles_json(const Rigged& rigged) {
  std::vector<std::vector<std::size_t>> vertices(rigged.character.skeleton.size());
  for (std::size_t i = 0; i < rigged.vertex_of_file.size(); ++i)
    if (const JointId joint = rigged.handles[rigged.vertex_of_file[i].index()]; joint.is_valid())
      vertices[joint.index()].push_back(i);
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (std::size_t j = 0; j < vertices.size(); ++j)
    if (!vertices[j].empty()) json[rigged.character.skeleton.joints[j].name] = vertices[j];
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace skinforge

#include "stages/inputs.h"

#include <fmt/format.h>

#include "base/text.h"

namespace skinforge {

std::vector<std::string> input_names(const Recipe& recipe) {
  std::vector<std::string> names;
  for (const RecipeInput& input : recipe.inputs) names.push_back(input.name);
  return names;
}

std::vector<std::string> character_names(const ArtifactNames& names, const std::vector<std::string>& inputs) {
  std::vector<std::string> all;
  for (const std::string& input : inputs) all.push_back(names.character(input));
  return all;
}

std::vector<std::string> contents_names(const ArtifactNames& names, const std::vector<std::string>& inputs) {
  std::vector<std::string> all;
  for (const std::string& input : inputs) all.push_back(names.contents(input));
  return all;
}

std::vector<const Character*> get_characters(const StageInput& in, const ArtifactNames& names,
                                             const std::vector<std::string>& inputs) {
  std::vector<const Character*> characters;
  for (const std::string& input : inputs) characters.push_back(&in.get<Character>(names.character(input)));
  return characters;
}

std::vector<const Skeleton*> skeletons_of(const std::vector<const Character*>& characters) {
  std::vector<const Skeleton*> skeletons;
  for (const Character* character : characters) skeletons.push_back(&character->skeleton);
  return skeletons;
}

JointId require_joint(const Skeleton& skeleton, const std::string& joint, const std::string& input) {
  if (const auto found = skeleton.find(joint)) return *found;
  throw Error(ExitCode::Usage, fmt::format("no joint \"{}\" in input \"{}\"{}", printable(joint), input,
                                           nearest_hint(joint, skeleton.names())));
}

Quat rotation_yxz(const std::array<double, 3>& degrees) {
  const Quat x(Eigen::AngleAxisd(radians(degrees[0]), Vec3::UnitX()));
  const Quat y(Eigen::AngleAxisd(radians(degrees[1]), Vec3::UnitY()));
  const Quat z(Eigen::AngleAxisd(radians(degrees[2]), Vec3::UnitZ()));
  return y * x * z;
}

std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace skinforge

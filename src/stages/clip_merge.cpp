#include "stages/clip_merge.h"

#include <fmt/format.h>

#include <algorithm>

namespace skinforge {

std::string free_clip_name(const Character& character, const std::string& wanted) {
  const auto is_taken = [&](const std::string& name) {
    return std::any_of(character.clips.begin(), character.clips.end(),
                       [&](const Clip& c) { return c.name == name; });
  };
  std::string name = wanted;
  for (int n = 2; is_taken(name); ++n) name = fmt::format("{}_{}", wanted, n);
  return name;
}

void merge_clips(Character& character, const Character& other, const std::string& place, IssueSink& issues) {
  std::size_t unmatched = 0;
  for (Clip clip : other.clips) {
    std::vector<JointTracks> matched;
    for (JointTracks& tracks : clip.joints) {
      const auto joint = character.skeleton.find(other.skeleton[tracks.joint].name);
      if (!joint) {
        ++unmatched;
        continue;
      }
      tracks.joint = *joint;
      matched.push_back(std::move(tracks));
    }
    std::sort(matched.begin(), matched.end(),
              [](const JointTracks& a, const JointTracks& b) { return a.joint < b.joint; });
    clip.joints = std::move(matched);
    clip.morphs.clear();
    clip.name = free_clip_name(character, clip.name);
    character.clips.push_back(std::move(clip));
  }
  if (unmatched > 0)
    issues.warn("clip-joints-unmatched", place,
                fmt::format("{} joint tracks drive joints that the character does not have", unmatched));
}

}  // namespace skinforge

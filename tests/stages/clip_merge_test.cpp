#include "stages/clip_merge.h"

#include <gmock/gmock.h>

#include "base/issue.h"
#include "io/import.h"
#include "testing/assets.h"

namespace skinforge {
namespace {
using ::testing::Contains;
using ::testing::ElementsAre;

Character chain(std::initializer_list<const char*> names) {
  Character c;
  for (const char* name : names) {
    Joint joint;
    joint.name = name;
    joint.parent = c.skeleton.joints.empty() ? JointId() : JointId(c.skeleton.size() - 1);
    c.skeleton.joints.push_back(joint);
  }
  return c;
}

Clip turning(const std::string& name, JointId joint) {
  JointTracks tracks;
  tracks.joint = joint;
  tracks.rotation = {
      Interpolation::Linear, {0, 1}, {Quat::Identity(), Quat(Eigen::AngleAxisd(1, Vec3::UnitX()))}};
  return {name, 1, {tracks}, {}};
}

// By hand: joints are found by name, not by number; what has no counterpart is counted; a name that is taken
// gets a number.
TEST(MergeClips, GoesByJointNames) {
  Character character = chain({"root", "spine", "head"});
  character.clips.push_back(turning("Walk", JointId(1)));
  Character other = chain({"base", "head", "spine"});
  other.clips = {turning("Walk", JointId(1)), turning("Nod", JointId(0))};
  IssueSink issues;
  merge_clips(character, other, "walk.fbx", issues);
  ASSERT_EQ(character.clips.size(), 3U);
  EXPECT_EQ(character.clips[1].name, "Walk_2");
  ASSERT_EQ(character.clips[1].joints.size(), 1U);
  EXPECT_EQ(character.clips[1].joints[0].joint, JointId(2));
  EXPECT_TRUE(character.clips[2].joints.empty());
  ASSERT_EQ(issues.issues().size(), 1U);
  EXPECT_EQ(issues.issues()[0].code, "clip-joints-unmatched");
}

// The same person as glTF and as FBX: the clips of either play on the other, joint by joint.
TEST(MergeClips, AcrossFormats) {
  IssueSink issues;
  for (const auto& [body, clips] :
       {std::pair{"data/human.glb", "data/human.fbx"}, {"data/human.fbx", "data/human.glb"}}) {
    Character character = import_character(testing::repository_file(body), issues);
    const Character other = import_character(testing::repository_file(clips), issues);
    const std::size_t own = character.clips.size();
    IssueSink merged;
    merge_clips(character, other, clips, merged);
    EXPECT_TRUE(merged.issues().empty()) << body;
    ASSERT_EQ(character.clips.size(), own + other.clips.size());
    for (std::size_t c = 0; c < other.clips.size(); ++c) {
      const Clip& added = character.clips[own + c];
      ASSERT_EQ(added.joints.size(), other.clips[c].joints.size());
      for (const JointTracks& tracks : added.joints) {
        const std::string& name = character.skeleton[tracks.joint].name;
        const auto same =
            std::find_if(other.clips[c].joints.begin(), other.clips[c].joints.end(),
                         [&](const JointTracks& t) { return other.skeleton[t.joint].name == name; });
        ASSERT_NE(same, other.clips[c].joints.end());
        EXPECT_EQ(tracks.rotation.times, same->rotation.times);
      }
    }
  }
}

}  // namespace
}  // namespace skinforge

#include "animation/behaviour.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>

namespace skinforge {
namespace {

// All ours; completion.md says how they were chosen.
constexpr float kPlain = 0.5F;     // of the keyframe distance itself
constexpr float kSpecific = 0.1F;  // of the distance of two motions that have nothing to do with each other
constexpr float kStill = 0.01F;    // keyframe distance: 16 degrees in every joint
constexpr float kActivityWeight = 0.1F;  // of the difference between resting and the liveliest clip
constexpr float kOtherName = 0.1F;
constexpr std::size_t kShortestWord = 3;

std::vector<std::string> words_of(std::string_view name) {
  if (const auto bar = name.rfind('|'); bar != std::string_view::npos) name.remove_prefix(bar + 1);
  std::vector<std::string> words(1);
  for (const char c : name) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalpha(letter))
      words.back() += static_cast<char>(std::tolower(letter));
    else if (!words.back().empty())
      words.emplace_back();
  }
  std::erase_if(words, [](const std::string& word) { return word.size() < kShortestWord; });
  return words;
}

// How much the clips of a set differ in liveliness: 0 when all that move are alike (or there is one), up
// to 1.
float spread_of_activity(const MotionSet& set) {
  float calmest = 1, liveliest = 0;
  for (std::size_t c = 0; c < set.is_moving.size(); ++c) {
    if (!set.is_moving[c]) continue;
    float sum = 0;
    for (std::int32_t f = set.clip_begin[c]; f < set.clip_begin[c + 1]; ++f)
      sum += set.activity[static_cast<std::size_t>(f)];
    const float mean = sum / static_cast<float>(set.clip_begin[c + 1] - set.clip_begin[c]);
    calmest = std::min(calmest, mean);
    liveliest = std::max(liveliest, mean);
  }
  return liveliest > 0 ? 1 - calmest / liveliest : 0.0F;
}

}  // namespace

bool share_a_word(std::string_view a, std::string_view b) {
  const auto other = words_of(b);
  for (const std::string& word : words_of(a))
    for (const std::string& second : other)
      if (word.starts_with(second) || second.starts_with(word)) return true;
  return false;
}

void add_behaviour(const MotionSet& driver, std::size_t first, const MotionSet& candidates,
                   const std::vector<bool>& same_name, DistanceTable& distances) {
  std::vector<float> name_cost(distances.candidates, 0.0F);
  const bool any = std::find(same_name.begin(), same_name.end(), true) != same_name.end();
  for (std::size_t c = 0; any && c < same_name.size(); ++c)
    if (!same_name[c])
      std::fill(name_cost.begin() + candidates.clip_begin[c],
                name_cost.begin() + candidates.clip_begin[c + 1], kOtherName);
  const float activity_weight = kActivityWeight * spread_of_activity(driver) * spread_of_activity(candidates);
  for (std::size_t f = 0; f < distances.frames; ++f) {
    const auto row = distances.row(f);
    const float activity = driver.activity[first + f];
    for (std::size_t c = 0; c < row.size(); ++c)
      row[c] = row[c] * (kPlain +
                         kSpecific / (distances.frame_stance[f] + distances.candidate_stance[c] + kStill)) +
               name_cost[c] + activity_weight * std::abs(activity - candidates.activity[c]);
  }
}

}  // namespace skinforge

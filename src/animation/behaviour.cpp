#include "animation/behaviour.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>

namespace skinforge {
namespace {

constexpr float kActivityWeight = 0.1F;  // ours: Idle against Gallop then counts as 50 degrees in every joint
constexpr float kOtherName = 0.05F;      // ours: as 36 degrees in every joint
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
  for (std::size_t f = 0; f < distances.frames; ++f) {
    const auto row = distances.row(f);
    const float activity = driver.activity[first + f];
    for (std::size_t c = 0; c < row.size(); ++c)
      row[c] += name_cost[c] + kActivityWeight * std::abs(activity - candidates.activity[c]);
  }
}

}  // namespace skinforge

#pragma once

#include <optional>
#include <string>
#include <vector>

namespace skinforge {

/// What `help TOPIC` says beside the help of the verbs; none for other words.
std::optional<std::string> help_topic(const std::string& topic);

std::vector<std::string> help_topic_names();

}  // namespace skinforge

#include "io/glb_provenance.h"

#include <nlohmann/json.hpp>
#include <string_view>

#include "io/glb_container.h"

namespace skinforge {

std::string provenance_text(std::span<const std::byte> glb) {
  using nlohmann::json;
  const auto chunk = parse_glb(glb).json;
  const std::string_view text(reinterpret_cast<const char*>(chunk.data()), chunk.size());
  if (text.find("\"skinforge\"") == text.npos) return "";  // the most, and parsing takes its time
  // Only this member is kept: most of the text is accessors.
  const auto is_wanted = [](int depth, json::parse_event_t event, const json& parsed) {
    return depth != 1 || event != json::parse_event_t::key || parsed == "asset";
  };
  const json document = json::parse(text.begin(), text.end(), is_wanted, false);
  const json::json_pointer place("/asset/extras/skinforge");
  if (!document.contains(place) || !document.at(place).is_object()) return "";
  return document.at(place).dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace skinforge

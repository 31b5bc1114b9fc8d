#include "html/html_page.h"

#include <map>
#include <nlohmann/json.hpp>

#include "base/base64.h"
#include "base/expect.h"
#include "html/page_sources.h"

namespace skinforge {

namespace {
std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += c;
    }
  return safe;
}

// JSON in a script element: "</script" and "<!--" cannot occur once every < is written as \u003c, which JSON
// allows in strings, the only place where it has one.
std::string json_block(const std::string& id, const std::string& json) {
  std::string block = "<script type=\"application/json\" id=\"" + id + "\">";
  for (const char c : json)
    if (c == '<')
      block += "\\u003c";
    else
      block += c;
  return block + "</script>\n";
}

std::string file_block(const std::string& id, const Bytes& bytes) {
  return "<script type=\"application/octet-stream\" id=\"" + id + "\">" + base64(bytes) + "</script>\n";
}

std::string pictures_json(const HtmlPage& page) {
  nlohmann::json list = nlohmann::json::array();
  for (const auto& [name, jpeg] : page.pictures)
    list.push_back({{"name", name}, {"source", "data:image/jpeg;base64," + base64(jpeg)}});
  return list.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string data_blocks(const HtmlPage& page) {
  std::string blocks = json_block("pictures", pictures_json(page));
  for (const auto& [id, json] : page.json) blocks += json_block(id, json);
  for (const auto& [id, bytes] : page.files) blocks += file_block(id, bytes);
  return blocks;
}

// The template with each "@NAME@" replaced; what is put in is not looked through again.
std::string filled(std::string_view text, const std::map<std::string, std::string, std::less<>>& values) {
  std::string result;
  while (true) {
    const auto begin = text.find('@');
    result += text.substr(0, begin);
    if (begin == std::string_view::npos) return result;
    const auto end = text.find('@', begin + 1);
    SF_EXPECT(end != std::string_view::npos);
    result += values.at(std::string(text.substr(begin + 1, end - begin - 1)));
    text = text.substr(end + 1);
  }
}
}  // namespace

std::string html_page(const HtmlPage& page) {
  return filled(kPageTemplate, {{"TITLE", escaped(page.title)},
                                {"KIND", escaped(page.kind)},
                                {"STYLE", std::string(kPageStyle)},
                                {"DATA", data_blocks(page)},
                                {"SCRIPT", std::string(kPageScript)}});
}

}  // namespace skinforge

#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/archive.h"

namespace skinforge {

/// What a page shows: data by the ids under which its scripts look for them (src/html/page).
struct HtmlPage {
  std::string kind;                                       ///< "build" or "diff": which sections there are
  std::string title;                                      ///< any text
  std::vector<std::pair<std::string, std::string>> json;  ///< id, JSON text
  std::vector<std::pair<std::string, Bytes>> files;       ///< id, bytes: "model", "viewer", ...
  std::vector<std::pair<std::string, Bytes>> pictures;    ///< name, JPEG
};

/// One file that needs nothing else: styles, scripts and data inside, and a content security policy under
/// which a browser fetches nothing. Whatever texts hold, nothing of it is taken as markup. Equal arguments
/// give equal bytes.
std::string html_page(const HtmlPage& page);

}  // namespace skinforge

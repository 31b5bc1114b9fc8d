#pragma once

#include <string_view>

/// The files of src/html/page as the build put them into the program (cmake/HtmlPage.cmake).
namespace skinforge {

extern const std::string_view kPageTemplate;
extern const std::string_view kPageStyle;
extern const std::string_view kPageScript;

}  // namespace skinforge

#pragma once

#include <string>

#include "cli/session.h"

namespace skinforge {

/// report.html of a build that ran well with full report: the character in three dimensions, its pictures and
/// everything of report.json, in one file that needs no network. Without the viewer beside the program
/// (`skinforge_viewer.js.gz`) it says so in the view's place and shows the strips of the clips instead.
std::string report_page(Session& session);

/// The viewer beside the program, compressed; empty where there is none.
Bytes viewer_module();

}  // namespace skinforge

#pragma once

#include <filesystem>
#include <string>

#include "cli/session.h"

namespace skinforge {

/// report.html of a build that ran well with full report: the character in three dimensions, its pictures and
/// everything of report.json, in one file that needs no network. Without the viewer beside the program
/// (`skinforge_viewer.js.gz`) it says so in the view's place and shows the strips of the clips instead.
std::string report_page(Session& session);

/// timings.json and, of a full report, report.html: what differs from run to run, in files of its own, so
/// that the others compare byte for byte. Written where `is_changed` or where there is none.
void write_run_files(Session& session, ReportLevel level, const std::filesystem::path& folder,
                     bool is_changed);

/// The viewer beside the program, compressed; empty where there is none.
Bytes viewer_module();

}  // namespace skinforge

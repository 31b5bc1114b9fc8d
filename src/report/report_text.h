#pragma once

#include <string>

#include "report/report.h"
#include "report/timings.h"

namespace skinforge {

/// The report as a page for people: plain text, UTF-8, at most 100 columns where names allow, ends with a
/// newline. Only what a person wants to know at once; report.json has the rest. Things that deserve a look
/// start with "!".
std::string to_text(const Report& report);

/// The stages by falling processor time, one line each.
std::string to_text(const Timings& timings);

}  // namespace skinforge

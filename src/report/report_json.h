#pragma once

#include <string>

#include "report/report.h"
#include "report/timings.h"

namespace skinforge {

/// The report as JSON text (UTF-8, ends with a newline): keys in the order of report_fields.h, numbers in the
/// shortest form that reads back to the same bits, short lists and objects on one line. Numbers that are not
/// finite become null. Equal reports give equal bytes. Throws Error (Internal) when a text is no UTF-8.
std::string to_json(const Report& report);

/// The timings in the same form.
std::string to_json(const Timings& timings);

/// JSON schema (draft-07) of `to_json(Report)`, made from the same table; the copy in
/// schemas/report.schema.json is tested to be equal. Each property says its meaning and unit.
std::string report_schema();

}  // namespace skinforge

#pragma once

#include "field/signed_distance.h"

/// OpenVDB stands in a shared module of its own, `libskinforge_vdb.so` beside the program: its library binds
/// 70,000 symbols when it is loaded (46 ms, more than a whole build that finds everything in the cache), so
/// it is loaded when somebody first asks for a `.vdb` file.
namespace skinforge {

namespace vdb {
/// What stands behind the function of the same name in field/signed_distance.h.
Bytes to_vdb(const DistanceField& field);
}  // namespace vdb

/// What the module gives.
struct VdbFunctions {
  Bytes (*to_vdb)(const DistanceField&);
};

/// The name of its one symbol, a `const VdbFunctions`.
inline constexpr const char* kVdbSymbol = "skinforge_vdb_functions";

}  // namespace skinforge

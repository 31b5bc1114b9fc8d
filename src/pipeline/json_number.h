#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>

#include "base/error.h"

namespace skinforge {

/// The whole number from 0 that stands there. The library would turn 1e300 into one, too, which C++ leaves
/// undefined. Throws Error (Internal): the record is damaged.
inline std::uint64_t whole_number(const nlohmann::json& value) {
  if (!value.is_number_unsigned()) throw Error(ExitCode::Internal, "not a whole number from 0");
  return value.get<std::uint64_t>();
}

}  // namespace skinforge

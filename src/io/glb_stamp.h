#pragma once

#include <string>

#include "base/archive.h"

namespace skinforge {

/// A GLB's own digest inside it: SHA-256 of all its bytes with the digest's 64 digits read as zeros. It
/// stands in the JSON chunk as "content_sha256":"...". No secret is in it: it tells accidents and edits, not
/// forgers.
constexpr const char* kStampKey = "content_sha256";

/// The value to write for it before `stamped` fills it in.
std::string unset_stamp();

/// The same bytes with the digest filled in. Throws Error (Internal) when there is no unset stamp.
Bytes stamped(Bytes glb);

enum class StampState {
  Absent,  ///< none, or it was taken out
  Wrong,   ///< something in the file is not as it was written
  Right
};
/// Throws Error (BadInput) when this is no GLB.
StampState check_stamp(const Bytes& glb);

}  // namespace skinforge

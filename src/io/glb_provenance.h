#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace skinforge {

/// What a GLB of ours says it was made of, `asset.extras.skinforge` as JSON text; empty where it says
/// nothing. Throws Error (BadInput) when this is no GLB.
std::string provenance_text(std::span<const std::byte> glb);

}  // namespace skinforge

#pragma once

#include <string_view>

namespace skinforge {

/// Refuses a COLLADA document whose nodes are their own ancestors, or become more nodes than a scene may have
/// once each `instance_node` is what it names; Assimp would follow them until its stack or its memory ends.
/// Looks at the text only, in time linear in it: what it does not understand is left to Assimp. Throws Error
/// (BadInput).
void check_dae_nodes(std::string_view document);

}  // namespace skinforge

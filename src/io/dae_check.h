#pragma once

#include "base/issue.h"
#include "io/import.h"

namespace skinforge {

/// Refuses a COLLADA file whose vertex weights name joints that their list does not have, which Assimp leaves
/// out silently, and whose nodes have no end (dae_nodes.h); warns of a document type, whose entities nobody
/// expands. Looks at the text only: what it does not understand is left to Assimp. Throws Error (BadInput).
void check_dae(const InputFile& file, std::vector<Issue>& issues);

}  // namespace skinforge

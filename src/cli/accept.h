#pragma once

#include <filesystem>
#include <string>

#include "base/archive.h"
#include "cli/console.h"
#include "cli/session.h"

namespace skinforge {

/// Puts `bytes` in the place of a reference model, with a note FILE.change.md beside it of what that changes
/// (`text`, as `diff` prints it). Where there is no reference yet it is made, without a note. `from` names
/// where the bytes come from, for the note. Throws Error (StageFailed) where nothing can be written.
void accept_model(const std::filesystem::path& reference, const std::string& from, const Bytes& bytes,
                  const std::string& text, Console& console);

/// Makes the character of the session and takes it as its recipe's golden, unless something but the golden
/// speaks against it: then nothing is written, and the build that follows says what. Throws Error (Usage) for
/// a recipe without a golden.
void accept_golden(Session& session, Console& console);

}  // namespace skinforge

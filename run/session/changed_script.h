// Applies the changes of a session to its script.
#pragma once

#include "run/script/script.h"
#include "run/session/change.h"
#include "run/session/session_log.h"

#include <filesystem>
#include <string>

namespace cascade {

/// Returns the script with another text. Drops each option, such as --set, whose parameter no
/// longer exists in the text.
Script with_text(const Script& old, const std::string& text);

/// Returns the script with another value of a parameter or setting. If the value is invalid, the
/// result has no program.
Script with_number(const Script& script, const SetNumber& number);

/// Returns the script at the end of a session, with `options` added. The session is not repeated,
/// so the result includes changes that would be refused if the session were repeated.
Script script_at_end(const SessionLog& log, const std::filesystem::path& folder,
                     const Overrides& options);

}  // namespace cascade

// Applies the changes of a session to its script.
#pragma once

#include "run/script/script.h"
#include "run/session/change.h"
#include "run/session/session_log.h"

#include <filesystem>
#include <string>

namespace cascade {

/// The script with another text. An option such as --set is dropped if its parameter no longer
/// exists in the text.
Script with_text(const Script& old, const std::string& text);

/// The script with another value of a parameter or setting. It has no program if the value is
/// invalid.
Script with_number(const Script& script, const SetNumber& number);

/// The script at the end of a session, with `options` added. The session is not repeated, so the
/// result includes changes that a repetition would refuse.
Script script_at_end(const SessionLog& log, const std::filesystem::path& folder,
                     const Overrides& options);

}  // namespace cascade

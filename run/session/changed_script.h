// Applies the changes of a session to its script.
#pragma once

#include "run/script/script.h"
#include "run/session/change.h"
#include "run/session/session_log.h"

#include <filesystem>
#include <string>

namespace cascade {

/// A script with another text. Drops settings from outside that have become meaningless: their
/// parameter may have gone with the old text.
Script with_text(const Script& old, const std::string& text);

/// A script with another value of a parameter or setting. It has no program if the value is wrong.
Script with_number(const Script& script, const SetNumber& number);

/// The script at the end of a session, with `options` in addition. It is not run, so changes that
/// playing would refuse go unnoticed.
Script script_at_end(const SessionLog& log, const std::filesystem::path& folder,
                     const Overrides& options);

}  // namespace cascade

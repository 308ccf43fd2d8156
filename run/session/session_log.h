// The log of a session: a script, and everything that was done to it while it ran. Played again, it
// grows the same pattern, bit for bit. spec/session.md defines its text.
#pragma once

#include "core/result.h"
#include "run/script/script.h"
#include "run/session/change.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

struct SessionLog {
    std::string name = "session";  ///< Of the script, for messages.
    std::string text;              ///< The script with which the session began,
    Overrides overrides;           ///< and its options.
    std::vector<std::shared_ptr<const LoggedChange>> changes;  ///< In the order of their places.
    RunPlace end;                                              ///< Where the session is.
};

/// The log as lines of text, which parse_session_log() reads.
std::string print_session_log(const SessionLog& log);

/// The most changes of a log that is read, so that a small file cannot fill the memory.
inline constexpr std::size_t most_logged_changes = 250'000;

/// Fails, naming the line, on a text that print_session_log() does not write.
Result<SessionLog> parse_session_log(std::string_view text);

/// Does a text begin like a log? Its first `longest_log_beginning` bytes are enough.
bool is_session_log(std::string_view text);
inline constexpr std::size_t longest_log_beginning = 64;

}  // namespace cascade

// The log of a session: a script, and everything that was done to it while it ran. Played again, it
// grows the same pattern, bit for bit. spec/session.md defines its text.
#pragma once

#include "core/result.h"
#include "run/script/script.h"
#include "run/session/change.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
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

/// Its parts, which are also those of a log that grows (open_log.h): the lines above the changes,
/// the changes from number `first` on, where `at` is the place of the line above, and a place.
std::string print_session_beginning(const SessionLog& log);
std::string print_logged_changes(const SessionLog& log, std::size_t first,
                                 std::optional<RunPlace>& at);
std::string print_place(std::string_view word, RunPlace place);

/// The most changes of a log, so that a small file cannot fill the memory.
inline constexpr std::size_t most_logged_changes = 250'000;
/// The most bytes of a log that is read.
inline constexpr std::uint64_t largest_session_log = std::uint64_t{512} << 20;

/// Fails, naming the line, on a text that neither print_session_log() nor OpenLog writes. A log
/// that is still open ends at its last place; lines that were cut off are left out.
Result<SessionLog> parse_session_log(std::string_view text);

/// Does a text begin like a log? Its first `longest_log_beginning` bytes are enough.
bool is_session_log(std::string_view text);
inline constexpr std::size_t longest_log_beginning = 64;

}  // namespace cascade

// The log of a session: its first script, and all changes made while it ran. Repeating these
// changes gives the same pattern, bit for bit. spec/session.md defines the text of a log.
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
    std::string name = "session";  ///< The name of the script, for messages.
    std::string text;              ///< The script at the beginning of the session.
    Overrides overrides;           ///< The overrides of the script.
    /// In the order of the moments at which they were made.
    std::vector<std::shared_ptr<const LoggedChange>> changes;
    /// The moment at which the session ends.
    RunPlace end;
};

/// Writes the log as a text that parse_session_log() reads.
std::string print_session_log(const SessionLog& log);

/// The following functions write parts of the text of print_session_log(): the lines before the
/// changes, the changes from number `first` on, and a line with a moment. open_log.h builds a
/// growing log from these parts. `at` is the last moment that was written, and the functions update
/// it.
std::string print_session_beginning(const SessionLog& log);
std::string print_logged_changes(const SessionLog& log, std::size_t first,
                                 std::optional<RunPlace>& at);
std::string print_place(std::string_view word, RunPlace place);

/// The largest number of changes in a log. With this limit, a small file cannot fill the memory.
inline constexpr std::size_t most_logged_changes = 250'000;
/// The largest log that is read, in bytes.
inline constexpr std::uint64_t largest_session_log = std::uint64_t{512} << 20;

/// Reads a text that print_session_log() or OpenLog has written. For any other text, fails with the
/// number of the wrong line. A log of OpenLog ends at the last moment that was written. An
/// incomplete last line is dropped.
Result<SessionLog> parse_session_log(std::string_view text);

/// Whether a text begins like a log. The first `longest_log_beginning` bytes of the text are enough
/// for this test.
bool is_session_log(std::string_view text);
inline constexpr std::size_t longest_log_beginning = 64;

}  // namespace cascade

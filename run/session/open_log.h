// Writes the log of a session that has not ended. Lines are only appended to its file, so that the
// file contains the session even if the program is killed.
#pragma once

#include "run/session/session_log.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

/// Stores which lines have been written so far. Lines of undone changes remain in the file, and a
/// later line says how many of the changes before it are valid.
class OpenLog {
public:
    struct Lines {
        /// Whether `text` is the whole log. If not, it is an addition to the lines written so far.
        bool replaces_all = false;
        std::string text;  ///< Empty if nothing has changed.
    };

    /// Returns the lines to write since the last call. `log` is the present log, and `now` is the
    /// present moment.
    Lines lines(const SessionLog& log, RunPlace now);
    /// Makes the next call of lines() return the whole log.
    void begin_again() { has_begun_ = false; }

private:
    bool has_begun_ = false;
    SessionLog written_;
    std::optional<RunPlace> at_;  ///< The last moment that was written.
};

}  // namespace cascade

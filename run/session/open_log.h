// The log of an ongoing session, as lines that are only appended, so that a file of them holds the
// session however the program ends.
#pragma once

#include "run/session/session_log.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

/// Knows the lines written so far. Undone changes stay in them: a line tells how many of the
/// changes above are kept.
class OpenLog {
public:
    struct Lines {
        bool replaces_all = false;  ///< The text is the whole log, not an addition.
        std::string text;           ///< Empty if nothing has happened.
    };

    /// The lines since the last call: the log is now `log`, and the run is at `now`.
    Lines lines(const SessionLog& log, RunPlace now);
    /// Makes the next lines() the whole log.
    void begin_again() { has_begun_ = false; }

private:
    bool has_begun_ = false;
    SessionLog written_;
    std::optional<RunPlace> at_;  ///< The last moment written.
};

}  // namespace cascade

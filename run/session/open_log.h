// The log of a session that goes on, as lines that are only ever added, so that a file of them
// holds the session however the program ends.
#pragma once

#include "run/session/session_log.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

/// Knows which lines were written. What is undone stays in them: a line says how many of the
/// changes above are kept.
class OpenLog {
public:
    struct Lines {
        bool replaces_all = false;  ///< They are the whole log, not an addition to it.
        std::string text;           ///< Empty if nothing has happened.
    };

    /// What has happened since the last call: the log is now `log`, and the run is at `now`.
    Lines lines(const SessionLog& log, RunPlace now);
    /// The next lines() are the whole log.
    void begin_again() { has_begun_ = false; }

private:
    bool has_begun_ = false;
    SessionLog written_;
    std::optional<RunPlace> at_;  ///< The place that was written last.
};

}  // namespace cascade

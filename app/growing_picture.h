// The picture at the prompt that grows while steps are taken.
#pragma once

#include "app/console.h"
#include "app/terminal_pictures.h"
#include "run/pictures/painter.h"
#include "run/session/live_run.h"

#include <chrono>
#include <cstdint>
#include <optional>

namespace cascade {

/// The picture of a run, drawn again and again in one place of a terminal with colours.
class GrowingPicture {
public:
    /// All must outlive it, and the script of the run must not change.
    GrowingPicture(Console& console, const TerminalPictures& pictures, LiveRun& run);

    /// Has enough time passed since it was drawn?
    bool is_due() const;
    /// Draws it where it was drawn before. The cursor must be at the start of the line below.
    void draw();
    /// Leaves the cursor where the picture began.
    void erase();

private:
    using Clock = std::chrono::steady_clock;

    Console& console_;
    const TerminalPictures& pictures_;
    LiveRun& run_;
    std::optional<Painter> painter_;
    std::int64_t lines_ = 0;  ///< Of the picture that is there now.
    Clock::time_point next_;
};

}  // namespace cascade

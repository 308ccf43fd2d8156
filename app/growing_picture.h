// Shows a picture that grows at the prompt while steps are taken.
#pragma once

#include "app/console.h"
#include "app/terminal_pictures.h"
#include "run/pictures/painter.h"
#include "run/session/live_run.h"

#include <chrono>
#include <cstdint>
#include <optional>

namespace cascade {

/// Draws the picture of a run repeatedly at the same place of a terminal with colours.
class GrowingPicture {
public:
    /// All arguments must outlive this object. The script of the run must not change while this
    /// object exists.
    GrowingPicture(Console& console, const TerminalPictures& pictures, LiveRun& run);

    /// Whether enough time has passed since the last drawing.
    bool is_due() const;
    /// Draws the picture where it was drawn before. The cursor must be at the start of the line
    /// below the picture.
    void draw();
    /// Erases the picture, and moves the cursor to where the picture began.
    void erase();

private:
    using Clock = std::chrono::steady_clock;

    Console& console_;
    const TerminalPictures& pictures_;
    LiveRun& run_;
    std::optional<Painter> painter_;
    std::int64_t lines_ = 0;  ///< The height of the picture on the screen, in lines of text.
    Clock::time_point next_;
};

}  // namespace cascade

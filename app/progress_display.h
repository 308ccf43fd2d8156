// Shows the progress of a run, either as a bar that is redrawn in a terminal, or as occasional
// lines in a pipe or log.
#pragma once

#include "core/run_control.h"
#include "core/with_commas.h"
#include "run/commands/sweep.h"

#include <chrono>
#include <functional>
#include <string>
#include <string_view>

namespace cascade {

/// Writes a duration, such as "0:07", "12:34" or "3:02:01".
std::string clock_time(double seconds);

/// Returns a line of at most `columns` columns, without a newline. It contains the stage, a bar,
/// the steps, the rate and the remaining time. If the line would be too long, the least important
/// parts are left out.
std::string progress_bar(const Progress& progress, int columns);

/// Returns the line with the bar of a sweep: "12 of 81 runs", the bar and the remaining time.
std::string progress_bar(const SweepProgress& progress, int columns);
/// Returns the line of a sweep without a bar: "12 of 81 runs, 0:41 left".
std::string progress_line(const SweepProgress& progress);

/// Returns the line of a run without a bar: "stage 2/2 'small': 3,000 of 7,000 steps, 12,340
/// steps/s, 0:05 left".
std::string progress_line(const Progress& progress);

class ProgressDisplay {
public:
    enum class Kind { none, lines, bar };
    using Time = std::chrono::steady_clock::time_point;
    struct Output {
        std::function<void(std::string_view)> write;
        std::function<int()> columns;
        std::function<Time()> now;
    };

    ProgressDisplay(Kind kind, Output output);

    void show(const Progress& progress);
    void show(const SweepProgress& progress);
    /// Erases the bar, so that other text can be written. The next call of show() draws it again.
    void clear();

private:
    void show_line(const Progress& progress);
    void show_doing_line(const Progress& progress);

    Kind kind_;
    Output output_;
    bool drawn_ = false;
    int stage_ = 0;           ///< The stage that was shown last.
    bool swept_ = false;      ///< Whether the progress of a sweep has been shown.
    bool has_begun_ = false;  ///< Whether an activity outside of stages has been shown.
    Time stage_begun_;
    std::int64_t first_step_ = 0;
    Time last_line_;
};

}  // namespace cascade

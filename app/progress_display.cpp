// Draws a line again with a carriage return and the control sequence "erase line". Facts that do
// not fit into the line are left out.
#include "app/progress_display.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace cascade {

namespace {

constexpr int widest_bar = 40;
constexpr int narrowest_bar = 8;
constexpr auto between_lines = std::chrono::seconds(10);

/// Blocks from empty to full, in eighths of a character.
constexpr std::array<std::string_view, 9> blocks = {" ", "▏", "▎", "▍", "▌", "▋", "▊", "▉", "█"};

std::string draw_bar(double share, int width) {
    const int eighths = static_cast<int>(std::clamp(share, 0.0, 1.0) * width * 8);
    std::string bar;
    for (int k = 0; k < width; ++k) {
        bar += blocks[static_cast<std::size_t>(std::clamp(eighths - 8 * k, 0, 8))];
    }
    return bar;
}

double share_of(const Progress& progress) {
    if (progress.duration > 0) return std::clamp(progress.t / progress.duration, 0.0, 1.0);
    if (progress.steps <= 0) return 1.0;
    return static_cast<double>(progress.step) / static_cast<double>(progress.steps);
}

/// Returns the width of a text in terminal columns. Each code point counts as one column.
int width_of(std::string_view text) {
    return static_cast<int>(std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
    }));
}

std::string rate_text(double steps_per_second) {
    if (!(steps_per_second > 0)) return "";
    if (steps_per_second < 10) return fmt::format("{:.1f} steps/s", steps_per_second);
    return with_commas(static_cast<std::int64_t>(steps_per_second)) + " steps/s";
}

std::string left_text(const Progress& progress) {
    if (progress.seconds_left < 0 || progress.stage_done) return "";
    return clock_time(progress.seconds_left) + " left";
}

std::string stage_text(const Progress& progress) {
    const std::string name = fmt::format("'{}'{}", progress.stage, progress.note);
    if (progress.stage_count == 1) return name;
    return fmt::format("{}/{} {}", progress.stage_number, progress.stage_count, name);
}

}  // namespace

std::string clock_time(double seconds) {
    // A duration of more than a thousand hours is shown as a thousand hours.
    const auto whole = static_cast<std::int64_t>(std::ceil(std::clamp(seconds, 0.0, 3.6e6)));
    const std::int64_t hours = whole / 3600, minutes = whole / 60 % 60;
    if (hours > 0) return fmt::format("{}:{:02}:{:02}", hours, minutes, whole % 60);
    return fmt::format("{}:{:02}", minutes, whole % 60);
}

namespace {

/// Joins `left`, a bar, and as many of `facts` as fit into `columns`.
std::string fitting_bar(const std::string& left, double share,
                        const std::vector<std::string>& facts, int columns) {
    // Text in the last column would move the cursor to the next line.
    const int room = columns - 1;
    for (std::size_t count = facts.size(); count > 0; --count) {
        std::string right;
        for (std::size_t k = 0; k < count; ++k) right += "  " + facts[k];
        const int bar = std::min(room - width_of(left) - width_of(right) - 2, widest_bar);
        if (bar >= narrowest_bar) {
            return fmt::format("{}▕{}▏{}", left, draw_bar(share, bar), right);
        }
    }
    const std::string percent = fmt::format("{:.0f} %", 100.0 * share);
    return width_of(percent) <= room ? percent : "";
}

}  // namespace

std::string progress_bar(const Progress& progress, int columns) {
    std::vector<std::string> facts = {
        progress.duration > 0
            ? fmt::format("t {:.5g}/{:.5g}", progress.t, progress.duration)
            : fmt::format("{}/{}", with_commas(progress.step), with_commas(progress.steps))};
    if (auto text = left_text(progress); !text.empty()) facts.push_back(text);
    if (auto text = rate_text(progress.steps_per_second); !text.empty()) facts.push_back(text);
    return fitting_bar("stage " + stage_text(progress) + " ", share_of(progress), facts, columns);
}

std::string progress_bar(const SweepProgress& progress, int columns) {
    std::vector<std::string> facts = {fmt::format("{}/{}", progress.runs_done, progress.runs)};
    if (progress.seconds_left >= 0) facts.push_back(clock_time(progress.seconds_left) + " left");
    return fitting_bar("runs ", progress.share, facts, columns);
}

std::string progress_line(const SweepProgress& progress) {
    std::string line = fmt::format("{} of {} runs", progress.runs_done, progress.runs);
    if (progress.seconds_left >= 0) line += ", " + clock_time(progress.seconds_left) + " left";
    return line;
}

std::string progress_line(const Progress& progress) {
    std::string line =
        progress.stage_done && progress.condition_met
            ? fmt::format("stage {}: {} at step {}", stage_text(progress), progress.when_met,
                          with_commas(progress.step))
        : progress.duration > 0
            ? fmt::format("stage {}: t = {:.6g} of {:.6g}, {} steps", stage_text(progress),
                          progress.t, progress.duration, with_commas(progress.step))
            : fmt::format("stage {}: {} of {} steps", stage_text(progress),
                          with_commas(progress.step), with_commas(progress.steps));
    for (const std::string& fact : {rate_text(progress.steps_per_second), left_text(progress)}) {
        if (!fact.empty()) line += ", " + fact;
    }
    return line;
}

ProgressDisplay::ProgressDisplay(Kind kind, Output output)
    : kind_(kind), output_(std::move(output)) {}

void ProgressDisplay::show(const Progress& progress) {
    if (kind_ == Kind::none) return;
    if (!progress.doing.empty()) {
        if (kind_ == Kind::lines) return show_doing_line(progress);
        if (width_of(progress.doing) + 2 >= output_.columns()) return;
        output_.write("\r\x1b[2K" + progress.doing + " …");
        drawn_ = true;
        return;
    }
    if (progress.stage_number != stage_) {
        stage_ = progress.stage_number;
        stage_begun_ = last_line_ = output_.now();
        first_step_ = progress.step;
    }
    if (kind_ == Kind::lines) {
        show_line(progress);
    } else if (progress.stage_done) {
        clear();
    } else {
        output_.write("\r\x1b[2K" + progress_bar(progress, output_.columns()));
        drawn_ = true;
    }
}

void ProgressDisplay::show(const SweepProgress& progress) {
    if (kind_ == Kind::none) return;
    const Time now = output_.now();
    if (!swept_) last_line_ = now;
    swept_ = true;
    if (kind_ == Kind::bar) {
        output_.write("\r\x1b[2K" + progress_bar(progress, output_.columns()));
        drawn_ = true;
    } else if (now - last_line_ >= between_lines) {
        last_line_ = now;
        output_.write(progress_line(progress) + "\n");
    }
}

void ProgressDisplay::clear() {
    if (!drawn_) return;
    output_.write("\r\x1b[2K");
    drawn_ = false;
}

/// Prints a line for an activity outside of stages. Does so only if it is known how much of the
/// activity remains.
void ProgressDisplay::show_doing_line(const Progress& progress) {
    if (progress.steps <= 0) return;
    const Time now = output_.now();
    if (!std::exchange(has_begun_, true)) last_line_ = now;
    if (now - last_line_ < between_lines) return;
    last_line_ = now;
    output_.write(progress.doing + "\n");
}

void ProgressDisplay::show_line(const Progress& progress) {
    const Time now = output_.now();
    if (progress.stage_done) {
        // The rate is averaged over the whole stage, because the rate of the last second varies
        // more.
        const double seconds = std::chrono::duration<double>(now - stage_begun_).count();
        Progress whole = progress;
        whole.steps_per_second =
            seconds > 0 ? static_cast<double>(progress.step - first_step_) / seconds : 0;
        output_.write(progress_line(whole) + "\n");
        stage_ = 0;
    } else if (now - last_line_ >= between_lines) {
        last_line_ = now;
        output_.write(progress_line(progress) + "\n");
    }
}

}  // namespace cascade

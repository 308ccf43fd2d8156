// Progress: the text of a bar and of a line, and how often they are written.
#include "app/progress_display.h"

#include <gmock/gmock.h>

#include <regex>

namespace cascade {
namespace {

using testing::HasSubstr;
using testing::Not;
using Time = ProgressDisplay::Time;

Progress half_way() {
    Progress progress;
    progress.stage = "small";
    progress.stage_number = 2;
    progress.stage_count = 3;
    progress.step = 3500;
    progress.steps = 7000;
    progress.steps_per_second = 12345.6;
    progress.seconds_left = 64.2;
    return progress;
}

/// The number of columns of a text of letters, digits and block elements.
int columns_of(const std::string& text) {
    int count = 0;
    for (const char c : text) count += (static_cast<unsigned char>(c) & 0xc0) != 0x80 ? 1 : 0;
    return count;
}

TEST(Progress, numbers_are_readable) {
    EXPECT_EQ(with_commas(0), "0");
    EXPECT_EQ(with_commas(999), "999");
    EXPECT_EQ(with_commas(1000), "1,000");
    EXPECT_EQ(with_commas(-1234567), "-1,234,567");
    EXPECT_EQ(clock_time(0), "0:00");
    EXPECT_EQ(clock_time(59.2), "1:00");
    EXPECT_EQ(clock_time(3725), "1:02:05");
    EXPECT_EQ(clock_time(1e30), "1000:00:00");
}

TEST(Progress, a_line_has_all_facts) {
    EXPECT_EQ(progress_line(half_way()),
              "stage 2/3 'small': 3,500 of 7,000 steps, 12,345 steps/s, 1:05 left");
}

TEST(Progress, a_bar_is_filled_by_the_share_of_steps) {
    const std::string bar = progress_bar(half_way(), 120);
    EXPECT_THAT(bar, HasSubstr("stage 2/3 'small' ▕"));
    EXPECT_THAT(bar, HasSubstr("3,500/7,000  1:05 left  12,345 steps/s"));
    std::string twenty_full;
    for (int k = 0; k < 20; ++k) twenty_full += "█";
    EXPECT_THAT(bar, HasSubstr("▕" + twenty_full + std::string(20, ' ') + "▏"));
}

TEST(Progress, a_bar_fits_into_any_terminal) {
    for (int columns = 1; columns < 150; ++columns) {
        EXPECT_LT(columns_of(progress_bar(half_way(), columns)), std::max(columns, 2)) << columns;
    }
    EXPECT_THAT(progress_bar(half_way(), 60), Not(HasSubstr("steps/s")));
    EXPECT_EQ(progress_bar(half_way(), 20), "50 %");
}

TEST(Progress, nothing_is_made_up_before_it_is_known) {
    Progress progress = half_way();
    progress.steps_per_second = 0;
    progress.seconds_left = -1;
    EXPECT_EQ(progress_line(progress), "stage 2/3 'small': 3,500 of 7,000 steps");
}

/// A display with a clock and a stream of the test.
struct Watched {
    Time now{};
    std::string written;
    ProgressDisplay display;

    explicit Watched(ProgressDisplay::Kind kind)
        : display(kind, {[this](std::string_view text) { written += text; }, [] { return 80; },
                         [this] { return now; }}) {}
};

TEST(Progress, lines_are_sparse) {
    Watched watched(ProgressDisplay::Kind::lines);
    Progress progress = half_way();
    progress.step = 0;
    for (int second = 0; second <= 25; ++second) {
        watched.now = Time(std::chrono::seconds(second));
        progress.step = second * 100;
        watched.display.show(progress);
    }
    EXPECT_EQ(std::count(watched.written.begin(), watched.written.end(), '\n'), 2);
    progress.stage_done = true;
    progress.step = progress.steps;
    watched.display.show(progress);
    EXPECT_THAT(watched.written, HasSubstr("7,000 of 7,000 steps, 280 steps/s\n"));
    EXPECT_THAT(watched.written, Not(HasSubstr("\r")));
}

TEST(Progress, lines_tell_of_what_has_a_known_end) {
    Watched watched(ProgressDisplay::Kind::lines);
    Progress progress;
    progress.doing = "spreading cells";
    for (int k = 0; k < 30; ++k) {
        watched.now += std::chrono::seconds(1);
        watched.display.show(progress);
    }
    EXPECT_EQ(watched.written, "");
    progress.doing = "playing the session";
    progress.steps = 200;
    for (int k = 0; k < 15; ++k) {
        watched.now += std::chrono::seconds(1);
        watched.display.show(progress);
    }
    EXPECT_EQ(watched.written, "playing the session\n");
}

TEST(Progress, a_stage_that_its_condition_ended_says_so) {
    Progress progress = half_way();
    progress.when_met = "settled";
    progress.condition_met = true;
    progress.stage_done = true;
    EXPECT_EQ(progress_line(progress), "stage 2/3 'small': settled at step 3,500, 12,345 steps/s");
}

TEST(Progress, the_bar_is_taken_away) {
    Watched watched(ProgressDisplay::Kind::bar);
    watched.display.clear();
    EXPECT_EQ(watched.written, "");
    watched.display.show(half_way());
    EXPECT_THAT(watched.written, Not(HasSubstr("\n")));
    Progress done = half_way();
    done.stage_done = true;
    watched.display.show(done);
    EXPECT_TRUE(watched.written.ends_with("\r\x1b[2K"));
}

TEST(Progress, a_sweep_counts_runs) {
    SweepProgress sweep;
    sweep.runs_done = 12;
    sweep.runs = 81;
    sweep.share = 0.5;
    EXPECT_EQ(progress_line(sweep), "12 of 81 runs");
    sweep.seconds_left = 41;
    EXPECT_EQ(progress_line(sweep), "12 of 81 runs, 0:41 left");
    EXPECT_THAT(progress_bar(sweep, 80), HasSubstr("▏  12/81  0:41 left"));
    EXPECT_EQ(progress_bar(sweep, 12), "50 %");
    Watched lines(ProgressDisplay::Kind::lines);
    lines.display.show(sweep);
    EXPECT_EQ(lines.written, "");
    lines.now += std::chrono::seconds(11);
    lines.display.show(sweep);
    lines.display.show(sweep);
    EXPECT_EQ(lines.written, "12 of 81 runs, 0:41 left\n");
    Watched bar(ProgressDisplay::Kind::bar);
    bar.display.show(sweep);
    EXPECT_THAT(bar.written, HasSubstr("runs ▕"));
}

TEST(Progress, quiet_is_quiet) {
    Watched watched(ProgressDisplay::Kind::none);
    watched.display.show(half_way());
    watched.display.clear();
    EXPECT_EQ(watched.written, "");
}

TEST(Progress, OfAStageThatEndsByItsDuration) {
    Progress progress;
    progress.stage = "spots";
    progress.step = 1340;
    progress.steps = 1'000'000'000;
    progress.t = 12000;
    progress.duration = 28000;
    EXPECT_EQ(progress_line(progress), "stage 'spots': t = 12000 of 28000, 1,340 steps");
    EXPECT_THAT(progress_bar(progress, 80), HasSubstr("t 12000/28000"));
}

}  // namespace
}  // namespace cascade

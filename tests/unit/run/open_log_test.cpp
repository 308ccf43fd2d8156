// A log that grows line by line is a complete log of its session at every moment, even if its last
// line is cut off.
#include "run/session/open_log.h"

#include "live_run_fixture.h"

#include "support/kernel_comparison.h"
#include "support/new_seed.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

namespace cascade::test {
namespace {

using ::testing::HasSubstr;

constexpr const char* two_stages =
    "domain { grid: 8, 6 }\n"
    "system s { u: x; k: 1 + y; u' = 0.1 * lap(u) - 0.1 * k * u }\n"
    "stage one: s { iterations: 60 }\n"
    "stage two: s { iterations: 60; u: one.u }\n";

class OpenLogTest : public LiveRunFixture {
protected:
    std::string difference_of_values(const StageState& one, const StageState& other,
                                     bool) const override {
        return same_bits(one.species(), other.species());
    }
    /// Adds to text_ the lines of the log for everything that the run does from now on.
    void keep_log_of(LiveRun& run) {
        run.tell([this](const SessionLog& log, RunPlace now, bool) {
            const OpenLog::Lines lines = log_.lines(log, now);
            if (lines.replaces_all) text_.clear();
            text_ += lines.text;
        });
    }
    std::string read(const std::string& text) const {
        const auto log = parse_session_log(text);
        return log ? print_session_log(*log) : log.error().message;
    }

    OpenLog log_;
    std::string text_;
};

TEST_F(OpenLogTest, WhateverIsDoneItIsTheLog) {
    const std::vector<Change> changes = {
        SetNumber{"one.k", "1.1"},
        SetNumber{"one.k", "2"},
        Paint{"u", "u + disc(0.5, 0.5, 0.4)"},
        Paint{"k", "mix(k, 0.7, x)"},
        NextStage{},
        NextStage{},
        SetText{two_stages},
        SetText{with(two_stages, "0.1 * k", "0.2*k")},
        SetText{with(two_stages, "8, 6", "6, 8")},
    };
    for (int turn = 0; turn < 20; ++turn) {
        RandomStream random(new_seed() + static_cast<std::uint64_t>(turn));
        const auto run = begun(two_stages);
        ASSERT_TRUE(run);
        log_ = {};
        keep_log_of(*run);
        for (int k = 0; k < 8; ++k) {
            change_at_random(*run, changes, 2, 10, random);
            advance(*run, random.below(3));
            if (random.chance(10)) log_.begin_again();
            ASSERT_EQ(read(text_), print_session_log(run->log())) << text_;
        }
    }
}

TEST_F(OpenLogTest, OnlyWhatIsNewIsWritten) {
    const auto run = begun(two_stages);
    keep_log_of(*run);
    apply(*run, Paint{"u", "1"});
    text_.clear();
    advance(*run, 5);
    apply(*run, Paint{"u", "2"});
    ASSERT_TRUE(run->undo(control_));
    apply(*run, Paint{"u", "3"});
    EXPECT_EQ(text_, "at 1 5\npaint u=2\nkeep 1\npaint u=3\n");
}

TEST_F(OpenLogTest, ALineThatIsCutOffIsLeftOut) {
    const auto run = begun(two_stages);
    keep_log_of(*run);
    advance(*run, 3);
    const std::string before = text_;
    apply(*run, SetText{with(two_stages, "0.1 * k", "0.2*k")});
    advance(*run, 4);
    apply(*run, Paint{"u", "u + 1"});
    const std::string whole = text_;
    std::size_t last = 0;
    for (std::size_t end = before.size(); end <= whole.size(); ++end) {
        const auto log = parse_session_log(whole.substr(0, end));
        ASSERT_TRUE(log) << log.error().message << "\n" << whole.substr(0, end);
        EXPECT_GE(log->changes.size(), last);
        last = log->changes.size();
        if (last > 0) {
            EXPECT_EQ(*log->changes[0], *run->log().changes[0]);
        }
    }
    EXPECT_EQ(last, 2u);
    const auto again = played(*parse_session_log(whole));
    ASSERT_TRUE(again);
    EXPECT_EQ(difference(*run, *again), "");
}

TEST_F(OpenLogTest, WhatIsNoLogIsRefused) {
    const std::string open = "cascade session 1\nname n\noptions {}\nscript 1\nx\nopen\n";
    EXPECT_THAT(read(open + "keep 1\n"), HasSubstr("line 7"));
    EXPECT_THAT(read(open + "dance\n"), HasSubstr("line 7"));
    EXPECT_THAT(read("cascade session 1\nname n\noptions {}\nscript 1\nx\nkeep 0\n"),
                HasSubstr("line 6"));
}

}  // namespace
}  // namespace cascade::test

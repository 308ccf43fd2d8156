// Runs that tests change while they run.
#pragma once

#include "run/session/live_run.h"
#include "support/random_stream.h"
#include "unit/run/simulation_options.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace cascade::test {

/// The text with the first `old` in it replaced; it must be there.
inline std::string with(std::string text, const std::string& old, const std::string& changed) {
    return text.replace(text.find(old), old.size(), changed);
}

class LiveRunFixture : public ::testing::Test {
protected:
    std::unique_ptr<LiveRun> begun(const std::string& text) {
        auto run = LiveRun::begin(load_script("test", text, "."), interpreted(), control_);
        EXPECT_TRUE(run) << run.error().messages(false);
        return run ? std::move(*run) : nullptr;
    }
    std::unique_ptr<LiveRun> played(const SessionLog& log) {
        auto run = LiveRun::play(log, ".", interpreted(), control_);
        EXPECT_TRUE(run) << run.error().messages(false);
        return run ? std::move(*run) : nullptr;
    }
    void advance(LiveRun& run, std::int64_t count) {
        const auto end = run.advance(count, control_);
        EXPECT_TRUE(end) << end.error().message;
    }
    void apply(LiveRun& run, const Change& change) {
        const auto made = run.apply(change, control_);
        EXPECT_TRUE(made) << made.error().messages(false);
    }
    std::string refused(LiveRun& run, const Change& change) {
        const auto made = run.apply(change, control_);
        EXPECT_FALSE(made);
        return made ? "" : made.error().messages(false);
    }

    /// In what the values of a stage differ; "" if they do not. The last stage that has begun
    /// `goes_on`.
    virtual std::string difference_of_values(const StageState& one, const StageState& other,
                                             bool goes_on) const = 0;

    /// Empty if all stages have the same values and are equally far.
    std::string difference(const LiveRun& first, const LiveRun& second) const {
        if (first.place() != second.place()) return "they are at other places";
        for (std::uint32_t k = 0; k <= first.place().stage; ++k) {
            const StageState& a = first.simulation().state(k);
            const StageState& b = second.simulation().state(k);
            if (a.t != b.t || a.done != b.done) return "their times differ";
            auto found = difference_of_values(a, b, k == first.place().stage);
            if (!found.empty()) return found;
        }
        return "";
    }

    /// Applies, undoes and repeats nine changes at random and goes between two stages, `count`
    /// times, each after fewer than `steps` steps.
    void change_at_random(LiveRun& run, const std::vector<Change>& changes, int count,
                          std::uint32_t steps, RandomStream& random) {
        ASSERT_EQ(changes.size(), 9u);
        run.set_undo_memory(random.chance(50) ? std::size_t{20000} : std::size_t{1} << 24);
        for (int k = 0; k < count; ++k) {
            advance(run, random.below(steps));
            const std::uint32_t what = random.below(14);
            if (what < 9) {
                (void)run.apply(changes[what], control_, random.chance(30));
            } else if (what < 11) {
                (void)run.undo(control_);
            } else if (what == 11) {
                (void)run.redo(control_);
            } else if (what == 12) {
                (void)run.go_to(random.below(2), control_);
            }
        }
    }

    /// Whatever was done, the log gives the same bits again, from its text as well.
    void expect_same_from_log(const LiveRun& run) {
        const std::string text = print_session_log(run.log());
        const auto log = parse_session_log(text);
        ASSERT_TRUE(log) << log.error().message << "\n" << text;
        const auto again = played(*log);
        ASSERT_TRUE(again) << text;
        EXPECT_EQ(difference(run, *again), "") << text;
    }

    RunControl control_;
};

}  // namespace cascade::test

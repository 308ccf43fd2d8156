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

/// The text with `changed` in place of the first `old`, which the text must contain.
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

    /// Names a difference between the values of two states of a stage, and is "" if there is none.
    /// `goes_on` is true for the last stage that has begun.
    virtual std::string difference_of_values(const StageState& one, const StageState& other,
                                             bool goes_on) const = 0;

    /// Names a difference between two runs, and is empty if all stages have the same values and
    /// have taken the same steps.
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

    /// Applies, undoes and repeats these changes at random and goes between two stages, `count`
    /// times, each after fewer than `steps` steps.
    void change_at_random(LiveRun& run, const std::vector<Change>& changes, int count,
                          std::uint32_t steps, RandomStream& random) {
        run.set_undo_memory(random.chance(50) ? std::size_t{20000} : std::size_t{1} << 24);
        for (int k = 0; k < count; ++k) {
            advance(run, random.below(steps));
            const auto count_of_changes = static_cast<std::uint32_t>(changes.size());
            const std::uint32_t what = random.below(count_of_changes + 5);
            if (what < count_of_changes) {
                (void)run.apply(changes[what], control_, random.chance(30));
            } else if (what < count_of_changes + 2) {
                (void)run.undo(control_);
            } else if (what == count_of_changes + 2) {
                (void)run.redo(control_);
            } else if (what == count_of_changes + 3) {
                (void)run.go_to(random.below(2), control_);
            }
        }
    }

    /// Expects that playing the log, and playing it after it was written as text and read, give the
    /// same bits.
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

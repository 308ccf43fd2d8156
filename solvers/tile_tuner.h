// Which tiling a run uses. What is fastest depends on more than the sizes of caches, so a run that
// goes on for long enough tries a few tilings on steps of its own, by turns in several rounds, and
// goes on with the best. No result depends on it.
//
// What fits by the sizes of caches is used first, or what an earlier run found. Another one than
// what fits is used only if it was clearly faster in every round; one that was not is tried no
// more. Of a turn its fastest batch counts. So no disturbed moment decides, and after the first
// round time is spent only on what seems to be faster. But other programs may be at work for as
// long as all rounds take, so now and then all is tried again, and what an earlier run found as
// soon as anything would be.
#pragma once

#include "solvers/tiling_memory.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace cascade {

/// Times come from outside, so that a test can make them up.
class TileTuner {
public:
    using Seconds = std::chrono::duration<double>;

    /// At least one candidate; of one alone nothing is tried. What `memory` knows of so many
    /// threads is used at first, and it is told what is found; nullptr: there is none.
    explicit TileTuner(std::vector<Tiling> candidates, TilingMemory* memory = nullptr,
                       int threads = 1);

    const std::vector<Tiling>& candidates() const { return candidates_; }
    /// That of the next batch of steps.
    const Tiling& tiling() const { return candidates_[current_]; }

    bool is_trying() const { return is_trying_; }
    /// How a tiling was found to be the best, in words; empty before that.
    std::string how_found() const;

    /// Sweeps (passes of steps) that a batch takes while trying: a part of a turn, of whole tiles
    /// of each candidate.
    std::int64_t sweeps_of_trial() const;

    /// A batch of `sweeps` took so long with tiling(). At that speed the run is expected to go on
    /// for `left`; trials begin where they cost little of it.
    void took(std::int64_t sweeps, Seconds duration, Seconds left);

private:
    enum class Choice : std::uint8_t { by_size, recalled, by_time };
    static constexpr double never = std::numeric_limits<double>::infinity();
    /// What is known of a candidate.
    struct Tried {
        std::size_t candidate = 0;
        std::int64_t sweeps = 0;  ///< In this round,
        double least = never;     ///< seconds of a sweep in its fastest batch,
        double least_in_all = 0;  ///< and these, summed over all rounds.
    };

    void recall();
    std::int64_t sweeps_in(double seconds) const;
    bool is_due(double left) const;
    void begin();
    void end_round();
    void end(std::size_t best);

    std::vector<Tiling> candidates_;
    TilingMemory* memory_;
    int threads_;
    int most_levels_ = 1;
    Choice choice_ = Choice::by_size;
    std::size_t current_ = 0;
    std::size_t used_before_ = 0;  ///< The one that was current when trials began.
    bool is_trying_ = false;
    double rested_seconds_ = 0;         ///< Steps since trials, or from the start;
    double seconds_per_sweep_ = never;  ///< of a sweep in the fastest batch of them.
    double patience_ = 1;               ///< So many times as rarely as at first is all tried again.
    int round_ = 0;
    std::int64_t sweeps_of_turn_ = 0;
    std::vector<Tried> tried_;  ///< Those that are still in; the first is what fits by size.
    std::size_t turn_ = 0;      ///< Whose turn it is, of those.
};

}  // namespace cascade

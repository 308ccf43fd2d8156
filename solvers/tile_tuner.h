// Chooses a tiling by measured times. The fastest tiling depends on more than the sizes of caches.
// So a run that is long enough tries a few tilings: in several rounds, it takes some steps with
// each tiling in turn. After the last round it uses the fastest. Results do not depend on the
// tiling.
//
// The first tiling in use is chosen by the sizes of caches, or is the result of an earlier run.
// Another tiling replaces it only if the other tiling was clearly faster in every round. A tiling
// that was not clearly faster in a round is not tried in later rounds. Only the fastest batch of a
// turn counts. So no disturbance decides the result, and after the first round only tilings that
// seem faster cost time. But other programs may be busy during all rounds. So all tilings are tried
// again from time to time, and an earlier run's result is tried as soon as trials may begin.
#pragma once

#include "solvers/tiling_memory.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace cascade {

/// Callers pass in the times, so that tests can choose them.
class TileTuner {
public:
    using Seconds = std::chrono::duration<double>;

    /// Needs at least one candidate. If there is only one, nothing is measured. If `memory` has a
    /// tiling for this number of threads, the tuner begins with that tiling. `memory` receives the
    /// result and may be null.
    explicit TileTuner(std::vector<Tiling> candidates, TilingMemory* memory = nullptr,
                       int threads = 1);

    const std::vector<Tiling>& candidates() const { return candidates_; }
    /// The tiling of the next batch of steps.
    const Tiling& tiling() const { return candidates_[current_]; }

    bool is_trying() const { return is_trying_; }
    /// The reason why this tiling is in use, in words; empty before trials end.
    std::string how_found() const;

    /// The number of sweeps (passes of steps) in a batch while tilings are tried. The batch takes a
    /// fraction of a turn, and the number is a whole number of tiles for each candidate.
    std::int64_t sweeps_of_trial() const;

    /// Records the time of a batch of `sweeps` with tiling(). `left` is how long the run will
    /// probably continue at that speed. Trials begin once they would take little time compared to
    /// `left`.
    void took(std::int64_t sweeps, Seconds duration, Seconds left);

private:
    enum class Choice : std::uint8_t { by_size, recalled, by_time };
    static constexpr double never = std::numeric_limits<double>::infinity();
    /// The measurements of a candidate.
    struct Tried {
        std::size_t candidate = 0;
        std::int64_t sweeps = 0;  ///< Number of sweeps in this round.
        double least = never;     ///< Seconds per sweep in the fastest batch of this round.
        double least_in_all = 0;  ///< The sum of `least` over all rounds.
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
    std::size_t used_before_ = 0;  ///< The tiling in use when trials began.
    bool is_trying_ = false;
    double rested_seconds_ = 0;  ///< Seconds of steps since the last trials, or since the start.
    /// Seconds per sweep in the fastest batch since the last trials, or since the start.
    double seconds_per_sweep_ = never;
    double patience_ = 1;  ///< The factor by which trials are rarer than at first.
    int round_ = 0;
    std::int64_t sweeps_of_turn_ = 0;
    std::vector<Tried> tried_;  ///< The remaining candidates, beginning with the choice by size.
    std::size_t turn_ = 0;      ///< The candidate whose turn it is.
};

}  // namespace cascade

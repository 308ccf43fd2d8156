// Chooses a tiling by time. The fastest one depends on more than the sizes of caches, so a run that
// is long enough takes some of its steps with each of a few tilings, by turns in several rounds,
// and continues with the fastest. Results do not depend on it.
//
// The first tiling in use is the choice by the sizes of caches, or the result of an earlier run.
// Another one replaces the choice by size only if it was clearly faster in every round. If it was
// not, it is not tried again. A turn counts by its fastest batch. So no disturbance decides the
// result, and after the first round only tilings that seem faster cost time. But other programs may
// be busy during all rounds. So all tilings are tried again from time to time, and an earlier run's
// result as soon as trials may begin.
#pragma once

#include "solvers/tiling_memory.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace cascade {

/// Callers pass times in, so that a test can choose them.
class TileTuner {
public:
    using Seconds = std::chrono::duration<double>;

    /// Takes at least one candidate. A single one is not tried. If `memory` knows a tiling for this
    /// number of threads, that is used at first. `memory` receives the result and may be null.
    explicit TileTuner(std::vector<Tiling> candidates, TilingMemory* memory = nullptr,
                       int threads = 1);

    const std::vector<Tiling>& candidates() const { return candidates_; }
    /// The tiling of the next batch of steps.
    const Tiling& tiling() const { return candidates_[current_]; }

    bool is_trying() const { return is_trying_; }
    /// Why this tiling is in use, in words; empty before trials end.
    std::string how_found() const;

    /// Sweeps (passes of steps) in a batch while tilings are tried: a fraction of a turn, in whole
    /// tiles of each candidate.
    std::int64_t sweeps_of_trial() const;

    /// Records the time of a batch of `sweeps` with tiling(). At that speed the run is expected to
    /// continue for `left`. Trials begin when they cost little in comparison.
    void took(std::int64_t sweeps, Seconds duration, Seconds left);

private:
    enum class Choice : std::uint8_t { by_size, recalled, by_time };
    static constexpr double never = std::numeric_limits<double>::infinity();
    /// The measurements of a candidate.
    struct Tried {
        std::size_t candidate = 0;
        std::int64_t sweeps = 0;  ///< Sweeps in this round.
        double least = never;     ///< Seconds of a sweep in its fastest batch of this round,
        double least_in_all = 0;  ///< and their sum over all rounds.
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
    double rested_seconds_ = 0;         ///< Seconds of steps since trials, or since the start.
    double seconds_per_sweep_ = never;  ///< Seconds of a sweep in their fastest batch.
    double patience_ = 1;               ///< The factor by which trials are rarer than at first.
    int round_ = 0;
    std::int64_t sweeps_of_turn_ = 0;
    std::vector<Tried> tried_;  ///< The candidates that remain; the first is the choice by size.
    std::size_t turn_ = 0;      ///< The candidate whose turn it is.
};

}  // namespace cascade

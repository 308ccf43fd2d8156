// Counts the tiles of a step. A pass that needs all rows begins a new tile.
#include "solvers/stepping.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace cascade {
namespace {

/// Whether each step is judged before the next step begins.
bool is_judged(const StepProblem& problem) { return problem.error_register.has_value(); }

/// The reason why steps are taken one by one; empty if they can be taken together.
std::string hindrance(const StepProblem& problem) {
    const auto any = [&](const auto& is_so) {
        return std::any_of(problem.passes.begin(), problem.passes.end(), is_so);
    };
    if (is_judged(problem)) return "each may be taken back";
    if (any([](const auto& pass) { return pass.filter.has_value(); }))
        return "its waves need all cells";
    if (any(needs_all_rows)) return "its aggregates need every step";
    return "";
}

void describe(const StepProblem& problem, int levels, Stepping& stepping) {
    const std::size_t passes = problem.passes.size();
    std::string why = hindrance(problem);
    if (levels > 1 && why.empty()) {
        stepping.words = fmt::format("{} {} a pass", levels, passes == 1 ? "steps" : "sweeps");
    } else if (levels > 1 && passes > 2 && is_judged(problem)) {
        stepping.words = fmt::format("up to {} sweeps a pass within a step",
                                     std::min(static_cast<std::size_t>(levels), passes));
    } else if (levels > 1 && passes > 2) {
        stepping.words = fmt::format("up to {} sweeps a pass between its aggregates",
                                     std::min(static_cast<std::size_t>(levels), passes));
    } else {
        stepping.words = "one step a pass";
        const bool is_small = stays_in_cache(problem, CacheSizes::here());
        if (why.empty())
            why = is_small ? "all stays in the cache" : "layers are too large for more";
        stepping.why = std::move(why);
    }
}

/// The number of times that a step reads its planes from memory. Some passes need all rows. The
/// passes between two of them are divided into tiles of nearly equal numbers of levels.
double tiles_of_step(const StepProblem& problem, int levels) {
    const std::size_t passes = problem.passes.size();
    const auto begins = [&](std::size_t pass) {
        const bool begins_step = pass % passes == 0 && is_judged(problem);
        return begins_step || needs_all_rows(problem.passes[pass % passes]);
    };
    std::size_t first = 0;
    while (first < passes && !begins(first)) ++first;
    if (first == passes) return static_cast<double>(passes) / levels;
    std::size_t tiles = 0, free = 0;
    const auto most = static_cast<std::size_t>(levels);
    for (std::size_t pass = first; pass < first + passes; ++pass) {
        ++free;
        if (!begins(pass + 1)) continue;
        tiles += (free + most - 1) / most;
        free = 0;
    }
    return static_cast<double>(tiles);
}

}  // namespace

Stepping stepping_with(const StepProblem& problem, const Tiling& tiling, int levels, int phases) {
    Stepping stepping;
    describe(problem, levels, stepping);
    const auto passes = static_cast<double>(problem.passes.size());
    const double tiles = tiles_of_step(problem, levels);
    stepping.sweeps_at_once = passes / tiles;
    const bool is_tiled = stepping.sweeps_at_once > 1;
    stepping.meetings = tiles * (is_tiled ? phases : 1);
    for (const StepProblem::Pass& pass : problem.passes) {
        stepping.meetings += !pass.reductions.empty();
        // Barriers before and after each convolution, and between the transforms along its axes.
        stepping.meetings += 4.0 * static_cast<double>(pass.convolutions.size());
    }
    if (is_tiled) stepping.bytes_in_use = bytes_in_use(problem, tiling, levels);
    return stepping;
}

}  // namespace cascade

// Each trial is a small simulation. Its result corrects the factor for the next trial.
#include "run/simulation/size_trial.h"

#include "core/spread.h"
#include "lang/program/scaled_lengths.h"
#include "measure/spectrum.h"
#include "run/simulation/environment.h"
#include "run/simulation/stage_run.h"
#include "run/simulation/stage_start.h"
#include "run/simulation/stage_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace cascade {

namespace {

/// The sizes of trial runs in one, two or three dimensions.
struct TrialShape {
    /// The number of cells along each axis of the first trial. The wavelength is still unknown in
    /// this trial.
    std::int64_t first_side;
    double waves;  ///< The number of waves that fit along each axis in later trials.
    std::int64_t least_side, most_side;
    double most_cells;  ///< The largest number of cells that a wave has in later trials.
    /// The grid shortens a wave of n cells by the fraction `narrowing` / n². This is because the
    /// discrete Laplacian multiplies the wave by k² (1 − k²h²/12 · m), and the exact Laplacian by
    /// k². Here k = 2π/(n h), and m is the mean of Σ dᵢ⁴ over all directions d: 1, 3/4 and 3/5 in
    /// one, two and three dimensions. Half of the relative error of k² appears in k.
    double narrowing;
};

constexpr double square(double x) { return x * x; }
constexpr double two_pi = 2 * std::numbers::pi;
constexpr TrialShape shapes[3] = {
    {512, 100, 512, 4096, 16, square(two_pi) / 24},
    {192, 28, 160, 336, 12, square(two_pi) / 24 * 3 / 4},
    {48, 7, 40, 56, 8, square(two_pi) / 24 * 3 / 5},
};

/// A trial is examined for the first time after `first_steps`. The limit on its steps is the
/// largest of the stage's steps, the system's steps and `least_most_steps`. If the stage gives no
/// end, the limit is `most_steps_without_end`.
constexpr std::int64_t first_steps = 250, least_most_steps = 1000, most_steps_without_end = 64000;
/// If a stage has a duration, its trial is examined for the first time after the fraction
/// `first_part` of the duration, and then whenever the time has doubled. The trial ends at the
/// latest after `last_part` times the duration.
constexpr double first_part = 0.125, last_part = 4;
/// Wavelength and contrast count as constant if, while the time doubles, their relative changes are
/// below `same_wavelength` and `same_contrast`. If the wavelength changes by more than
/// `other_wavelength`, the pattern has no definite wavelength.
constexpr double same_wavelength = 0.003, same_contrast = 0.03, other_wavelength = 0.08;
/// A pattern has a single wavelength if the peak of its spectrum contains at least this fraction of
/// the variance.
constexpr double regular_share = 0.3;
/// The factors of the first trials. Several are tried, because the pattern may be too large or too
/// small for the cells.
constexpr double first_factors[] = {1, 1.0 / 4, 3, 1.0 / 16, 1.0 / 64, 1.0 / 256};
constexpr double fewest_cells = 3, fewest_waves = 4;
/// Trials are repeated until the relative error of the wavelength is below `close_enough`, at most
/// `most_rounds` times. The factor is averaged over trials, but a trial whose error is above
/// `near_enough` is left out.
constexpr double close_enough = 0.01, near_enough = 0.06;
constexpr std::uint32_t most_rounds = 4;

double relative_change(double now, double before) { return std::abs(now / before - 1); }

/// Measurements of the pattern of a trial.
struct Look {
    bool is_uniform = true;
    double cells = 0;  ///< The wavelength, in cells.
    double share = 0;  ///< The fraction of the variance that the peak of the spectrum contains.
    double deviation = 0;
};

struct Outcome {
    Look last, before;  ///< The last measurement, and the measurement at half of its time.
    int still = 0;      ///< The number of successive measurements that found no change.
    /// Two such measurements are needed, because slow changes add up when the time doubles again.
    bool holds_still() const { return still >= 2; }
};

/// Returns tools for trials. Trials run on small grids in this process, even if ranks share the
/// run.
StepTools alone(StepTools tools) {
    tools.executor = make_thread_executor;
    return tools;
}

class Trial {
public:
    Trial(Program program, std::uint32_t stage, const TrialTools& tools)
        : stage_(stage),
          tools_(tools),
          program_(std::make_shared<Program>(std::move(program))),
          environment_(tools.script, program_, {*program_, tools.planning}, program_->domain.grid,
                       alone(tools.steps)) {
        environment_.progress_note = ", a trial run for its size";
        control_.report = [this](const Progress& progress) {
            if (tools_.control.cancel) control_.cancel = true;
            if (progress.stage_done || !tools_.control.report) return;
            Progress told;
            told.doing = fmt::format("finding the size of stage '{}'", progress.stage);
            tools_.control.report(told);
        };
    }

    Result<Outcome> run() {
        states_.resize(stage_ + 1);
        for (std::uint32_t k = 0; k <= stage_; ++k) {
            if (program_->system_of(k).cells) continue;
            if (auto started = start_stage(environment_, states_, k); !started)
                return tl::unexpected(started.error());
        }
        const double duration = duration_of(stage(), program_->system_of(stage_), states_[stage_]);
        return std::isfinite(duration) ? run_for(duration) : run_steps();
    }

private:
    Stage& stage() { return program_->stages[stage_]; }

    Result<Outcome> run_steps() {
        const std::int64_t most = trial_steps(*program_, stage_);
        stage().iterations = most;
        StageRun run(environment_, states_, stage_, never_);
        Outcome outcome;
        for (std::int64_t steps = first_steps; !is_over(outcome); steps *= 2) {
            if (auto done = advance(run, std::min(steps, most), outcome); !done)
                return tl::unexpected(done.error());
        }
        return outcome;
    }

    Result<Outcome> run_for(double duration) {
        Outcome outcome;
        stage().time.duration_in_steps.reset();
        stage().iterations = std::numeric_limits<std::int32_t>::max();
        for (double part = first_part; !outcome.holds_still() && part <= last_part; part *= 2) {
            stage().time.duration = part * duration;
            states_[stage_].done = false;
            StageRun run(environment_, states_, stage_, never_);
            if (auto done = advance(run, stage().iterations, outcome); !done)
                return tl::unexpected(done.error());
        }
        return outcome;
    }

    bool is_over(const Outcome& outcome) const {
        return outcome.holds_still() || states_[stage_].done;
    }

    Result<void> advance(StageRun& run, std::int64_t last_step, Outcome& outcome) {
        const auto end = run.advance(last_step, control_, {});
        if (!end) return tl::unexpected(end.error());
        if (*end == StageEnd::cancelled) return failure("stopped");
        outcome.before = std::exchange(outcome.last, look());
        const Look &now = outcome.last, &before = outcome.before;
        const bool is_still = !now.is_uniform && !before.is_uniform &&
                              relative_change(now.cells, before.cells) < same_wavelength &&
                              relative_change(now.deviation, before.deviation) < same_contrast;
        outcome.still = is_still ? outcome.still + 1 : 0;
        return {};
    }

    Look look() {
        const StageView view(environment_, states_, stage_);
        measure::Samples samples =
            measure::to_samples(view.evaluate(stage().show)[0], environment_.grid);
        samples.spacing.fill(1);
        const Spread spread = spread_of([&](const auto& take) {
            for (const double value : samples.values) take(value);
        });
        if (spread.is_uniform()) return {};
        const auto spectrum = measure::in_wide_rings(measure::radial_spectrum(samples));
        return {false, measure::peak_wavelength(spectrum), measure::peak_share(spectrum),
                spread.deviation()};
    }

    std::uint32_t stage_;
    const TrialTools& tools_;
    std::shared_ptr<Program> program_;
    Environment environment_;
    std::vector<StageState> states_;
    Keeping never_;
    RunControl control_;
};

Grid trial_grid(Grid grid, std::int64_t side) {
    for (std::int64_t* const cells : {&grid.width, &grid.height, &grid.depth}) {
        if (*cells > 1) *cells = side;
    }
    return grid;
}

class FactorFinder {
public:
    FactorFinder(const Program& trial, std::uint32_t stage, double cell, const TrialTools& tools)
        : trial_(trial), stage_(stage), tools_(tools), shape_(shapes[axes_of(trial.domain) - 1]) {
        trial_.domain.grid.spacing = cell;
    }

    Result<double> find(double cells) {
        auto first = first_wave();
        if (!first) return first;
        // The wavelength, in cells, that the stage would have at a factor of 1 if the grid did not
        // shorten it.
        const double free = *first;
        const double target = std::min(cells, shape_.most_cells);
        double factor = without_grid(target) / free;
        // The pattern depends on random numbers, so the factors of several rounds are averaged.
        double sum = 0;
        int count = 0;
        for (std::uint32_t round = 1; round <= most_rounds; ++round) {
            const auto grown = run(factor, side_for(target), round);
            if (!grown) return tl::unexpected(grown.error());
            if (auto good = check(*grown); !good) return tl::unexpected(good.error());
            const double by = target / grown->last.cells;
            const bool is_near = std::abs(by - 1) < near_enough;
            sum = is_near ? sum + factor * by : 0;
            count = is_near ? count + 1 : 0;
            factor = is_near ? sum / count : factor * by;
            if (std::abs(by - 1) < close_enough) break;
        }
        return factor * without_grid(cells) / without_grid(target);
    }

private:
    /// Returns the wavelength that a wave would have without a grid, if it has `cells` cells on a
    /// grid.
    double without_grid(double cells) const { return cells + shape_.narrowing / cells; }

    std::int64_t side_for(double cells) const {
        constexpr std::int64_t multiple = 16;
        const auto side = static_cast<std::int64_t>(shape_.waves * cells) / multiple * multiple;
        return std::clamp(side, shape_.least_side, shape_.most_side);
    }

    Result<Outcome> run(double factor, std::int64_t side, std::uint32_t seed = 1) {
        Program program = with_lengths(trial_, stage_, factor);
        program.domain.seed = seed;
        program.domain.grid = trial_grid(program.domain.grid, side);
        auto grown = Trial(std::move(program), stage_, tools_).run();
        if (grown) return grown;
        return failure(fmt::format("the trial run for the size of stage '{}' failed: {}",
                                   trial_.stages[stage_].name, grown.error().message),
                       grown.error().hint);
    }

    Result<double> first_wave() {
        const auto side = static_cast<double>(shape_.first_side);
        Failure why{fmt::format("no pattern grows in a trial run of stage '{}', so 'size' has "
                                "nothing to scale",
                                trial_.stages[stage_].name),
                    "run the stage without 'size' first; 'cascade analyze' predicts what grows"};
        for (const double factor : first_factors) {
            const auto grown = run(factor, shape_.first_side);
            if (tools_.control.cancel) return failure("stopped");
            if (!grown) {
                // The stage must be stable only with its own lengths. Failures with other factors
                // are ignored.
                if (factor == 1) why = grown.error();
                continue;
            }
            const Look& look = grown->last;
            const bool is_shown =
                !look.is_uniform && look.cells >= fewest_cells && look.cells <= side / fewest_waves;
            if (!is_shown) continue;
            if (const auto good = check(*grown); !good) return tl::unexpected(good.error());
            return without_grid(look.cells) / factor;
        }
        return tl::unexpected(why);
    }

    Result<void> check(const Outcome& grown) const {
        const std::string& name = trial_.stages[stage_].name;
        const Look &now = grown.last, &before = grown.before;
        if (now.is_uniform) {
            return failure(fmt::format("the pattern of stage '{}' dies out in a trial run", name),
                           "run the stage without 'size' first");
        }
        if (!grown.holds_still() && !before.is_uniform &&
            relative_change(now.cells, before.cells) > other_wavelength) {
            return failure(
                fmt::format("the pattern of stage '{}' has no fixed wavelength: in a trial run "
                            "its waves were {:.3g} cells long after half of the time and {:.3g} "
                            "cells at the end",
                            name, before.cells, now.cells),
                "leave 'size' out: the pattern widens throughout the run, or never settles");
        }
        if (now.share < regular_share) {
            return failure(
                fmt::format("the pattern of stage '{}' has waves of many lengths, and none that "
                            "'size' could scale",
                            name),
                "leave 'size' out");
        }
        return {};
    }

    Program trial_;
    std::uint32_t stage_;
    const TrialTools& tools_;
    TrialShape shape_;
};

double to_four_digits(double value) {
    const double place = std::pow(10.0, 3 - std::floor(std::log10(value)));
    return std::round(value * place) / place;
}

}  // namespace

std::int64_t trial_steps(const Program& trial, std::uint32_t stage) {
    const Stage& its = trial.stages[stage];
    if (its.time.open_end) return most_steps_without_end;
    const auto& usual = trial.system_of(stage).settings.iterations;
    return std::max({its.size->steps, usual.value_or(0), least_most_steps});
}

Result<double> find_length_factor(const Program& trial, std::uint32_t stage, double cell,
                                  double cells, const TrialTools& tools) {
    const auto factor = FactorFinder(trial, stage, cell, tools).find(cells);
    if (!factor) return factor;
    return to_four_digits(*factor);
}

}  // namespace cascade

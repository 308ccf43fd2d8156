// Examines the species, their rates, and a few further steps.
#include "run/simulation/stage_doubts.h"

#include "core/spread.h"
#include "lang/program/nodes_of_rates.h"
#include "run/simulation/diagnosis.h"
#include "run/simulation/exact_map.h"
#include "run/simulation/growth_doubts.h"
#include "run/simulation/lost_changes.h"
#include "run/simulation/stage_tools.h"
#include "run/stage/step_advice.h"
#include "solvers/chequerboard.h"
#include "solvers/field_norms.h"
#include "solvers/flicker.h"
#include "solvers/solve_report.h"
#include "solvers/step_paths.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace cascade {

namespace {

/// A species that jumps back and forth from step to step.
struct Flicker {
    std::string species;
    double part = 0;     ///< The fraction of the cells that jump.
    double largest = 0;  ///< The largest jump.
};

std::optional<Flicker> find_flicker(const EndedStage& ended);

/// A stage whose result may be in doubt.
class Doubted {
public:
    explicit Doubted(const EndedStage& stage) : ended(stage), view(stage.view) {}

    const EndedStage& ended;
    const StageView& view;

    const std::string& name() const { return view.stage().name; }
    std::string species(std::size_t number) const { return species_name(view.system(), number); }
    /// Returns the species whose values jump from step to step, if there is one. The first call
    /// measures this, and later calls return the same result.
    const std::optional<Flicker>& flicker() const {
        if (!flicker_) {
            const bool may_flicker = allows_trial_steps(ended) && !is_exact_map(view);
            flicker_ = may_flicker ? find_flicker(ended) : std::nullopt;
        }
        return *flicker_;
    }

private:
    mutable std::optional<std::optional<Flicker>> flicker_;
};

bool is_ended(const Doubted&) { return true; }
bool allows_trial(const Doubted& stage) {
    return allows_trial_steps(stage.ended) && !is_exact_map(stage.view);
}

// The following functions find constraints that were not solved.

struct Unsolved {
    const SolveReport& solve;
    const std::string& unknown;
};

constexpr double largest_rest = 1e-3, largest_mean = 1e-3;

std::optional<Unsolved> find_unsolved(const Doubted& stage) {
    for (const auto& [number, report] : *stage.ended.state.fields().constraints) {
        if (report->largest_rest <= largest_rest && report->largest_mean <= largest_mean) continue;
        return Unsolved{*report, stage.view.program().literals->constraint(number).unknown};
    }
    return std::nullopt;
}

std::string describe_unsolved(const Doubted& stage, const Unsolved& report) {
    const SolveReport& solve = report.solve;
    if (!(solve.largest_rest <= largest_rest)) {
        return fmt::format(
            "stage '{}': the constraint of {} was not solved: after {} iterations the remaining "
            "error was still {:.2g} of the error without {}; its operator may have no inverse, "
            "or its "
            "coefficients may differ too much",
            stage.name(), report.unknown, solve.most_iterations, solve.largest_rest,
            report.unknown);
    }
    return fmt::format(
        "stage '{0}': the constraint of {1} has a mean, {2:.2g} of the whole, which no values of "
        "{1} can balance; the rest was solved, and the mean of {1} is 0",
        stage.name(), report.unknown, solve.largest_mean);
}

// The following functions find values that jump back and forth.

/// A warning is given if at least this fraction of the cells jumps.
constexpr double flicker_threshold = 0.01;
/// A warning is also given if at least this fraction of all changes is undone by the next steps,
/// and if steps are too long even for a regular oscillation.
constexpr double undone_threshold = 0.4;

std::optional<Flicker> find_flicker(const EndedStage& ended) {
    const StageView& view = ended.view;
    const StageState& state = ended.state;
    FlickerWatch watch(view.environment().counted());
    const bool is_finite =
        take_trial_steps(ended, ended.timer, std::min(most_trial_steps, state.steps / 4),
                         [&](std::int64_t, double, std::span<const Field> species) {
                             watch.see(species);
                             return true;
                         });
    if (!is_finite) return std::nullopt;

    const System& system = view.system();
    const bool is_random = holds_in_rates(system, is_draw);
    for (std::size_t s = 0; s < state.species().size(); ++s) {
        const FlickerWatch::Finding found = watch.finding(s);
        if (found.flickering < flicker_threshold && (is_random || found.undone < undone_threshold))
            continue;
        return Flicker{species_name(system, s), found.flickering, found.largest};
    }
    return std::nullopt;
}

/// Values that jump back and forth, with the longest stable step if it is known.
struct SureFlicker {
    Flicker flicker;
    StepInUse use;
    std::optional<double> limit;
};

/// Finds values that jump back and forth because of the length of steps. Changes that undo each
/// other irregularly may be waves with a period of a few steps. Such changes count as errors only
/// if the step exceeds its stability limit.
std::optional<SureFlicker> find_sure_flicker(const Doubted& stage) {
    if (!stage.flicker()) return std::nullopt;
    const StageView& view = stage.view;
    SureFlicker sure{*stage.flicker(), view.step_in_use(), std::nullopt};
    const auto is_beyond = [&] { return sure.limit && is_too_long(sure.use, *sure.limit); };
    sure.limit = longest_step(view.stability(view.state().species()), sure.use);
    if (!is_beyond()) sure.limit = longest_step(view.stability(view.starting_species()), sure.use);
    if (sure.flicker.part < flicker_threshold && !is_beyond()) return std::nullopt;
    return sure;
}

std::string describe_flicker(const Doubted& stage, const SureFlicker& sure) {
    const auto& [flicker, use, limit] = sure;
    std::string text = fmt::format("stage '{}': {} jumps back and forth from step to step",
                                   stage.name(), flicker.species);
    if (flicker.part >= flicker_threshold) {
        text += fmt::format(", by up to {:.3g} in {:.0f} % of the cells", flicker.largest,
                            std::max(1.0, 100 * flicker.part));
    }
    text += ", because the time step is too large; ";
    if (limit && is_too_long(use, *limit)) return text + advise(*limit, use);
    if (!(use.speed > 0)) return text + "make 'speed' smaller";
    return text + fmt::format("try 'speed: {:.2g}'", use.speed / 2);
}

// The following functions describe neighbours that alternate because of the steps or the rate.

/// Returns the number of the first species that alternates from cell to cell.
std::optional<std::size_t> find_alternating(const Doubted& stage) {
    const StageView& view = stage.view;
    if (is_exact_map(view)) return std::nullopt;
    const std::vector<Field>& species = view.state().species();
    const Environment& here = view.environment();
    const Links* links = here.model ? &here.model->cells->spread().links : nullptr;
    const StageTime& time = view.stage().time;
    const auto alternates = [&](const Field& field) {
        const auto k = static_cast<std::size_t>(&field - species.data());
        const StageCourse& course = view.state().course;
        const double once = course.empty() ? 0 : course.last().largest[k];
        if (alternating_part(field, here.counted(), links) < chequerboard_threshold) return false;
        // If the differences between cells are small, they are rounding errors or errors within the
        // solver's tolerance. Such errors may well contain the shortest waves.
        const FieldMoments values = moments(field, here.counted());
        const double errors =
            time.chooses_steps() ? time.step_tolerance() * values.root_mean_square : 0;
        return values.deviation > std::max(remaining_part * once, errors);
    };
    const auto found = std::find_if(species.begin(), species.end(), alternates);
    if (found == species.end()) return std::nullopt;
    return static_cast<std::size_t>(found - species.begin());
}

/// Describes a species that alternates from cell to cell, if the step is too long or a rate makes
/// differences between neighbours grow. Otherwise returns "", because the pattern may be a lattice.
std::string describe_chequerboard(const Doubted& stage, std::size_t species) {
    const StageView& view = stage.view;
    StepInUse use = view.step_in_use();
    use.diffusion_limits = view.diffusion_limits();
    const StabilityEstimate estimate = view.stability(view.state().species());
    const std::string text =
        fmt::format("stage '{}': {} alternates from cell to cell like a chequerboard", stage.name(),
                    stage.species(species));
    const auto limit = longest_step(estimate, use);
    if (limit && is_too_long(use, *limit)) {
        return text + ", which is no pattern: the time step is too large; " + advise(*limit, use);
    }
    if (stage.flicker()) {
        return text + fmt::format(
                          ", and jumps back and forth from step to step: the time step is too "
                          "large; try 'speed: {:.2g}'",
                          use.speed / 2);
    }
    if (!limit && estimate.eigenvalue > 0 && !is_partly_implicit(use.solver)) {
        return text +
               ", because its rate makes differences between neighbours grow: is a sign wrong?";
    }
    return {};
}

// The following functions find values that shorter steps would change in another way.

/// The number of shorter steps that replace one step in a check. Two would not be enough. Values
/// that alternate with each step often alternate with steps of half the length, too.
constexpr std::int64_t shorter_steps = 3;

bool could_take_shorter_steps(const Doubted& stage) {
    const StageView& view = stage.view;
    return allows_trial(stage) && view.stage().uniform[view.system().speed_item()] &&
           !is_stabilised(view.stage().time.solver) &&
           !knows_its_steps(view.program(), view.number());
}

/// A species that changes in another way, or not at all, with shorter steps.
struct Astray {
    std::string species;
    double change = 0;             ///< The root mean square of the change by the steps.
    double change_of_shorter = 0;  ///< The same for the shorter steps, which take the same time.
    double apart = 0;              ///< The distance between the two results, as a root mean square.
};

std::optional<Astray> find_astray(const Doubted& stage) {
    const EndedStage& ended = stage.ended;
    const StageView& view = stage.view;
    const System& system = view.system();
    const Mask* counted = view.environment().counted();
    const auto follow = [&](StageTimer& own, std::int64_t steps, StepPath& path) {
        return take_trial_steps(ended, own, steps,
                                [&](std::int64_t, double, std::span<const Field> species) {
                                    path.see(species);
                                    return true;
                                });
    };
    StepPath coarse(counted), fine(counted);
    if (!follow(ended.timer, least_trial_steps, coarse)) return std::nullopt;
    double& speed = ended.state.numbers[system.speed_item()];
    const double own_speed = std::exchange(speed, speed / shorter_steps);
    StageTimer shorter(view.program(), view.number(), ended.state,
                       stage_tools(view, view.environment().kernels.often()));
    const bool is_finite = follow(shorter, least_trial_steps * shorter_steps, fine);
    speed = own_speed;
    if (!is_finite) return std::nullopt;
    for (std::size_t s = 0; s < ended.state.species().size(); ++s) {
        const PathDifference found = difference(coarse, fine, s, counted);
        if (!found.is_apart) continue;
        return Astray{stage.species(s), found.coarse, found.fine, found.apart};
    }
    return std::nullopt;
}

std::string describe_astray(const Doubted& stage, const Astray& found) {
    const StageView& view = stage.view;
    const StepInUse use = view.step_in_use();
    const std::string text = fmt::format(
        "stage '{}': the time step is too large: {} more steps would change {} by {:.2g}, but {} "
        "steps of a third of the length would change it by {:.2g}, and the results differ by "
        "{:.2g}; ",
        stage.name(), least_trial_steps, found.species, found.change,
        least_trial_steps * shorter_steps, found.change_of_shorter, found.apart);
    const auto limit = longest_step(view.stability(view.state().species()), use);
    if (limit && is_too_long(use, *limit)) return text + advise(*limit, use);
    return text + fmt::format("try 'speed: {:.2g}'", use.speed / 3);
}

// The following functions find changes that are lost by rounding.

bool may_lose_changes(const Doubted& stage) { return could_lose_changes(stage.view); }
std::optional<ChangesLost> find_changes_lost(const Doubted& stage) {
    return find_lost_changes(stage.ended);
}

std::string describe_changes_lost(const Doubted& stage, const ChangesLost& found) {
    return fmt::format(
        "stage '{}': a step would change {} by about {:.2g}, which is too small to be added to "
        "values of {:.2g} in single precision, so about {:.2g} is lost over the stage; "
        "'precision: double' in the domain avoids this loss",
        stage.name(), found.species, found.change, found.value, found.lost);
}

// The following functions find wrong amounts in a domain that grows.

bool grows(const Doubted& stage) { return stage.view.stage().growth.has_value(); }
std::optional<AmountChanged> find_amount_changed(const Doubted& stage) {
    return find_changed_amount(stage.view);
}

std::string describe_amount_changed(const Doubted& stage, const AmountChanged& found) {
    const double speed = stage.view.state().numbers[stage.view.system().speed_item()];
    const std::string part =
        found.part < 10 ? fmt::format("by {:.2g} %", 100 * found.part) : "many times over";
    return fmt::format(
        "stage '{}': steps of {:.4g} are too long for the growth of the domain: even without a "
        "reaction, they would change an amount {}; {}",
        stage.name(), speed, part,
        found.speed ? fmt::format("try 'speed: {:.2g}'", *found.speed)
                    : "its length changes too suddenly");
}

constexpr Diagnosis<Doubted> doubts[] = {
    diagnosis<Doubted, grows, find_amount_changed, describe_amount_changed>(),
    diagnosis<Doubted, is_ended, find_unsolved, describe_unsolved>(),
    diagnosis<Doubted, is_ended, find_alternating, describe_chequerboard>(),
    diagnosis<Doubted, allows_trial, find_sure_flicker, describe_flicker>(),
    diagnosis<Doubted, could_take_shorter_steps, find_astray, describe_astray>(),
    diagnosis<Doubted, may_lose_changes, find_changes_lost, describe_changes_lost>(),
};

}  // namespace

std::string find_doubt(const EndedStage& ended) {
    return first_of<Doubted>(doubts, Doubted(ended));
}

}  // namespace cascade

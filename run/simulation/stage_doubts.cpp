// Examines the species, a few more steps, and the rates.
#include "run/simulation/stage_doubts.h"

#include "core/counted_cells.h"
#include "core/spread.h"
#include "lang/program/nodes_of_rates.h"
#include "run/simulation/stage_tools.h"
#include "run/stage/not_finite.h"
#include "run/stage/result_doubts.h"
#include "solvers/chequerboard.h"
#include "solvers/field_norms.h"
#include "solvers/flicker.h"
#include "solvers/step_paths.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace cascade {

namespace {

/// Species of more bytes are not copied for trial steps.
constexpr std::int64_t most_copied_bytes = std::int64_t{64} << 20;
/// The number of trial steps: at most a quarter of those before.
constexpr std::int64_t most_trial_steps = 8, least_trial_steps = 4;

/// Can the species be copied, and were there enough steps that a few more cost little?
bool allows_trial_steps(const EndedStage& ended) {
    const StageState& state = ended.state;
    Schedule schedule = ended.timer.schedule(state.steps, 1);
    schedule.most_kept_bytes = most_copied_bytes;
    const Environment& here = ended.view.environment();
    return !ended.view.stage().time.chooses_steps() && state.steps / 4 >= least_trial_steps &&
           keeps_copy(schedule, state.species.size(), here.grid, here.precision());
}

/// Takes `count` steps with `timer`; `observe` receives the state before the first and after each.
/// Returns false if a value was spoiled.
bool take_trial_steps(const EndedStage& ended, StageTimer& timer, std::int64_t count,
                      const Observer& observe) {
    StageState& state = ended.state;
    Schedule schedule = timer.schedule(state.steps, 1);
    schedule.last_step = state.steps + count;
    schedule.end_time = std::numeric_limits<double>::infinity();
    schedule.check = 0;
    schedule.ends = {};
    schedule.most_kept_bytes = 0;
    schedule.threads = ended.view.environment().tools.threads;
    // The last step of a duration may have been shorter.
    const double speed = state.numbers[ended.view.system().speed_item()];
    if (schedule.time.clock.step > 0) schedule.time.clock.set_step(state.steps, speed);

    const std::int64_t steps = state.steps;
    const double t = state.t;
    std::vector<Field> copies;
    for (const Field& field : state.species) copies.push_back(field.clone());
    bool is_finite = false;
    {
        const OtherSpecies trial(state, std::move(copies));
        observe(steps, t, state.species);
        RunControl unwatched;
        is_finite =
            !advance(timer.problem(), schedule, state.species, unwatched, {}, observe).not_finite;
    }
    state.go_to(steps, t);
    return is_finite;
}

/// The number of shorter steps that replace one in a check. Two would not be enough: a value that
/// repeats with the step often repeats with half of it, too.
constexpr std::int64_t shorter_steps = 3;

/// Do the steps of a stage depend on their number or length, or on chance? Shorter steps would then
/// be those of another stage.
bool knows_its_steps(const Program& program, std::uint32_t stage) {
    const System& system = program.system_of(stage);
    const auto knows = [&](const Node& node) {
        return is_draw(node) || node.is(Builtin::step) || node.is(system.speed_item());
    };
    return holds_in_rates(system, knows) || holds_in_sides(program.stages[stage], knows) ||
           std::any_of(system.invariants.begin(), system.invariants.end(),
                       [&](const Invariant& each) { return holds_in(each.bound, knows); });
}

/// Changes that steps cannot add to a species.
struct LostChange {
    double part = 0;  ///< The part of the cells whose rate is not 0 that a step does not change.
    double rate = 0;  ///< The sum of the magnitudes in such cells, over the number of all cells.
};

LostChange lost_change(const Field& species, const Field& rates, double step, const Mask* counted,
                       const Mask* frozen) {
    const auto &value = species.plane(), &rate = rates.plane();
    const auto length = static_cast<float>(step);
    double cells = 0, moving = 0, lost = 0, sum = 0;
    for_each_counted(value.layout(), counted, [&](std::int64_t row, std::int64_t i) {
        ++cells;
        const float change = length * rate.row(row)[i];
        if (change == 0 || (frozen != nullptr && frozen->row(row)[i] != 0)) return;
        ++moving;
        if (value.row(row)[i] + change != value.row(row)[i]) return;
        ++lost;
        sum += std::abs(double{rate.row(row)[i]});
    });
    if (moving == 0) return {};
    return {lost / moving, sum / cells};
}

/// a + factor · b.
Field sum(const Field& a, const Field& b, double factor) {
    Field result = a.clone();
    for_each_cell([&](float& value, float other) { value += static_cast<float>(factor * other); },
                  result.plane(), b);
    return result;
}

/// Detects values that jump back and forth in a few more steps.
std::optional<FlickerReport> find_flicker(const EndedStage& ended) {
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
    for (std::size_t s = 0; s < state.species.size(); ++s) {
        const FlickerWatch::Finding found = watch.finding(s);
        if (found.flickering < flicker_threshold && (is_random || found.undone < undone_threshold))
            continue;
        FlickerReport report;
        report.stage = view.stage().name;
        report.species = species_name(system, s);
        report.use = view.step_in_use();
        report.part = found.flickering;
        report.largest = found.largest;
        return report;
    }
    return std::nullopt;
}

/// Detects values that shorter steps would move differently.
std::optional<AstrayReport> find_astray(const EndedStage& ended) {
    const StageView& view = ended.view;
    const System& system = view.system();
    const Mask* counted = view.environment().counted();
    if (!view.stage().uniform[system.speed_item()] || is_stabilised(view.stage().time.solver) ||
        knows_its_steps(view.program(), view.number())) {
        return std::nullopt;
    }
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
    for (std::size_t s = 0; s < ended.state.species.size(); ++s) {
        const PathDifference found = difference(coarse, fine, s, counted);
        if (!found.is_apart) continue;
        AstrayReport report;
        report.stage = view.stage().name;
        report.species = species_name(system, s);
        report.use = view.step_in_use();
        report.steps = least_trial_steps;
        report.shorter_steps = least_trial_steps * shorter_steps;
        report.change = found.coarse;
        report.change_of_shorter = found.fine;
        report.apart = found.apart;
        return report;
    }
    return std::nullopt;
}

/// Does a species alternate from cell to cell because of its steps or its rate?
std::optional<std::string> find_chequerboard(const StageView& view, bool flickers) {
    const std::vector<Field>& species = view.state().species;
    const Environment& here = view.environment();
    const Links* links = here.model ? &here.model->cells->spread().links : nullptr;
    const StageTime& time = view.stage().time;
    const auto alternates = [&](const Field& field) {
        const auto k = static_cast<std::size_t>(&field - species.data());
        const StageCourse& course = view.state().course;
        const double once = course.empty() ? 0 : course.last().largest[k];
        if (alternating_part(field, here.counted(), links) < chequerboard_threshold) return false;
        // What has died away is rounding, or errors within the solver's tolerance, of which the
        // fastest waves may well be left.
        const FieldMoments values = moments(field, here.counted());
        const double errors =
            time.chooses_steps() ? time.step_tolerance() * values.root_mean_square : 0;
        return values.deviation > std::max(remaining_part * once, errors);
    };
    const auto found = std::find_if(species.begin(), species.end(), alternates);
    if (found == species.end()) return std::nullopt;
    ChequerboardReport report;
    report.stage = view.stage().name;
    report.species = species_name(view.system(), static_cast<std::size_t>(found - species.begin()));
    report.use = view.step_in_use();
    report.flickers = flickers;
    report.estimate = view.stability(species);
    report.use.diffusion_limits = view.diffusion_limits();
    return describe(report);
}

/// How fast the rates decay when the state moves along them, in 1 / time; negative if they grow.
double decay_along(const EndedStage& ended, const std::vector<Field>& rates) {
    const std::vector<Field>& species = ended.state.species;
    const Mask* counted = ended.view.environment().counted();
    // Far enough along the rates that differences are well above rounding.
    double step = std::numeric_limits<double>::infinity();
    for (std::size_t s = 0; s < species.size(); ++s) {
        const double largest = largest_magnitude(std::span(&rates[s], 1));
        if (largest > 0)
            step = std::min(step, 0.005 * root_mean_square(species[s], counted) / largest);
    }
    if (!std::isfinite(step) || !(step > 0)) return 0;
    std::vector<Field> moved;
    for (std::size_t s = 0; s < species.size(); ++s)
        moved.push_back(sum(species[s], rates[s], step));
    const std::vector<Field> there = [&] {
        const OtherSpecies other(ended.state, std::move(moved));
        return ended.view.rates();
    }();
    double products = 0, squares = 0;
    for (std::size_t s = 0; s < rates.size(); ++s) {
        const auto &here = rates[s].plane(), &then = there[s].plane();
        for_each_cell(
            [&](double rate, double other) {
                products += rate * (other - rate);
                squares += rate * rate;
            },
            here, then);
    }
    return squares > 0 ? -products / squares / step : 0;
}

/// Detects changes that single precision cannot add to the values, and that would have become
/// noticeable.
std::optional<LostChangeReport> find_lost_change(const EndedStage& ended) {
    const StageView& view = ended.view;
    const StageState& state = ended.state;
    const Mask* counted = view.environment().counted();
    const double step = state.time.clock.step;
    const auto steps = static_cast<double>(state.steps);
    // A step loses half of the last digit at most.
    const bool is_possible = view.environment().precision() == Precision::single &&
                             !is_adaptive(view.stage().time.solver) && step > 0 &&
                             steps * 0x1p-24 >= lost_change_threshold;
    if (!is_possible || holds_in_rates(view.system(), is_draw)) return std::nullopt;
    const std::vector<Field> rates = view.rates();
    const double decay = decay_along(ended, rates);
    const double time = decay * steps * step > 1 ? 1 / decay : steps * step;
    const Mask* frozen = state.frozen.empty() ? nullptr : &state.frozen;
    for (std::size_t s = 0; s < rates.size(); ++s) {
        const LostChange found = lost_change(state.species[s], rates[s], step, counted, frozen);
        const double value = root_mean_square(state.species[s], counted);
        if (found.part < 0.95 || !(found.rate * time >= lost_change_threshold * value)) continue;
        LostChangeReport report;
        report.stage = view.stage().name;
        report.species = species_name(view.system(), s);
        report.change = found.rate * step;
        report.value = value;
        report.lost = found.rate * time;
        return report;
    }
    return std::nullopt;
}

/// Computes the limit of the step. Without a regular oscillation, changes that undo each other may
/// be waves with a period of a few steps, so only a step beyond the limit is conclusive.
bool is_sure(const StageView& view, FlickerReport& report) {
    report.limit = longest_step(view.stability(view.state().species), report.use);
    if (!report.limit || !is_too_long(report.use, *report.limit)) {
        report.limit = longest_step(view.stability(view.starting_species()), report.use);
    }
    return report.part >= flicker_threshold ||
           (report.limit && is_too_long(report.use, *report.limit));
}

}  // namespace

std::optional<std::string> find_doubt(const EndedStage& ended) {
    const StageView& view = ended.view;
    for (const auto& [number, report] : *view.state().constraints) {
        const std::string& unknown = view.program().literals->constraint(number).unknown;
        if (auto doubt = describe(*report, unknown, view.stage().name)) return doubt;
    }
    const bool allows_trial = allows_trial_steps(ended);
    std::optional<FlickerReport> flicker;
    if (allows_trial) flicker = find_flicker(ended);
    if (auto chequerboard = find_chequerboard(view, flicker.has_value())) return chequerboard;
    if (flicker && is_sure(view, *flicker)) return describe(*flicker);
    if (auto astray = allows_trial ? find_astray(ended) : std::nullopt) {
        astray->limit = longest_step(view.stability(view.state().species), astray->use);
        return describe(*astray);
    }
    if (const auto lost = find_lost_change(ended)) return describe(*lost);
    return std::nullopt;
}

}  // namespace cascade

// What the result of a stage says about itself: signs that it is wrong although all values are
// finite.
#include "core/spread.h"
#include "lang/program/nodes_of_rates.h"
#include "run/simulation/simulation_implementation.h"
#include "run/stage/result_doubts.h"
#include "solvers/chequerboard.h"
#include "solvers/field_norms.h"
#include "solvers/flicker.h"
#include "solvers/step_paths.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cascade {

namespace {

/// Species of more bytes are not copied for a look.
constexpr std::int64_t most_copied_bytes = std::int64_t{64} << 20;
/// So many more steps are taken for a look, but no more than a quarter of those before.
constexpr std::int64_t most_steps = 8, least_steps = 4;
/// A species whose deviation is so many times that at the start owes its pattern to the stage.
constexpr double made_by_the_stage = 3;
/// The number of shorter steps that replace one for a look. Two would not do: what repeats with the
/// step often repeats with half of it, too.
constexpr std::int64_t shorter_steps = 3;

/// Do the steps of a stage depend on their number or length, or on chance? Then shorter ones are
/// another stage's.
bool knows_its_steps(const Program& program, std::uint32_t stage) {
    const System& system = program.system_of(stage);
    const auto knows = [&](const Node& node) {
        return is_draw(node) ||
               (node.kind == NodeKind::builtin &&
                node.index == static_cast<std::uint32_t>(Builtin::step)) ||
               (node.kind == NodeKind::own && node.index == system.speed_item());
    };
    return holds_in_rates(system, knows) || holds_in_sides(program.stages[stage], knows) ||
           std::any_of(system.invariants.begin(), system.invariants.end(),
                       [&](const Invariant& each) { return holds_in(each.bound, knows); });
}

/// What steps cannot add to a species.
struct LostChange {
    double part = 0;  ///< Of the cells whose rate is not 0, those that a step leaves as they are.
    double rate = 0;  ///< Mean magnitude in such cells, over all cells.
};

LostChange lost_change(const Field& species, const Field& rates, double step, const Mask* counted,
                       const Mask* frozen) {
    const auto &value = species.plane(), &rate = rates.plane();
    const PlaneLayout& layout = value.layout();
    const auto length = static_cast<float>(step);
    double cells = 0, moving = 0, lost = 0, sum = 0;
    for (std::int64_t row = 0; row < layout.row_count(); ++row) {
        for (std::int64_t i = 0; i < layout.width; ++i) {
            if (counted != nullptr && counted->row(row)[i] == 0) continue;
            ++cells;
            const float change = length * rate.row(row)[i];
            if (change == 0 || (frozen != nullptr && frozen->row(row)[i] != 0)) continue;
            ++moving;
            if (value.row(row)[i] + change != value.row(row)[i]) continue;
            ++lost;
            sum += std::abs(double{rate.row(row)[i]});
        }
    }
    if (moving == 0) return {};
    return {lost / moving, sum / cells};
}

/// a + factor · b.
Field sum(const Field& a, const Field& b, double factor) {
    Field result = a.clone();
    auto& values = result.plane();
    for (std::int64_t row = 0; row < values.layout().row_count(); ++row) {
        for (std::int64_t i = 0; i < values.layout().width; ++i) {
            values.row(row)[i] += static_cast<float>(factor * b.row(row)[i]);
        }
    }
    return result;
}

}  // namespace

bool Simulation::Implementation::take_trial_steps(std::uint32_t k, StageTimer& timer,
                                                  std::int64_t count, const Observer& observe) {
    StageState& state = states[k];
    Schedule schedule = timer.schedule(state.steps, 1);
    schedule.last_step = state.steps + count;
    schedule.end_time = std::numeric_limits<double>::infinity();
    schedule.check = 0;
    schedule.ends = {};
    schedule.most_kept_bytes = 0;
    schedule.threads = threads;
    // The last step of a duration may have been a shorter one.
    const double speed = state.numbers[program->system_of(k).speed_item()];
    if (schedule.time.clock.step > 0) schedule.time.clock.set_step(state.steps, speed);

    std::vector<Field> result;
    for (const Field& field : state.species) result.push_back(field.clone());
    const std::int64_t steps = state.steps;
    const double t = state.t;
    observe(steps, t, state.species);
    RunControl unwatched;
    const StageOutcome outcome =
        advance(timer.problem(), schedule, state.species, unwatched, {}, observe);
    state.species = std::move(result);
    state.steps = steps;
    state.t = t;
    return !outcome.not_finite;
}

bool Simulation::Implementation::allows_trial_steps(std::uint32_t k, StageTimer& timer) const {
    Schedule schedule = timer.schedule(states[k].steps, 1);
    schedule.most_kept_bytes = most_copied_bytes;
    return !stage(k).time.chooses_steps() && states[k].steps / 4 >= least_steps &&
           keeps_copy(schedule, states[k].species.size(), grid, precision());
}

std::optional<FlickerReport> Simulation::Implementation::find_flicker(std::uint32_t k,
                                                                      StageTimer& timer) {
    const StageState& state = states[k];
    FlickerWatch watch(counted());
    const bool is_finite =
        take_trial_steps(k, timer, std::min(most_steps, state.steps / 4),
                         [&](std::int64_t, double, std::span<const Field> species) {
                             watch.see(species);
                             return true;
                         });
    if (!is_finite) return std::nullopt;

    const System& system = program->system_of(k);
    const bool is_random = holds_in_rates(system, is_draw);
    for (std::size_t s = 0; s < state.species.size(); ++s) {
        const FlickerWatch::Finding found = watch.finding(s);
        if (found.flickering < flicker_threshold && (is_random || found.undone < undone_threshold))
            continue;
        FlickerReport report;
        report.stage = stage(k).name;
        report.species = species_name(system, s);
        report.use = step_in_use(k);
        report.part = found.flickering;
        report.largest = found.largest;
        return report;
    }
    return std::nullopt;
}

std::optional<AstrayReport> Simulation::Implementation::find_astray(std::uint32_t k,
                                                                    StageTimer& timer) {
    const System& system = program->system_of(k);
    if (!stage(k).uniform[system.speed_item()] || is_stabilised(stage(k).time.solver) ||
        knows_its_steps(*program, k)) {
        return std::nullopt;
    }
    const auto follow = [&](StageTimer& own, std::int64_t steps, StepPath& path) {
        return take_trial_steps(k, own, steps,
                                [&](std::int64_t, double, std::span<const Field> species) {
                                    path.see(species);
                                    return true;
                                });
    };
    StepPath coarse(counted()), fine(counted());
    if (!follow(timer, least_steps, coarse)) return std::nullopt;
    double& speed = states[k].numbers[system.speed_item()];
    const double own_speed = std::exchange(speed, speed / shorter_steps);
    StageTimer shorter(*program, k, states[k], tools(k, often()));
    const bool is_finite = follow(shorter, least_steps * shorter_steps, fine);
    speed = own_speed;
    if (!is_finite) return std::nullopt;
    for (std::size_t s = 0; s < states[k].species.size(); ++s) {
        const PathDifference found = difference(coarse, fine, s, counted());
        if (!found.is_apart) continue;
        AstrayReport report;
        report.stage = stage(k).name;
        report.species = species_name(system, s);
        report.use = step_in_use(k);
        report.steps = least_steps;
        report.shorter_steps = least_steps * shorter_steps;
        report.change = found.coarse;
        report.change_of_shorter = found.fine;
        report.apart = found.apart;
        return report;
    }
    return std::nullopt;
}

StabilityEstimate Simulation::Implementation::stability_at_start(std::uint32_t k) {
    std::vector<Field> result(states[k].species.size());
    result.swap(states[k].species);
    start_varying_items(k);
    const StabilityEstimate estimate = stability(k, states[k].species);
    states[k].species = std::move(result);
    return estimate;
}

std::optional<std::string> Simulation::Implementation::find_chequerboard(std::uint32_t k,
                                                                         bool flickers) const {
    const std::vector<Field>& species = states[k].species;
    const Links* links = model ? &model->links : nullptr;
    const StageTime& time = stage(k).time;
    const auto alternates = [&](const Field& field) {
        // What has died away is rounding, or errors that the solver was allowed, of which the
        // fastest waves may well be left.
        const FieldMoments values = moments(field, counted());
        const double errors =
            time.chooses_steps() ? time.step_tolerance() * values.root_mean_square : 0;
        return values.deviation > std::max(least_deviation, errors) &&
               alternating_part(field, counted(), links) >= chequerboard_threshold;
    };
    const auto found = std::find_if(species.begin(), species.end(), alternates);
    if (found == species.end()) return std::nullopt;
    ChequerboardReport report;
    report.stage = stage(k).name;
    report.species =
        species_name(program->system_of(k), static_cast<std::size_t>(found - species.begin()));
    report.use = step_in_use(k);
    report.flickers = flickers;
    report.estimate = stability(k, species);
    report.use.diffusion_limits = diffusion_limits(k);
    return describe(report);
}

std::optional<LostChangeReport> Simulation::Implementation::find_lost_change(std::uint32_t k) {
    StageState& state = states[k];
    const double step = state.time.clock.step;
    const auto steps = static_cast<double>(state.steps);
    // A step loses half of the last digit at most.
    const bool is_possible = precision() == Precision::single &&
                             !is_adaptive(stage(k).time.solver) && step > 0 &&
                             steps * 0x1p-24 >= lost_change_threshold;
    if (!is_possible || holds_in_rates(program->system_of(k), is_draw)) return std::nullopt;
    const std::vector<Field> rates = evaluate(plan_rates(*program, k), k);
    const double decay = decay_along(k, rates);
    const double time = decay * steps * step > 1 ? 1 / decay : steps * step;
    const Mask* frozen = state.frozen.empty() ? nullptr : &state.frozen;
    for (std::size_t s = 0; s < rates.size(); ++s) {
        const LostChange found = lost_change(state.species[s], rates[s], step, counted(), frozen);
        const double value = moments(state.species[s], counted()).root_mean_square;
        if (found.part < 0.95 || !(found.rate * time >= lost_change_threshold * value)) continue;
        LostChangeReport report;
        report.stage = stage(k).name;
        report.species = species_name(program->system_of(k), s);
        report.change = found.rate * step;
        report.value = value;
        report.lost = found.rate * time;
        return report;
    }
    return std::nullopt;
}

double Simulation::Implementation::decay_along(std::uint32_t k, const std::vector<Field>& rates) {
    std::vector<Field>& species = states[k].species;
    // So far along the rates that differences are well above rounding.
    double step = std::numeric_limits<double>::infinity();
    for (std::size_t s = 0; s < species.size(); ++s) {
        const double largest = largest_magnitude(std::span(&rates[s], 1));
        if (largest > 0)
            step =
                std::min(step, 0.005 * moments(species[s], counted()).root_mean_square / largest);
    }
    if (!std::isfinite(step) || !(step > 0)) return 0;
    std::vector<Field> moved;
    for (std::size_t s = 0; s < species.size(); ++s)
        moved.push_back(sum(species[s], rates[s], step));
    moved.swap(species);
    const std::vector<Field> there = evaluate(plan_rates(*program, k), k);
    species = std::move(moved);
    double products = 0, squares = 0;
    for (std::size_t s = 0; s < species.size(); ++s) {
        const auto &here = rates[s].plane(), &then = there[s].plane();
        for (std::int64_t row = 0; row < here.layout().row_count(); ++row) {
            for (std::int64_t i = 0; i < here.layout().width; ++i) {
                const double rate = here.row(row)[i];
                products += rate * (then.row(row)[i] - rate);
                squares += rate * rate;
            }
        }
    }
    return squares > 0 ? -products / squares / step : 0;
}

bool Simulation::Implementation::has_stood_still(std::uint32_t k) const {
    const StageState& state = states[k];
    const StageCourse& course = state.course;
    if (!state.done || course.empty() || course.last().step != state.steps) return false;
    const auto is_same = [](const Spread& a, const Spread& b) {
        return a.mean == b.mean && a.squares == b.squares && a.smallest == b.smallest &&
               a.largest == b.largest;
    };
    const auto& first = course.first().species;
    if (!std::equal(first.begin(), first.end(), course.last().species.begin(), is_same))
        return false;
    const std::vector<Field> rates = evaluate(plan_rates(*program, k), k);
    return std::all_of(rates.begin(), rates.end(), [&](const Field& rate) {
        return moments(rate, counted()).root_mean_square == 0;
    });
}

bool Simulation::made_its_pattern(std::uint32_t k) const {
    const Stage& stage = program().stages[k];
    const System& system = program().system_of(k);
    const auto is_of_neighbours = [](const Node& node) {
        return node.kind == NodeKind::call && differentiates(node.function);
    };
    for (std::uint32_t item = 0; item < system.quantities.size(); ++item) {
        if (!system.is_species(item) && !stage.uniform[item]) return false;
    }
    if (holds_in_rates(system, is_draw) || !holds_in_rates(system, is_of_neighbours)) return false;
    const StageCourse& course = state(k).course;
    if (course.empty()) return false;
    const auto is_made = [](const Spread& first, const Spread& last) {
        return last.is_even() || last.deviation() >= made_by_the_stage * first.deviation();
    };
    const auto& first = course.first().species;
    return std::equal(first.begin(), first.end(), course.last().species.begin(), is_made);
}

bool Simulation::Implementation::is_sure(std::uint32_t k, FlickerReport& report) {
    report.limit = longest_step(stability(k, states[k].species), report.use);
    if (!report.limit || !is_too_long(report.use, *report.limit)) {
        report.limit = longest_step(stability_at_start(k), report.use);
    }
    return report.part >= flicker_threshold ||
           (report.limit && is_too_long(report.use, *report.limit));
}

void Simulation::Implementation::warn_of_doubts(std::uint32_t k, StageTimer& timer,
                                                RunControl& control) {
    if (!control.warn || states[k].steps == 0) return;
    const auto warn = [&](const std::string& doubt) {
        control.warn(doubt);
        states[k].course = {};
    };
    const bool allows_trial = allows_trial_steps(k, timer);
    std::optional<FlickerReport> flicker;
    if (allows_trial) flicker = find_flicker(k, timer);
    if (const auto chequerboard = find_chequerboard(k, flicker.has_value())) {
        warn(*chequerboard);
    } else if (flicker && is_sure(k, *flicker)) {
        warn(describe(*flicker));
    } else if (auto astray = allows_trial ? find_astray(k, timer) : std::nullopt) {
        astray->limit = longest_step(stability(k, states[k].species), astray->use);
        warn(describe(*astray));
    } else if (const auto lost = find_lost_change(k)) {
        warn(describe(*lost));
    }
}

}  // namespace cascade

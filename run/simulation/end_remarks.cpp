// Each kind of stage has a list of remarks. The first remark of the list that applies is returned.
#include "run/simulation/end_remarks.h"

#include "core/counted_cells.h"
#include "core/with_commas.h"
#include "ir/solver.h"
#include "lang/program/nodes_of_rates.h"
#include "run/simulation/diagnosis.h"
#include "run/simulation/thin_fronts.h"
#include "run/simulation/stage_view.h"
#include "run/stage/bound_kernel.h"
#include "solvers/field_norms.h"
#include "tissue/tissue.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace cascade {

namespace {

/// A stage about which a remark may be made.
struct Ended {
    StageView view;
    bool is_last;  ///< Whether no later stage takes a step.

    const Stage& stage() const { return view.stage(); }
    const System& system() const { return view.system(); }
    const StageState& state() const { return view.state(); }
    const StageCourse& course() const { return state().course; }
    template <typename... Values>
    std::string about(fmt::format_string<Values...> words, Values&&... values) const {
        return fmt::format("stage '{}' {}", stage().name,
                           fmt::format(words, std::forward<Values>(values)...));
    }
};

bool took_steps(const Ended& ended) { return ended.state().done && ended.state().steps > 0; }

/// Whether the course of the stage has been recorded up to the stage's end.
bool was_watched(const Ended& ended) {
    const StageState& state = ended.state();
    return state.done && !state.course.empty() && state.course.last().step == state.steps;
}

bool was_watched_in_steps(const Ended& ended) { return took_steps(ended) && was_watched(ended); }

/// Returns the trend of the last stage. For earlier stages, returns no trend, because users often
/// end them early on purpose.
Trend trend_of(const Ended& ended) {
    const bool is_meant = !ended.is_last || ended.state().condition_met;
    return is_meant ? Trend::none : ended.course().trend();
}

/// Whether every parameter is the same in all cells.
bool is_uniform_in_space(const Stage& stage, const System& system) {
    return std::ranges::all_of(system.quantities.ids(), [&](ItemId item) {
        return system.is_species(item) || stage.uniform[item];
    });
}

/// Returns the fraction of the cells in which `mask` is not 0. Only the cells `inside` count. If
/// that is null, all cells count.
double part_of_ones(const Mask& mask, const Mask* inside) {
    double ones = 0, cells = 0;
    for_each_counted(mask.layout(), inside, [&](std::int64_t row, std::int64_t i) {
        ++cells;
        if (mask.row(row)[i] != 0) ++ones;
    });
    return cells > 0 ? ones / cells : 0;
}

double frozen_part(const Ended& ended) {
    const ItemId frozen = ended.system().frozen_item();
    if (ended.stage().uniform[frozen]) return ended.state().numbers[frozen] != 0 ? 1 : 0;
    return part_of_ones(ended.state().frozen(), ended.view.environment().counted());
}

std::string describe_frozen(const Ended& ended) {
    if (frozen_part(ended) != 1) return {};
    return ended.about("is frozen in all cells: nothing in it changes");
}

std::string describe_frozen_nowhere(const Ended& ended) {
    const bool varies = !ended.stage().uniform[ended.system().frozen_item()];
    if (!varies || frozen_part(ended) != 0) return {};
    return ended.about("has no frozen cell: its 'frozen' is true nowhere");
}

/// The largest number of species that a remark names.
constexpr std::size_t most_named = 4;
/// If the cells of a stage once differed by at least this fraction of a species' largest magnitude,
/// the stage had a pattern, and not only noise that could grow into a pattern.
constexpr double contrast_of_a_pattern = 0.05;

/// Lists the values of a uniform state: "u = 1, v = 0".
std::string values_of(const System& system, const Moment& moment) {
    std::string text;
    for (std::size_t k = 0; k < moment.species.size() && k < most_named; ++k) {
        text += fmt::format("{}{} = {:.4g}", k > 0 ? ", " : "", species_name(system, k),
                            moment.species[k].mean);
    }
    return text + (moment.species.size() > most_named ? ", …" : "");
}

std::string describe_uniform(const Ended& ended) {
    if (!ended.course().ended_uniform()) return {};
    const System& system = ended.system();
    const StageCourse& course = ended.course();
    const std::string values = values_of(system, course.last());
    const Moment& since = course.uniform_since();
    const bool is_the_same = std::ranges::all_of(course.last().species, &Spread::is_one_number);
    if (since.step == course.first().step && is_the_same &&
        is_uniform_in_space(ended.stage(), system)) {
        return ended.about(
            "ended uniform ({}), with all cells the same: add noise or a spot to a starting value",
            values);
    }
    const std::string step = with_commas(since.step);
    if (since.step == course.first().step) {
        return ended.about("ended uniform ({}): {}nothing has grown", values,
                           is_the_same
                               ? ""
                               : "its cells differ by less than a 100,000th of their values, and ");
    }
    if (course.greatest_contrast() >= contrast_of_a_pattern) {
        return ended.about("died out: it has been uniform since step {} or before ({})", step,
                           values);
    }
    return ended.about(
        "ended uniform ({}): the differences at its start have faded, and it has been uniform "
        "since step {} or before",
        values, step);
}

std::string describe_until(const Ended& ended) {
    const StageState& state = ended.state();
    const StageTime& time = ended.stage().time;
    if (!(time.until || time.steady) || state.condition_met) return {};
    if (time.steps_between_looks() > state.steps) {
        return ended.about(
            "took {} steps and never evaluated 'until', because this happens only every {} steps "
            "('check')",
            with_commas(state.steps), with_commas(time.steps_between_looks()));
    }
    if (!time.steady) {
        return ended.about("took {} steps, and 'until' was never true", with_commas(state.steps));
    }
    return ended.about("took {} steps and has not settled as 'until: steady({:.4g})' requires",
                       with_commas(state.steps), *time.steady);
}

/// Describes the accumulated errors of steps of first order. Returns an empty string if the errors
/// are small or the steps are not of first order.
std::string errors_in_words(const Stage& stage, const StageCourse& course) {
    const Solver solver = stage.time.solver;
    // Errors are measured relative to the differences between cells. If values hardly differ
    // between cells, these errors may be five times as large.
    const double least_errors = is_semi_implicit(solver) ? 0.01 : 0.004;
    if (!stage.time.chooses_steps() || order_of(solver) > 1 || course.errors() < least_errors) {
        return {};
    }
    return fmt::format(
        "made errors in its time steps, estimated at {:.2g} % of the differences between its "
        "cells; 'solver: {}' makes smaller errors",
        100 * course.errors(), is_semi_implicit(solver) ? "etdrk4" : "rkl2");
}

std::string describe_errors(const Ended& ended) {
    const std::string words = errors_in_words(ended.stage(), ended.course());
    return words.empty() ? "" : ended.about("{}", words);
}

/// Describes the growth of the species whose deviation rises fastest.
std::string describe_growth(const Ended& ended) {
    if (trend_of(ended) != Trend::growing) return {};
    const StageCourse& course = ended.course();
    std::size_t fastest = 0;
    double growth = 0;
    for (std::size_t k = 0; k < course.last().species.size(); ++k) {
        if (!(course.growth(k) > growth)) continue;
        fastest = k;
        growth = course.growth(k);
    }
    const std::string errors = errors_in_words(ended.stage(), course);
    return ended.about(
        "was still growing when it ended: the deviation of {} rose by {:.0f} % in the last tenth "
        "of the stage, to {:.2g}; more steps would change the picture{}",
        species_name(ended.system(), fastest), 100 * growth,
        course.last().species[fastest].deviation(), errors.empty() ? "" : "; it " + errors);
}

/// Describes a stage in which the cells of every species differ by less than the tolerance of a
/// step.
std::string describe_tolerance(const Ended& ended) {
    const StageTime& time = ended.stage().time;
    const auto is_within = [&](const Spread& spread) {
        return spread.deviation() < time.step_tolerance() * spread.magnitude();
    };
    if (!time.chooses_steps() || !std::ranges::all_of(ended.course().last().species, is_within))
        return {};
    return ended.about(
        "ended almost uniform: its cells differ by less than {:.2g} of their values, which is the "
        "tolerance of its steps",
        time.step_tolerance());
}

std::string describe_fading(const Ended& ended) {
    if (trend_of(ended) != Trend::fading) return {};
    const System& system = ended.system();
    const StageCourse& course = ended.course();
    std::string rest;
    for (std::size_t k = 0; k < course.last().species.size() && k < most_named; ++k) {
        const Spread& spread = course.last().species[k];
        rest += fmt::format("{}{} {:.2g} about {:.3g}", k > 0 ? ", " : "", species_name(system, k),
                            spread.deviation(), spread.mean);
    }
    return ended.about(
        "is dying out: the remaining differences between its cells are small and "
        "shrinking ({})",
        rest);
}

/// Describes a stage that has kept its starting values because its rates are 0 everywhere.
std::string describe_standstill(const Ended& ended) {
    const StageCourse& course = ended.course();
    const auto is_same = [](const Spread& a, const Spread& b) {
        return a.mean == b.mean && a.squares == b.squares && a.smallest == b.smallest &&
               a.largest == b.largest;
    };
    const auto& first = course.first().species;
    if (!std::equal(first.begin(), first.end(), course.last().species.begin(), is_same)) return {};
    const Environment& here = ended.view.environment();
    const auto is_0 = [&](const Field& rate) {
        return root_mean_square(rate, here.counted()) == 0;
    };
    if (!std::ranges::all_of(ended.view.rates(), is_0)) return {};
    return ended.about("ended as it began: its rates are 0 in all cells{}",
                       here.grid.height == 1 && !here.model
                           ? "; on a line derivatives along y are 0"
                           : "");
}

bool is_of_neighbours(const Node& node) { return node.is<Call>() && differentiates(node.function); }

/// Whether only the grid could have made the fronts of this stage stand still. False if the result
/// of the stage depends on positions, random numbers, earlier stages, frozen cells, a mask or a
/// model, or if `speed` or a parameter varies by cell.
bool may_be_pinned(const Ended& ended) {
    const StageView& view = ended.view;
    const StageState& state = view.state();
    const System& system = view.system();
    const Environment& here = view.environment();
    if (here.model || here.counted() != nullptr || !state.frozen().empty()) return false;
    if (!was_watched(ended)) return false;
    if (!view.stage().uniform[system.speed_item()] || !system.invariants.empty()) return false;
    if (!is_uniform_in_space(view.stage(), system)) return false;
    const auto is_place = [](const Node& node) {
        return is_draw(node) || (node.is<Builtin>() && !is_moment(node)) || node.is<StageItem>();
    };
    return !holds_in_rates(system, is_place) && holds_in_rates(system, is_of_neighbours);
}

/// A front stands still if it would move by fewer cells than this during the whole stage.
constexpr double least_way = 0.5;

/// Makes a remark if almost all fronts of a species are thinner than a cell and do not move.
std::string describe_pinned_fronts(const Ended& ended) {
    const StageView& view = ended.view;
    const StageState& state = view.state();
    for (std::size_t k = 0; k < state.species().size(); ++k) {
        const Spread& spread = state.course.last().species[k];
        if (spread.is_uniform()) continue;
        if (!fronts_of(state.species()[k], nullptr, spread).are_thin()) continue;
        const std::vector<Field> rates = view.rates();
        const Fronts fronts = fronts_of(state.species()[k], &rates[k], spread);
        if (!(fronts.speed / fronts.thin * state.t < least_way)) continue;
        return fmt::format(
            "stage '{}': the fronts of {} are thinner than a cell and stand still: the grid may "
            "hold them in place; a smaller 'spacing' would show whether they move",
            view.stage().name, species_name(view.system(), k));
    }
    return {};
}

constexpr Diagnosis<Ended> remarks_on_fields[] = {
    {took_steps, describe_frozen},
    {was_watched_in_steps, describe_uniform},
    {was_watched_in_steps, describe_until},
    {was_watched_in_steps, describe_growth},
    {was_watched_in_steps, describe_tolerance},
    {was_watched_in_steps, describe_fading},
    {was_watched_in_steps, describe_errors},
    {was_watched_in_steps, describe_frozen_nowhere},
    {was_watched, describe_standstill},
    {may_be_pinned, describe_pinned_fronts},
};

// The following functions describe stages of cells that crawl.

bool is_frozen(const Ended& ended) {
    const Tissue& tissue = *ended.state().tissue();
    return ended.view.is_frozen() || (tissue.count() > 0 && tissue.is_frozen());
}

bool has_died_out(const Ended& ended) { return ended.state().tissue()->count() == 0; }

bool has_missed_its_condition(const Ended& ended) {
    const StageTime& time = ended.stage().time;
    return (time.until || time.steady) && !ended.state().condition_met && !time.duration;
}

constexpr Diagnosis<Ended> remarks_on_cells[] = {
    {is_frozen,
     [](const Ended& ended) {
         return ended.about("is frozen in all cells: nothing in it changes");
     }},
    {has_died_out,
     [](const Ended& ended) {
         return fmt::format("all cells of stage '{}' have died, the last at t = {:.4g}",
                            ended.stage().name, ended.state().tissue()->time.last_event);
     }},
    {has_missed_its_condition,
     [](const Ended& ended) {
         return fmt::format("'until' of stage '{}' was never true in {} steps up to t = {:.4g}",
                            ended.stage().name, ended.state().steps, ended.state().t);
     }},
};

}  // namespace

std::string remark_on(const Simulation& simulation, std::uint32_t k) {
    const StageView view = simulation.own_view(k);
    const Ended ended{view, k == view.environment().script.final_stage()};
    return view.state().tissue() != nullptr ? first_of<Ended>(remarks_on_cells, ended)
                                            : first_of<Ended>(remarks_on_fields, ended);
}

bool made_its_pattern(const Simulation& simulation, std::uint32_t k) {
    // The stage has made the pattern of a species if the species' deviation has grown by this
    // factor.
    constexpr double times_at_start = 3;
    const Stage& stage = simulation.domain().stage(k);
    const System& system = simulation.domain().program->system_of(k);
    if (system.cells) return false;
    if (!is_uniform_in_space(stage, system) || holds_in_rates(system, is_draw) ||
        !holds_in_rates(system, is_of_neighbours)) {
        return false;
    }
    const StageCourse& course = simulation.state(k).course;
    if (course.empty()) return false;
    for (std::size_t s = 0; s < course.last().species.size(); ++s) {
        const Spread &first = course.first().species[s], &last = course.last().species[s];
        const bool is_made = last.is_uniform(course.last().largest[s]) ||
                             last.deviation() >= times_at_start * first.deviation();
        if (!is_made) return false;
    }
    return true;
}

}  // namespace cascade

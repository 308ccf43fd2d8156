// The first remark that applies is made: frozen, even, not ended by 'until', growing, fading, of
// large errors.
#include "run/stage/stage_remarks.h"

#include "core/counted_cells.h"
#include "core/with_commas.h"
#include "ir/solver.h"
#include "run/stage/bound_kernel.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace cascade {

namespace {

/// If there are more species, only this number of them are named.
constexpr std::size_t most_named = 4;
/// A stage whose cells once differed by this part of a species' largest value had a pattern, and
/// not only noise that could grow into one.
constexpr double contrast_of_a_pattern = 0.05;

/// "u = 1, v = 0".
std::string values_of(const System& system, const Moment& moment) {
    std::string text;
    for (std::size_t k = 0; k < moment.species.size() && k < most_named; ++k) {
        text += fmt::format("{}{} = {:.4g}", k > 0 ? ", " : "", species_name(system, k),
                            moment.species[k].mean);
    }
    return text + (moment.species.size() > most_named ? ", …" : "");
}

std::string describe_even(const Stage& stage, const System& system, const StageCourse& course) {
    const std::string values = values_of(system, course.last());
    const Moment& since = course.even_since();
    bool is_the_same = true;
    for (const Spread& spread : course.last().species)
        is_the_same = is_the_same && spread.is_one_number();
    bool parameters_are = true;
    for (const ItemId item : system.quantities.ids()) {
        parameters_are = parameters_are && (system.is_species(item) || stage.uniform[item]);
    }
    if (since.step == course.first().step && is_the_same && parameters_are) {
        return fmt::format(
            "ended even ({}): all cells are the same; noise or a spot in a starting value would "
            "make them differ",
            values);
    }
    const std::string step = with_commas(since.step);
    if (since.step == course.first().step) {
        return fmt::format("ended even ({}): {}nothing has grown", values,
                           is_the_same ? ""
                                       : "its cells differ by less than a 100,000th of their "
                                         "values, and ");
    }
    if (course.greatest_contrast() >= contrast_of_a_pattern) {
        return fmt::format("died out: it is even since step {} or before ({})", step, values);
    }
    return fmt::format(
        "ended even ({}): the differences it began with faded, and nothing has grown; "
        "it is even since step {} or before",
        values, step);
}

/// The part of the cells in which a mask is 1.
double part_of_ones(const Mask& mask, const Mask* inside) {
    double ones = 0, cells = 0;
    for_each_counted(mask.layout(), inside, [&](std::int64_t row, std::int64_t i) {
        ++cells;
        if (mask.row(row)[i] != 0) ++ones;
    });
    return cells > 0 ? ones / cells : 0;
}

/// Do the cells of all species differ by no more than the tolerance of a step?
bool differs_by_errors_alone(const Stage& stage, const StageCourse& course) {
    const auto& species = course.last().species;
    return std::all_of(species.begin(), species.end(), [&](const Spread& spread) {
        return spread.deviation() < stage.time.step_tolerance() * spread.magnitude();
    });
}

/// The species whose deviation rises fastest.
std::string describe_growth(const System& system, const StageCourse& course) {
    std::size_t fastest = 0;
    double growth = 0;
    for (std::size_t k = 0; k < course.last().species.size(); ++k) {
        if (!(course.growth(k) > growth)) continue;
        fastest = k;
        growth = course.growth(k);
    }
    return fmt::format(
        "was still growing when it ended: the deviation of {} rose by {:.0f} % in the "
        "last tenth, to {:.2g}; more steps would change the picture",
        species_name(system, fastest), 100 * growth, course.last().species[fastest].deviation());
}

/// Steps of first order whose errors add up, or nothing.
std::string describe_errors(const Stage& stage, const StageCourse& course) {
    constexpr double least_errors = 0.01;
    const Solver solver = stage.time.solver;
    if (!stage.time.chooses_steps() || order_of(solver) > 1 || course.errors() < least_errors) {
        return {};
    }
    return fmt::format(
        "took steps of first order whose estimated errors add up to {:.0f} % of the differences "
        "between its cells; solver: {} has smaller ones",
        100 * course.errors(), is_semi_implicit(solver) ? "etdrk4" : "rkl2");
}

std::string describe_fading(const System& system, const StageCourse& course) {
    std::string rest;
    for (std::size_t k = 0; k < course.last().species.size() && k < most_named; ++k) {
        const Spread& spread = course.last().species[k];
        rest += fmt::format("{}{} {:.2g} about {:.3g}", k > 0 ? ", " : "", species_name(system, k),
                            spread.deviation(), spread.mean);
    }
    return fmt::format("is dying out: the deviations left are small and falling ({})", rest);
}

std::string describe_until(const Stage& stage, const StageState& state) {
    if (stage.time.steps_between_looks() > state.steps) {
        return fmt::format(
            "took {} steps and never evaluated 'until', which it does every {} steps ('check')",
            with_commas(state.steps), with_commas(stage.time.steps_between_looks()));
    }
    if (!stage.time.steady) {
        return fmt::format("took {} steps and 'until' has not ended it", with_commas(state.steps));
    }
    return fmt::format("took {} steps and has not settled as 'until: steady({:.4g})' asks",
                       with_commas(state.steps), *stage.time.steady);
}

}  // namespace

std::string describe_end(const Stage& stage, const System& system, const StageState& state,
                         bool is_last, const Mask* inside) {
    if (!state.done || state.steps == 0) return {};
    const auto about = [&](const std::string& words) {
        return fmt::format("stage '{}' {}", stage.name, words);
    };
    const ItemId frozen = system.frozen_item();
    const double frozen_part = stage.uniform[frozen] ? (state.numbers[frozen] != 0 ? 1 : 0)
                                                     : part_of_ones(state.frozen, inside);
    if (frozen_part == 1) return about("is frozen in all cells: nothing in it changes");
    const StageCourse& course = state.course;
    if (course.empty() || course.last().step != state.steps) return {};
    if (course.ended_even()) return about(describe_even(stage, system, course));
    if ((stage.time.until || stage.time.steady) && !state.condition_met) {
        return about(describe_until(stage, state));
    }
    const Trend trend = is_last && !state.condition_met ? course.trend() : Trend::none;
    const std::string errors = describe_errors(stage, course);
    if (trend == Trend::growing) {
        return about(describe_growth(system, course) + (errors.empty() ? "" : "; it " + errors));
    }
    if (stage.time.chooses_steps() && differs_by_errors_alone(stage, course)) {
        return about(fmt::format(
            "ended almost even: its cells differ by less than {:.2g} of their values, which is the "
            "tolerance of its steps",
            stage.time.step_tolerance()));
    }
    if (trend == Trend::fading) return about(describe_fading(system, course));
    if (!errors.empty()) return about(errors);
    if (!stage.uniform[frozen] && frozen_part == 0) {
        return about("is frozen in no cell: its 'frozen' is true nowhere");
    }
    return {};
}

}  // namespace cascade

// Compares the rates, over the time in which they decay, with the spacing of floating-point numbers
// around the values.
#include "run/simulation/lost_changes.h"

#include "core/counted_cells.h"
#include "core/spread.h"
#include "lang/program/nodes_of_rates.h"
#include "run/stage/bound_kernel.h"
#include "run/stage/not_finite.h"
#include "solvers/field_norms.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace cascade {
namespace {

/// A warning is given if the lost changes are at least this fraction of the values.
constexpr double lost_change_threshold = 0.01;
/// Rounding may move a pattern at rest by this fraction of its values, so smaller changes are not
/// noticed.
constexpr double least_noticed = 5e-6;
/// A change is noticed if it is at least this fraction of the differences between cells.
constexpr double part_of_differences = 0.1;
/// A pattern is fading if less than this fraction of the differences at the start of a stage is
/// left.
constexpr double least_contrast_left = 0.1;

/// The changes of a species that are so small that adding them has no effect.
struct LostChange {
    /// The number of cells that a step does not change, although their rate is not 0, divided by
    /// the number of all cells with a rate that is not 0.
    double part = 0;
    /// The sum of |rate| over the cells that a step does not change, divided by the number of all
    /// cells.
    double rate = 0;
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

/// Returns a + factor · b.
Field sum(const Field& a, const Field& b, double factor) {
    Field result = a.clone();
    for_each_cell([&](float& value, float other) { value += static_cast<float>(factor * other); },
                  result.plane(), b);
    return result;
}

/// Returns how fast rates decay when the state moves in the direction of the rates, in 1 / time.
/// The result is negative if rates grow.
double decay_along(const EndedStage& ended, const std::vector<Field>& rates) {
    const std::vector<Field>& species = ended.state.species();
    const Mask* counted = ended.view.environment().counted();
    // The length of a step in the direction of the rates, which must be so long that differences
    // are well above rounding errors.
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

/// Returns the smallest change of a species that is noticed. Usually it is a tenth of the
/// differences between cells. If values are uniform, or if a fading pattern is almost gone, it is a
/// hundredth of the values.
double noticed_change(const StageState& state, std::size_t species, const FieldMoments& values) {
    const double value = values.root_mean_square;
    const StageCourse& course = state.course;
    const double once = course.empty() ? 0 : course.first().species[species].deviation();
    const bool is_uniform =
        !(values.deviation > std::max(uniform_deviation * value, least_contrast_left * once));
    if (is_uniform) return lost_change_threshold * value;
    return std::max(part_of_differences * values.deviation, least_noticed * value);
}

}  // namespace

bool could_lose_changes(const StageView& view) {
    const StageState& state = view.state();
    // Rounding a step loses at most half of the last binary digit.
    const double most_lost = static_cast<double>(state.steps) * 0x1p-24;
    const auto may_be_noticed = [&](const Field& species) {
        const auto s = static_cast<std::size_t>(&species - state.species().data());
        const FieldMoments values = moments(species, view.environment().counted());
        return most_lost * values.root_mean_square >= noticed_change(state, s, values);
    };
    return view.environment().precision() == Precision::single &&
           !is_adaptive(view.stage().time.solver) && state.time.clock.step > 0 &&
           most_lost >= least_noticed &&
           std::any_of(state.species().begin(), state.species().end(), may_be_noticed) &&
           !holds_in_rates(view.system(), is_draw);
}

std::optional<ChangesLost> find_lost_changes(const EndedStage& ended) {
    const StageView& view = ended.view;
    const StageState& state = view.state();
    const Mask* counted = view.environment().counted();
    const double step = state.time.clock.step;
    const auto steps = static_cast<double>(state.steps);
    const std::vector<Field> rates = view.rates();
    const double decay = decay_along(ended, rates);
    const double time = decay * steps * step > 1 ? 1 / decay : steps * step;
    const Mask* frozen = state.frozen().empty() ? nullptr : &state.frozen();
    for (std::size_t s = 0; s < rates.size(); ++s) {
        const LostChange found = lost_change(state.species()[s], rates[s], step, counted, frozen);
        const FieldMoments values = moments(state.species()[s], counted);
        const double value = values.root_mean_square;
        if (found.part < 0.95 || !(found.rate * time >= noticed_change(state, s, values))) continue;
        return ChangesLost{species_name(view.system(), s), found.rate * step, value,
                           found.rate * time};
    }
    return std::nullopt;
}

}  // namespace cascade

// Compares the rates with the spacing of numbers around the values, over the time in which the
// rates decay.
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

/// A warning is given if at least this fraction of the values is lost.
constexpr double lost_change_threshold = 0.01;
/// Rounding may move a pattern at rest by this part of its values.
constexpr double least_noticed = 5e-6;
/// A change is noticed if it is at least this part of the differences between cells.
constexpr double part_of_differences = 0.1;
/// If less than this part of the differences at the start of a stage is left, the pattern is
/// fading.
constexpr double least_contrast_left = 0.1;

/// Changes that are so small that adding them to a species has no effect.
struct LostChange {
    /// The fraction of the cells with a rate other than 0 that a step does not change.
    double part = 0;
    double rate = 0;  ///< The sum of |rate| over these cells, divided by the number of all cells.
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

/// The speed at which rates decay when the state moves along them, in 1 / time. Negative if rates
/// grow.
double decay_along(const EndedStage& ended, const std::vector<Field>& rates) {
    const std::vector<Field>& species = ended.state.species();
    const Mask* counted = ended.view.environment().counted();
    // A step along the rates that is long enough for differences to be well above rounding errors.
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

/// The least change of a species that is noticed. Usually it is a tenth of the differences between
/// cells. If values are uniform or a fading pattern is almost gone, it is a hundredth of the
/// values.
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
    // Rounding a step loses at most half of the last digit.
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

// Has a pattern settled?
#include "solvers/steady.h"

#include "core/check.h"
#include "solvers/field_norms.h"

#include <algorithm>

namespace cascade {
namespace {

/// A flat field has no pattern to measure by; the rounding of its values is what remains.
constexpr double least_deviation = 1e-6;

}  // namespace

double relative_change_rate(std::span<const Field> before, std::span<const Field> now, double time,
                            const Mask* inside) {
    CHECK(before.size() == now.size() && time > 0, "two states at different times");
    double largest = 0;
    for (std::size_t k = 0; k < now.size(); ++k) {
        const double change = root_mean_square_of_difference(now[k], before[k], inside);
        if (change == 0) continue;
        const FieldMoments all = moments(now[k], inside);
        const double size = all.deviation + least_deviation * all.root_mean_square;
        // A pattern that has vanished has no size of its own any more: that is a change.
        largest = std::max(largest, change / (time * std::max(size, 1e-30)));
    }
    return largest;
}

void SteadyWatch::remember(std::vector<Field> species, double t) {
    last_ = std::move(species);
    last_time_ = t;
}

bool SteadyWatch::settled(std::span<const Field> species, double t, double tolerance,
                          const Mask* inside) {
    const bool first = last_.empty();
    const bool is_settled =
        !first && t > last_time_ &&
        relative_change_rate(last_, species, t - last_time_, inside) * t <= tolerance;
    last_.clear();
    for (const Field& field : species) last_.push_back(field.clone());
    last_time_ = t;
    return is_settled;
}

}  // namespace cascade

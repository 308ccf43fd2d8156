// While a moment is observed, the tissue has the values and the time of this moment.
#include "tissue/tissue_moments.h"

#include <array>
#include <utility>
#include <vector>

namespace cascade {

namespace {

/// The largest rounding error of a sum of step lengths, as a fraction of one step.
constexpr double rounding_of_moments = 1e-6;

}  // namespace

bool hold_inside(Tissue& tissue, const TissueSpecies& roles, const Surroundings& surroundings,
                 const std::function<void(std::uint32_t cell, Vector3d movement)>& moved) {
    if (!surroundings.holds()) return false;
    bool is_changed = false;
    for (std::uint32_t cell = 0; cell < tissue.count(); ++cell) {
        const Vector3d at = place_of(tissue, roles, cell);
        const Vector3d held =
            surroundings.held_inside(at, surroundings.near(at, tissue.triangles[cell]));
        if (held == at) continue;
        is_changed = true;
        for (std::size_t k = 0; k < 3; ++k) {
            tissue.set(roles.place + k, cell, std::array{held.x, held.y, held.z}[k]);
        }
        if (moved) moved(cell, place_of(tissue, roles, cell) - at);
    }
    if (is_changed) tissue.pad();
    return is_changed;
}

bool TissueMoments::is_within(double length) const {
    return schedule_.next_moment && schedule_.next_moment(last_) < tissue_.time.t + length;
}

void TissueMoments::observe(const StepCubic& curve, double part) {
    const double start = curve.moment.t, length = curve.moment.length;
    const double end = start + (part - rounding_of_moments) * length;
    const TissueTime time = tissue_.time;
    ++tissue_.time.steps;
    for (double moment = schedule_.next_moment(last_); moment < end;
         moment = schedule_.next_moment(last_)) {
        last_ = moment;
        std::vector<Field> values;
        for (const Field& field : tissue_.species) values.push_back(field.clone());
        curve.put_all(values, (moment - start) / length);
        tissue_.species.swap(values);
        hold_inside(tissue_, roles_, surroundings_);
        tissue_.time.t = moment;
        schedule_.at_moment(tissue_);
        tissue_.species.swap(values);
    }
    tissue_.time = time;
}

void TissueMoments::observe_end(double length) {
    if (!schedule_.next_moment) return;
    const double end = tissue_.time.t + rounding_of_moments * length;
    for (double moment = schedule_.next_moment(last_); moment <= end;
         moment = schedule_.next_moment(last_)) {
        last_ = moment;
        schedule_.at_moment(tissue_);
    }
}

}  // namespace cascade

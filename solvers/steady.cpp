// Decides whether a pattern has settled.
#include "solvers/steady.h"

#include "core/check.h"
#include "solvers/field_norms.h"

#include <algorithm>
#include <utility>

namespace cascade {
namespace {

/// A pattern has formed when its progress is this many times its smallest progress so far. Patterns
/// that grow out of noise or spread over a plane exceed this by far: any factor from 2 to 10 gives
/// the same table in spec/time.md.
constexpr double rise_of_a_formation = 3;

/// If the progress never rose, the pattern existed when the stage began, or it is fading. Such a
/// pattern has settled if its present speed would change it by at most this fraction of its
/// contrast until the stage is twice as old. Noise that fades by diffusion may hide a growing
/// pattern. The progress of such noise stays above 0.35 of its contrast.
constexpr double little_progress = 0.1;

/// This fraction of the root mean square is added to the contrast, because the deviation of a flat
/// field is only the rounding of its values.
constexpr double least_deviation = 1e-6;

double contrast(const Field& field, const Mask* inside) {
    const FieldMoments all = moments(field, inside);
    return all.deviation + least_deviation * all.root_mean_square;
}

void observe(Formation& formation, double speed_of_pattern, double t) {
    const double progress = speed_of_pattern * t;
    formation.least = std::min(formation.least, progress);
    if (progress < formation.greatest) return;
    formation.greatest = progress;
    formation.speed = speed_of_pattern;
    formation.risen = progress > rise_of_a_formation * formation.least;
}

}  // namespace

void SteadyWatch::keep(std::span<const Field> species, double t) {
    last_.clear();
    for (const Field& field : species) last_.push_back(field.clone());
    last_time_ = t;
}

void SteadyWatch::begin(std::span<const Field> species) {
    keep(species, 0);
    formations_.assign(species.size(), Formation{});
}

void SteadyWatch::remember(std::vector<Field> species, double t,
                           std::vector<Formation> formations) {
    CHECK(species.size() == formations.size(), "every species has formed in some way");
    last_ = std::move(species);
    last_time_ = t;
    formations_ = std::move(formations);
}

bool SteadyWatch::settled(std::span<const Field> species, double t, double tolerance,
                          const Mask* inside) {
    bool all_settled = !last_.empty() && t > last_time_;
    formations_.resize(species.size());
    for (std::size_t k = 0; k < last_.size() && t > last_time_; ++k) {
        const FieldMoments change = moments_of_difference(species[k], last_[k], inside);
        const double interval = t - last_time_;
        const double speed = change.root_mean_square / interval;
        Formation& formation = formations_[k];
        observe(formation, change.deviation / interval, t);
        // The contrast is tested last, because it costs passes over the plane and is seldom needed.
        all_settled =
            all_settled && speed <= tolerance * formation.speed &&
            (formation.risen || speed * t <= little_progress * contrast(species[k], inside));
    }
    keep(species, t);
    return all_settled;
}

}  // namespace cascade

// Measures how fast a run proceeds.
#include "solvers/pace.h"

#include <algorithm>
#include <cmath>

namespace cascade {
namespace {

constexpr double batch_seconds = 0.02, patient_seconds = 0.5;
constexpr std::chrono::milliseconds between_reports{100};
constexpr std::size_t most_samples = 21;  // Enough for about two seconds.

}  // namespace

Pace::Pace(Time now, std::int64_t step) { go_on(now, step); }

void Pace::go_on(Time now, std::int64_t step) { samples_.assign(1, {now, step}); }

void Pace::took(std::int64_t count, std::chrono::duration<double> duration) {
    const double per_step = std::max(duration.count(), 1e-9) / static_cast<double>(count);
    const auto steps_in = [&](double seconds) {
        return static_cast<std::int64_t>(std::clamp(std::floor(seconds / per_step), 1.0, 1e9));
    };
    // Batches grow gradually, because the first steps, with cold caches, are slower than later
    // ones.
    batch_ = std::min(steps_in(batch_seconds), batch_ * 8);
    patient_batch_ = steps_in(patient_seconds);
}

bool Pace::report_due(Time now) const { return now - samples_.back().time >= between_reports; }

void Pace::reported(Time now, std::int64_t step) {
    samples_.push_back({now, step});
    if (samples_.size() > most_samples) samples_.pop_front();
}

double Pace::steps_per_second() const {
    const std::chrono::duration<double> window = samples_.back().time - samples_.front().time;
    const std::int64_t steps = samples_.back().step - samples_.front().step;
    if (window.count() <= 0 || steps <= 0) return 0;
    return static_cast<double>(steps) / window.count();
}

}  // namespace cascade

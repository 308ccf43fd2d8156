// Compares speeds with sizes, and births with deaths.
#include "tissue/rest_watch.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace cascade {
namespace {

constexpr double rise_of_motion = 3;
constexpr double times_of_fastest_rate = 100;
constexpr std::int64_t generations = 4;

}  // namespace

double progress_of(std::span<const double> changes, double step, std::span<const double> sizes,
                   std::span<const std::size_t> restless, double since_event) {
    double most = 0;
    for (std::size_t k = 0; k < changes.size(); ++k) {
        if (std::find(restless.begin(), restless.end(), k) != restless.end()) continue;
        most = std::max(most, changes[k] / step * since_event / sizes[k]);
    }
    return most;
}

bool is_at_rest(const TissueTime& time, double progress, double tolerance) {
    const double since_event = time.t - time.last_event;
    return progress <= tolerance &&
           (time.progress >= rise_of_motion * tolerance || time.stiffness == 0 ||
            since_event * time.stiffness >= times_of_fastest_rate);
}

bool compare_turnover(Tissue& tissue, Turnover& turnover) {
    TissueTime& time = tissue.time;
    const auto cells = static_cast<std::int64_t>(tissue.count());
    const std::int64_t births = tissue.births - time.compared_births;
    const std::int64_t deaths = tissue.deaths - time.compared_deaths;
    if (births < generations * std::max(cells, time.compared_cells)) return false;
    const bool stayed = std::abs(cells - time.compared_cells) * 10 <= cells;
    const bool is_turnover = cells > 0 && stayed && deaths >= generations * cells;
    if (is_turnover) turnover = {births, deaths, cells, time.compared_at, time.t};
    time.compared_at = time.t;
    time.compared_births = tissue.births;
    time.compared_deaths = tissue.deaths;
    time.compared_cells = cells;
    return is_turnover;
}

}  // namespace cascade

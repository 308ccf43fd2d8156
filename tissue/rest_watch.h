// Has a tissue come to rest?
#pragma once

#include "tissue/tissue.h"

#include <span>

namespace cascade {

/// The progress of a tissue is how far as much time again as has passed since the last division or
/// death, τ, would take its values at their present speeds: the largest of speed · τ / size over
/// the species, where speed is the root mean square over the cells of change by time. It rises
/// while cells move, and falls when they come to rest.
double progress_of(std::span<const double> changes, double step, std::span<const double> sizes,
                   std::span<const std::size_t> restless, double since_event);

/// Whether the tissue is at rest: its progress is at most `tolerance`, and either it was three
/// times as large since the last event, or τ is a hundred times the time in which the fastest rate
/// acts. Without that second condition the first steps after an event would count as rest.
bool is_at_rest(const TissueTime& time, double progress, double tolerance);

/// Births and deaths over a stretch of time in which the number of cells stayed.
struct Turnover {
    std::int64_t births = 0, deaths = 0, cells = 0;
    double from = 0, to = 0;
};
/// Called after events. A turnover if at least four times as many cells as there are were born
/// since the last comparison and as many died, while their number changed by a tenth at most; such
/// a tissue may go on for ever. Begins a new comparison whenever that number of cells was born.
bool compare_turnover(Tissue& tissue, Turnover& turnover);

}  // namespace cascade

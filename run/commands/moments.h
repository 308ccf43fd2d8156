// The moments of time at which a run is observed, between its steps: --at and --every.
#pragma once

#include "core/result.h"
#include "run/script/script.h"

#include <vector>

namespace cascade {

struct RunRequest;

/// Times since the start of the run. Without any, each stage's `interval` counts.
struct MomentsRequest {
    std::vector<double> at;  ///< Rising.
    double every = 0;        ///< Above 0: all multiples of it.

    bool any() const { return !at.empty() || every > 0; }
};

/// The first moment after t, both since the start of a stage that begins `start` after the run
/// does; infinity if there is none.
double next_moment(const MomentsRequest& moments, double start, double t);

/// Adds an error to `script.diagnostics` if nothing is observed, or if a stage has no such moments:
/// one of cells that crawl, or one whose steps differ from cell to cell.
void check_moments(Script& script, const RunRequest& request);

}  // namespace cascade

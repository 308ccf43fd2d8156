// The options --at and --every observe a run at given times between its steps.
#pragma once

#include "core/result.h"
#include "run/script/script.h"
#include "run/simulation/simulation.h"

#include <cstdint>
#include <vector>

namespace cascade {

struct RunRequest;

/// Times since the start of the run. If none is given, each stage is observed at its `interval`.
struct MomentsRequest {
    std::vector<double> at;  ///< In ascending order.
    double every = 0;        ///< If above 0, the run is observed at all multiples of this time.

    bool any() const { return !at.empty() || every > 0; }
};

/// The first moment after `t`, for a stage that begins at time `start` of the run. `t` and the
/// result are times since the start of the stage. Infinity if there is no such moment.
double next_moment(const MomentsRequest& moments, double start, double t);

/// The moments of a stage that follows the present states of the stages before it. Empty if none
/// are requested. `moments` must outlive the result.
NextMoment moments_of(const MomentsRequest& moments, const Simulation& simulation,
                      std::uint32_t stage);

/// Adds an error to `script.diagnostics` if no output of the run uses the moments, or if the cells
/// of a stage have no common time, because its `speed` varies.
void check_moments(Script& script, const RunRequest& request);

}  // namespace cascade

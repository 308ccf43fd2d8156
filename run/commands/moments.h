// The options --at and --every, which observe a run at given times. These times may lie between
// steps.
#pragma once

#include "core/result.h"
#include "lang/syntax/ast.h"
#include "run/script/script.h"
#include "run/simulation/simulation.h"

#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

namespace cascade {

struct RunRequest;

/// Times of an option. All of them have the same unit.
struct GivenTimes {
    GivenTimes() = default;
    GivenTimes(std::initializer_list<double> times) : numbers(times) {}
    std::vector<double> numbers;  ///< In ascending order.
    std::string unit;             ///< Such as "min". Empty: the unit of the script.

    friend bool operator==(const GivenTimes&, const GivenTimes&) = default;
};

/// Times since the start of the run. If none is given, each stage is observed at its `interval`.
struct MomentsRequest {
    GivenTimes at;
    GivenTimes every;  ///< At most one time. The run is observed at all multiples of it.

    bool any() const { return !at.numbers.empty() || !every.numbers.empty(); }
};

/// The times of a request, in the unit of the script.
struct Moments {
    std::vector<double> at;  ///< In ascending order.
    double every = 0;        ///< If above 0, the run is observed at all multiples of this time.

    bool any() const { return !at.empty() || every > 0; }
};

/// Converts the times of a request. Fails if they have a unit that is not a unit of time, or if the
/// script has no unit of time.
Result<Moments> moments_in(const ast::Script& script, const MomentsRequest& request);

/// The first moment after `t`, for a stage that begins at time `start` of the run. `t` and the
/// result are times since the start of the stage. Infinity if there is no such moment.
double next_moment(const Moments& moments, double start, double t);

/// The moments of a stage that follows the present states of the stages before it. Empty if none
/// are requested. `moments` must outlive the result.
NextMoment moments_of(const Moments& moments, const Simulation& simulation, std::uint32_t stage);

/// Adds an error to `script.diagnostics` if moments_in() fails, if no output of the run uses the
/// moments, or if the cells
/// of a stage have no common time, because its `speed` varies.
void check_moments(Script& script, const RunRequest& request);

}  // namespace cascade

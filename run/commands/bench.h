// The command `cascade bench` measures the speed of a script's steps, and finds out what limits the
// speed.
#pragma once

#include "core/result.h"
#include "core/run_control.h"
#include "run/commands/machine_limits.h"
#include "run/script/script.h"
#include "run/simulation/simulation.h"
#include "run/stage/step_work.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

struct BenchRequest {
    SimulationOptions simulation;
    /// The name of the stage to measure, or its number, counted from 1. Empty: all stages are
    /// measured.
    std::string stage;
    double seconds = 1;  ///< The seconds spent on measuring each stage. Above 0.
    /// Whether the machine's peak speeds are measured as well. Ignored if steps are interpreted.
    bool has_limits = true;
};

/// The measurements of one stage.
struct StageBench {
    std::string stage;
    std::string solver;
    Grid grid;
    /// For crawling cells, the mean number of cells over the measured steps. Otherwise 0.
    double mean_cells = 0;
    Precision precision = Precision::single;
    bool fast = false;      ///< Whether the script was run with --fast.
    bool is_native = true;  ///< Whether steps were compiled. Otherwise they were interpreted.
    /// The reason why there is nothing to measure. All other members are then empty.
    std::string nothing;

    /// The seconds that a step takes: the median over the batches, or the mean for crawling cells.
    double step = 0;
    std::size_t batches = 0;
    std::int64_t steps = 0;  ///< The number of steps measured.
    int threads = 1;         ///< The number of threads that took the last of these steps.
    int most_threads = 1;    ///< The number of threads available.
    Stepping stepping;       ///< How these steps divided the planes into tiles and sweeps.
    double starting = 0;     ///< Seconds for computing the starting values a single time.
    double compiling = 0;    ///< Seconds for compiling.
    double first_step = 0;   ///< Seconds from the starting values to the end of the first step.
    StepWork work;
    std::optional<MachineLimits> limits;

    bool is_of_cells() const { return mean_cells > 0; }
    double cells() const {
        return is_of_cells() ? mean_cells : static_cast<double>(grid.cell_count());
    }
    double cell_steps_per_second() const { return cells() / step; }
};

/// A resource that may limit the speed of steps.
struct Bound {
    enum class Kind { operations, divisions, nearest, tiles, home, meetings };
    Kind kind = Kind::operations;
    std::string name;
    /// The measured rate: operations, divisions, bytes or barriers per second.
    double reached = 0;
    double most = 0;  ///< The measured peak of this machine, in the same unit.
    double share() const { return most > 0 ? reached / most : 0; }
};

/// Returns the resources that the steps of a stage use, in the order of Kind, or no resources if
/// the machine was not measured. `home` is the cache or memory that holds all planes. If steps are
/// computed in tiles, the planes are read from `home` once for several sweeps, and `tiles` is the
/// cache that holds the layers of a tile. A share above 1 means that fewer bytes came from that
/// cache or memory than were counted.
std::vector<Bound> bounds_of(const StageBench& bench);

/// Returns the resource with the largest share. Ignores resources for which is_outdone() is true,
/// because such resources cannot limit the speed.
const Bound& tightest(const std::vector<Bound>& bounds);
/// Whether the resource's share is so far above 1 that the steps must have used less of the
/// resource than was counted.
bool is_outdone(const Bound& bound);

/// The largest possible speed by the roofline model.
struct Roof {
    double cell_steps_per_second = 0;
    std::string name;  ///< The resource that sets the limit.
};

/// Returns the smallest of three limits: the machine's peak of arithmetic divided by the operations
/// for a step of one cell, and the bandwidths of `tiles` and of `home` (see bounds_of()), each
/// divided by the bytes that a step of one cell moves there (Williams, Waterman, Patterson,
/// "Roofline", CACM 52(4), 2009). Returns an empty optional if the machine was not measured.
std::optional<Roof> attainable(const StageBench& bench);

/// Measures the stages one after the other and passes each result to `tell`. Every stage starts
/// from the state in which the measurement has left earlier stages, and is started again whenever
/// it ends. Fails like run(). Errors in the script are added to `script.diagnostics`. After a
/// cancel, returns without an error.
Result<void> bench(Script& script, const BenchRequest& request, RunControl& control,
                   const std::function<void(const StageBench&)>& tell);

}  // namespace cascade

// `cascade bench`: the speed of a script's steps, and what limits it.
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
    std::string stage;   ///< Name, or number from 1, of the only stage to measure; empty for all.
    double seconds = 1;  ///< Time to measure each stage for; above 0.
    bool has_limits = true;  ///< Measure the machine's peaks, too; not of interpreted steps.
};

/// The result of one stage.
struct StageBench {
    std::string stage;
    std::string solver;
    Grid grid;
    double mean_cells = 0;  ///< In a stage of cells that crawl: the mean number over its steps.
    Precision precision = Precision::single;
    bool fast = false;      ///< With --fast.
    bool is_native = true;  ///< False if steps were interpreted.
    std::string nothing;    ///< Why there is nothing to measure; all other members are then empty.

    double step = 0;  ///< Seconds: the median over the batches; of cells that crawl the mean.
    std::size_t batches = 0;
    std::int64_t steps = 0;  ///< Steps that were measured.
    int threads = 1;         ///< Threads that took the last of these steps.
    int most_threads = 1;    ///< Threads that were available.
    Stepping stepping;       ///< How these steps went through memory.
    double starting = 0;     ///< Seconds to compute the starting values, each time.
    double compiling = 0;    ///< Seconds of compiling.
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
    double reached = 0;  ///< Operations, divisions, bytes or barriers per second.
    double most = 0;     ///< The measured peak of the same.
    double share() const { return most > 0 ? reached / most : 0; }
};

/// The resources used by the steps of a stage, in the order of Kind; empty without limits. `home`
/// is the memory level that holds all planes. In tiles, several sweeps share one pass through it,
/// and `tiles` is the cache that holds the layers in use for all of them. A share above 1 means
/// that fewer bytes came from this level than are counted.
std::vector<Bound> bounds_of(const StageBench& bench);

/// The resource with the largest share, except those far above 1, which limit nothing.
const Bound& tightest(const std::vector<Bound>& bounds);
/// True if the share is so far above 1 that less was asked of the resource than is counted.
bool is_outdone(const Bound& bound);

/// The limit of the roofline model.
struct Roof {
    double cell_steps_per_second = 0;
    std::string name;  ///< The resource that limits it.
};

/// The minimum of the peak of arithmetic over the operations of a cell-step, and the bandwidths of
/// `tiles` and `home` over the bytes that it moves there (Williams, Waterman, Patterson,
/// "Roofline", CACM 52(4), 2009). Nothing without limits.
std::optional<Roof> attainable(const StageBench& bench);

/// Measures the stages one after the other and passes each result to `tell`. Every stage starts
/// from the present state of earlier stages, and is started again whenever it ends. Fails as runs
/// fail; errors in the script go to `script.diagnostics`. After a cancel it returns without an
/// error.
Result<void> bench(Script& script, const BenchRequest& request, RunControl& control,
                   const std::function<void(const StageBench&)>& tell);

}  // namespace cascade

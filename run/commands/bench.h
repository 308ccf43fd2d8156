// `cascade bench`: how fast the steps of a script are, and what keeps them from being faster.
#pragma once

#include "core/result.h"
#include "core/run_control.h"
#include "run/commands/machine_limits.h"
#include "run/script/script.h"
#include "run/simulation/simulation.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

struct BenchRequest {
    SimulationOptions simulation;
    std::string stage;  ///< Name, or number from 1, of the only stage that is measured; empty: all.
    double seconds = 1;  ///< Of steps that are measured in each stage; above 0.
    bool has_limits =
        true;  ///< Measure the machine as well; there are no limits without native code.
};

/// One stage.
struct StageBench {
    std::string stage;
    std::string solver;
    Grid grid;
    Precision precision = Precision::single;
    bool fast = false;      ///< With fewer roundings.
    bool is_native = true;  ///< Else the interpreter takes the steps.
    std::string nothing;    ///< Why there is nothing to measure; then all else is empty.

    double step = 0;  ///< Seconds: the median of batches.
    std::size_t batches = 0;
    std::int64_t steps = 0;  ///< That were measured.
    int threads = 1;         ///< That took the last of them.
    int most_threads = 1;    ///< That might have.
    Stepping stepping;       ///< How these went through memory.
    double starting = 0;     ///< Seconds until the starting values were there, each time.
    double compiling = 0;    ///< Seconds until there was code.
    double first_step = 0;   ///< Seconds from starting values to the first complete step.
    StepWork work;
    std::optional<MachineLimits> limits;

    double cells() const { return static_cast<double>(grid.cell_count()); }
    double cell_steps_per_second() const { return cells() / step; }
};

/// One thing that may bound a step.
struct Bound {
    enum class Kind { operations, divisions, nearest, tiles, home, meetings };
    Kind kind = Kind::operations;
    std::string name;
    double reached = 0;  ///< Operations, divisions, bytes or meetings a second.
    double most = 0;     ///< The same, as it was measured.
    double share() const { return most > 0 ? reached / most : 0; }
};

/// What bounds the steps of a stage, in the order above; empty without limits. `home` is the memory
/// that is large enough for all planes. Where several sweeps are done for each pass through it they
/// share its bytes, and `tiles` is the cache that holds the layers in use and feeds each of them. A
/// share above 1 says that less was asked of a memory than is counted.
std::vector<Bound> bounds_of(const StageBench& bench);

/// The one whose share is the largest; one that is far above 1 bounds nothing.
const Bound& tightest(const std::vector<Bound>& bounds);
/// Is its share so far above 1 that less was asked of it than is counted?
bool is_outdone(const Bound& bound);

/// What a roofline allows.
struct Roof {
    double cell_steps_per_second = 0;
    std::string name;  ///< What is used up then.
};

/// The smallest of the peak of arithmetic over the operations of a cell-step and the bandwidths of
/// `tiles` and `home` over its bytes that they move (Williams, Waterman, Patterson, "Roofline",
/// CACM 52(4), 2009). Nothing without limits.
std::optional<Roof> attainable(const StageBench& bench);

/// Measures the stages one after the other; `tell` gets each as soon as it is known. Every stage
/// begins with its starting values, as earlier stages were left, and again whenever it ends. Fails
/// as runs fail; `script.diagnostics` has errors where the script is to blame. After a cancel it
/// just ends.
Result<void> bench(Script& script, const BenchRequest& request, RunControl& control,
                   const std::function<void(const StageBench&)>& tell);

}  // namespace cascade

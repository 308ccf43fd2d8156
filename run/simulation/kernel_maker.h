// Makes the kernels of a simulation runnable. Each kernel is compiled, interpreted, or interpreted
// until its compiled code is ready.
#pragma once

#include "core/grid.h"
#include "core/result.h"
#include "ir/tiered_backend.h"
#include "run/stage/bound_kernel.h"
#include "run/stage/step_kernels.h"
#include "run/stage/time_account.h"
#include "solvers/advance.h"
#include "solvers/executor.h"

#include <functional>
#include <memory>
#include <optional>

namespace cascade {

/// The tools that compute steps. No result depends on their choice.
struct StepTools {
    std::shared_ptr<TieredBackend> stepper;
    /// Whether steps are interpreted until their compiled code is ready.
    bool starts_interpreted = false;
    int threads = 1;
    /// The tiling of planes. If empty, it is chosen by the size of the grid and by measurement.
    std::optional<Tiling> tiling = {};
    MakeExecutor executor = make_thread_executor;
};

class KernelMaker {
public:
    /// Makes kernels for the cells of `grid`. The account must outlive this object.
    KernelMaker(const Grid& grid, const StepTools& tools, TimeAccount& account)
        : grid_(grid),
          stepper_(tools.stepper),
          starts_interpreted_(tools.starts_interpreted),
          account_(account) {}

    const std::shared_ptr<TieredBackend>& stepper() const { return stepper_; }
    bool starts_interpreted() const { return starts_interpreted_; }

    Compile interpreted() const { return interpreted_on(grid_); }
    Compile interpreted_on(const Grid& grid) const;
    /// Makes kernels that run every few steps. Such kernels are compiled as soon as interpreting
    /// them has taken as long as compiling would take.
    Compile often() const;
    /// Makes kernels that run only once. Such kernels are interpreted unless that would take longer
    /// than compiling.
    Compile once() const;
    /// Makes kernels of steps. They are compiled before the first step, or while the first steps
    /// are interpreted. Adds them to `kernels`, and calls `refused` for each kernel that cannot be
    /// compiled.
    Compile steps(TieredBackend::When when, StepKernels& kernels,
                  std::function<void(const Failure&)> refused) const;
    /// Tells the stepper about a kernel that will be needed later.
    void expect(const CellKernel& kernel) const { stepper_->expect(kernel, grid_.stencil()); }

    /// Whether the grid is so small that evaluating a formula takes less time than waking a second
    /// thread.
    bool is_small() const { return grid_.cell_count() < 65536; }

private:
    /// Whether steps are interpreted until their compiled code is ready. This is not done on large
    /// grids, because a single interpreted step takes longer than compiling.
    bool runs_meanwhile() const {
        return starts_interpreted_ && grid_.cell_count() < cells_worth_compiling;
    }

    Grid grid_;
    std::shared_ptr<TieredBackend> stepper_;
    bool starts_interpreted_;
    TimeAccount& account_;
};

}  // namespace cascade

// Makes the kernels of a simulation runnable: compiled, interpreted, or interpreted until they are
// compiled.
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

/// How steps are computed. No result depends on it.
struct StepTools {
    std::shared_ptr<TieredBackend> stepper;
    bool starts_interpreted = false;  ///< Are steps interpreted until their code is ready?
    int threads = 1;
    std::optional<Tiling> tiling = {};  ///< None: chosen by size and by time.
    MakeExecutor executor = make_thread_executor;
};

class KernelMaker {
public:
    /// For the cells of `grid`. The account must outlive this.
    KernelMaker(const Grid& grid, const StepTools& tools, TimeAccount& account)
        : grid_(grid),
          stepper_(tools.stepper),
          starts_interpreted_(tools.starts_interpreted),
          account_(account) {}

    const std::shared_ptr<TieredBackend>& stepper() const { return stepper_; }
    bool starts_interpreted() const { return starts_interpreted_; }

    Compile interpreted() const { return interpreted_on(grid_); }
    Compile interpreted_on(const Grid& grid) const;
    /// For kernels that run every few steps: interpreted until that has taken as long as compiling.
    Compile often() const;
    /// For kernels that run once: interpreted, unless that would take longer than compiling.
    Compile once() const;
    /// For kernels of steps: compiled, before the first step or while the first ones are
    /// interpreted. Adds them to `kernels`; `refused` receives those that cannot be compiled.
    Compile steps(TieredBackend::When when, StepKernels& kernels,
                  std::function<void(const Failure&)> refused) const;
    /// Announces kernels that will be needed later.
    void expect(const CellKernel& kernel) const { stepper_->expect(kernel, grid_.stencil()); }

    /// Evaluating a small grid takes less time than waking a second thread.
    bool is_small() const { return grid_.cell_count() < 65536; }

private:
    /// Are steps interpreted until their code is ready? With many cells that would take longer than
    /// waiting.
    bool runs_meanwhile() const {
        return starts_interpreted_ && grid_.cell_count() < cells_worth_compiling;
    }

    Grid grid_;
    std::shared_ptr<TieredBackend> stepper_;
    bool starts_interpreted_;
    TimeAccount& account_;
};

}  // namespace cascade

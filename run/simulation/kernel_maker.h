// How the kernels of a simulation become runnable: compiled, interpreted, or interpreted until they
// are compiled.
#pragma once

#include "core/grid.h"
#include "core/result.h"
#include "ir/tiered_backend.h"
#include "run/stage/bound_kernel.h"
#include "run/stage/step_kernels.h"
#include "run/stage/time_account.h"

#include <functional>
#include <memory>

namespace cascade {

class KernelMaker {
public:
    /// Takes steps by `stepper`; they are interpreted meanwhile if that `starts_interpreted`.
    KernelMaker(const Grid& grid, std::shared_ptr<TieredBackend> stepper, bool starts_interpreted,
                TimeAccount* account);

    const std::shared_ptr<TieredBackend>& stepper() const { return stepper_; }
    bool starts_interpreted() const { return starts_interpreted_; }

    Compile interpreted() const { return interpreted_on(grid_); }
    Compile interpreted_on(const Grid& grid) const;
    /// What is computed every few steps is compiled where there are many cells.
    Compile often() const;
    /// What is computed once is interpreted, unless that would take longer than making code for it.
    Compile once() const;
    /// Steps are compiled: before the first, or while the first ones are interpreted. `kernels`
    /// hears of them, `refused` of those that cannot be compiled.
    Compile steps(TieredBackend::When when, StepKernels& kernels,
                  std::function<void(const Failure&)> refused) const;
    /// They will be needed later.
    void expect(const CellKernel& kernel) const { stepper_->expect(kernel, grid_.stencil()); }

    /// Evaluating a small grid is over before code is made for it or a second thread has woken up.
    bool is_small() const { return grid_.cell_count() < 65536; }

private:
    /// Are steps interpreted until there is code for them? On many cells that would take longer
    /// than to wait.
    bool runs_meanwhile() const {
        return starts_interpreted_ && grid_.cell_count() < cells_worth_compiling;
    }

    Grid grid_;
    std::unique_ptr<Backend> interpreter_;
    std::shared_ptr<TieredBackend> stepper_;
    bool starts_interpreted_;
    TimeAccount* account_;
};

}  // namespace cascade

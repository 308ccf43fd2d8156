// Chooses between the interpreter and compiled code.
#include "run/simulation/kernel_maker.h"

#include "core/check.h"

#include <utility>

namespace cascade {

Compile KernelMaker::interpreted_on(const Grid& grid) const {
    return [this, stencil = grid.stencil()](const CellKernel& kernel) {
        auto compiled = stepper_->interpreter().compile(kernel, stencil);
        CHECK(compiled, "the interpreter compiles every kernel");
        return *compiled;
    };
}

Compile KernelMaker::often() const {
    return [this, interpret = interpreted()](const CellKernel& kernel) {
        const TimeAccount::Scope spent(account_, Spent::compiling);
        if (grid_.cell_count() < cells_worth_compiling) {
            return stepper_->begin(kernel, grid_.stencil(), TieredBackend::When::when_used);
        }
        auto made = stepper_->compile(kernel, grid_.stencil());
        return made ? *made : interpret(kernel);
    };
}

Compile KernelMaker::once() const {
    return grid_.cell_count() < cells_worth_compiling ? interpreted() : often();
}

Compile KernelMaker::steps(TieredBackend::When when, StepKernels& kernels,
                           std::function<void(const Failure&)> refused) const {
    return [this, when, &kernels, refused = std::move(refused),
            interpret = interpreted()](const CellKernel& kernel) {
        kernels.identify(kernel);
        if (runs_meanwhile()) {
            KernelPointer begun = stepper_->begin(kernel, grid_.stencil(), when);
            kernels.add(begun);
            return begun;
        }
        auto made = stepper_->compile(kernel, grid_.stencil());
        if (made) return *made;
        refused(made.error());
        return interpret(kernel);
    };
}

}  // namespace cascade

// The kernels of a stage's steps, and what is to be said of them.
#pragma once

#include "core/run_control.h"
#include "ir/tiered_backend.h"

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace cascade {

class StepKernels {
public:
    /// Both must outlive it.
    StepKernels(const std::string& stage, RunControl& control) : stage_(stage), control_(control) {}

    void add(KernelPointer kernel) { kernels_.push_back(std::move(kernel)); }

    /// Says of kernels that could not be compiled, as far as that is known, that they are interpreted.
    void warn_of_refused() {
        for (const KernelPointer& kernel : kernels_) {
            if (const Failure* const refusal = kernel->refusal()) warn(*refusal);
        }
    }

    /// Says that a kernel is interpreted; the same reason is given once.
    void warn(const Failure& refusal);

private:
    const std::string& stage_;
    RunControl& control_;
    std::vector<KernelPointer> kernels_;
    std::set<std::string> said_;
};

}  // namespace cascade

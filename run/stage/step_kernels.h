// The kernels of a stage's steps, and the remarks on them.
#pragma once

#include "core/run_control.h"
#include "ir/tiered_backend.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace cascade {

class StepKernels {
public:
    explicit StepKernels(std::string stage) : stage_(std::move(stage)) {}

    void add(KernelPointer kernel) { kernels_.push_back(std::move(kernel)); }

    /// Adds a kernel of the steps to the identity, whatever runs it.
    void identify(const CellKernel& kernel) {
        identity_ = 0x100000001b3 * (identity_ ^ hash(kernel));
    }
    /// A hash of all of them so far.
    std::uint64_t identity() const { return identity_; }

    /// Reports the kernels that are known to have failed to compile and are interpreted.
    void warn_of_refused(RunControl& control) {
        for (const KernelPointer& kernel : kernels_) {
            if (const Failure* const refusal = kernel->refusal()) warn(*refusal, control);
        }
    }
    /// May more of them fail yet?
    bool is_provisional() const {
        return std::any_of(kernels_.begin(), kernels_.end(),
                           [](const KernelPointer& kernel) { return kernel->is_provisional(); });
    }

    /// Is one interpreted because it could not be compiled?
    bool has_refused() const { return has_refused_; }

    /// Reports that a kernel is interpreted; each reason is given once.
    void warn(const Failure& refusal, RunControl& control);

private:
    std::string stage_;
    std::vector<KernelPointer> kernels_;
    std::set<std::string> said_;
    bool has_refused_ = false;
    std::uint64_t identity_ = 0;
};

}  // namespace cascade

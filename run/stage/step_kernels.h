// The kernels that a stage's steps use, and warnings about kernels that are interpreted.
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

    /// Adds a kernel of the steps to the hash of all kernels, whether the kernel is compiled or
    /// interpreted.
    void identify(const CellKernel& kernel) {
        identity_ = 0x100000001b3 * (identity_ ^ hash(kernel));
    }
    /// Returns a hash of all kernels that identify() has added so far.
    std::uint64_t identity() const { return identity_; }

    /// Warns of the kernels that could not be compiled and are interpreted.
    void warn_of_refused(RunControl& control) {
        for (const KernelPointer& kernel : kernels_) {
            if (const Failure* const refusal = kernel->refusal()) warn(*refusal, control);
        }
    }
    /// Whether some kernels are still being compiled. Compiling them may fail later.
    bool is_provisional() const {
        return std::any_of(kernels_.begin(), kernels_.end(),
                           [](const KernelPointer& kernel) { return kernel->is_provisional(); });
    }

    /// Whether a kernel is interpreted because it could not be compiled.
    bool has_refused() const { return has_refused_; }

    /// Warns that a kernel is interpreted. Each reason is given only once.
    void warn(const Failure& refusal, RunControl& control);

private:
    std::string stage_;
    std::vector<KernelPointer> kernels_;
    std::set<std::string> said_;
    bool has_refused_ = false;
    std::uint64_t identity_ = 0;
};

}  // namespace cascade

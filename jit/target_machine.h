// The processor for which code is made.
//
// Internal to jit/.
#pragma once

#include "core/result.h"
#include "jit/jit.h"
#include "jit/kernel_shape.h"

#include <llvm/IR/Module.h>
#include <llvm/Target/TargetMachine.h>

#include <memory>
#include <string>

namespace cascade {

/// A target machine, and the number of cells in a vector.
struct TargetChoice {
    std::unique_ptr<llvm::TargetMachine> machine;
    int lanes = 0;
};

/// The target machine for a CPU of the host's architecture. `cpu` is a name that LLVM knows; "" is
/// the host with all its features. `options` gives the number of lanes, where 0 means the CPU's
/// widest vectors. Callers must check the options first. Fails for a CPU that LLVM does not know.
Result<TargetChoice> choose_target(const std::string& cpu, const JitOptions& options);

/// The number of floats in the widest vectors of this CPU: 4, 8 or 16.
int widest_lanes(const llvm::TargetMachine& machine);

/// Whether one instruction computes a * b + c with one rounding.
bool has_multiply_add(const llvm::TargetMachine& machine);

/// Whether combining two vectors by a shift takes less time than a load across two cache lines. In
/// one cycle, Zen 4 loads 64 bytes inside a line, but only 32 bytes across lines. Shifts and
/// arithmetic process 64 bytes per cycle.
bool is_short_of_loads(const llvm::TargetMachine& machine);

/// Whether gathering a vector takes less time than loading each of its numbers. Gathering is faster
/// on Intel's processors since 2021, and the function checks for a feature that only these
/// processors have. On older Intel processors, the mitigation of "gather data sampling" slows
/// gathers down. On AMD's processors, gathers take about as long as loads.
bool has_fast_gathers(const llvm::TargetMachine& machine);

/// Whether one instruction rounds to whole numbers, ties to even.
bool has_rounding(const llvm::TargetMachine& machine);

/// Returns the shape with all members set that depend on the processor.
KernelShape tuned(KernelShape shape, const llvm::TargetMachine& machine);

/// Sets the attributes that let LLVM use the processor's features and that select the arithmetic of
/// the specification: strict, with denormals flushed to zero of the same sign.
void set_target(llvm::Function& function, const llvm::TargetMachine& machine, int vector_bytes);

/// LLVM's name of the host's CPU.
std::string host_cpu_name();

}  // namespace cascade

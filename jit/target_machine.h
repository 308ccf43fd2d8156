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

/// A target machine and the number of cells in its vectors.
struct TargetChoice {
    std::unique_ptr<llvm::TargetMachine> machine;
    int lanes = 0;
};

/// The target machine for a CPU of the host's architecture, by LLVM's name; "" is the host with all
/// its features. The number of lanes is as `options` asks, or by the CPU's widest vectors. Options
/// are in range. Fails on a CPU that LLVM does not know.
Result<TargetChoice> choose_target(const std::string& cpu, const JitOptions& options);

/// Floats in the widest vector that this CPU computes with: 4, 8 or 16.
int widest_lanes(const llvm::TargetMachine& machine);

/// Whether a * b + c with one rounding is an instruction.
bool has_multiply_add(const llvm::TargetMachine& machine);

/// Whether shifting two vectors together costs less than a load across two cache lines. Zen 4 loads
/// 64 bytes a cycle and 32 a cycle across lines, while it shifts and computes 64.
bool is_short_of_loads(const llvm::TargetMachine& machine);

/// Whether gathering a vector takes less time than a load for each of its numbers: on Intel's
/// processors since 2021. On AMD's it takes about as long, and older Intel processors are slowed
/// down by the mitigation of "gather data sampling". Neither has the instruction checked here.
bool has_fast_gathers(const llvm::TargetMachine& machine);

/// Whether rounding to whole numbers, ties to even, is an instruction.
bool has_rounding(const llvm::TargetMachine& machine);

/// The same shape with the features and strengths of this processor.
KernelShape tuned(KernelShape shape, const llvm::TargetMachine& machine);

/// Sets the attributes that let LLVM use the processor's features, and the arithmetic of the
/// specification: strict, with denormals flushed to zero of the same sign.
void set_target(llvm::Function& function, const llvm::TargetMachine& machine, int vector_bytes);

/// Name of the host's CPU as LLVM knows it.
std::string host_cpu_name();

}  // namespace cascade

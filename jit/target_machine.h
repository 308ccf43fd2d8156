// The processor that code is made for.
//
// Internal to jit/.
#pragma once

#include "core/result.h"
#include "jit/jit.h"

#include <llvm/IR/Module.h>
#include <llvm/Target/TargetMachine.h>

#include <memory>
#include <string>

namespace cascade {

/// A machine and how many cells its vectors hold.
struct TargetChoice {
    std::unique_ptr<llvm::TargetMachine> machine;
    int lanes = 0;
};

/// The machine for a CPU of this machine's architecture, by LLVM's name for it; "" is the host with
/// all its features. Lanes are as asked for, or as wide as the CPU has them. Fails on options
/// that are out of range.
Result<TargetChoice> choose_target(const std::string& cpu, const JitOptions& options);

/// Floats in the widest vector that this CPU computes with: 4, 8 or 16.
int widest_lanes(const llvm::TargetMachine& machine);

/// Sets what a function must say for the processor's features to be used, and for the arithmetic
/// of the specification: strict, with denormals flushed to zero of the same sign.
void set_target(llvm::Function& function, const llvm::TargetMachine& machine, int vector_bytes);

/// Name of the host's CPU as LLVM knows it.
std::string host_cpu_name();

}  // namespace cascade

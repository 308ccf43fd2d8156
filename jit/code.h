// Translates a cell kernel to LLVM IR, and LLVM IR to an object file or assembly.
//
// Internal to jit/. Object files, dumps and the code that runs in this process are all made here.
// No LLVM pass over the IR is run. Passes would change nothing, because the builder of kernels has
// already evaluated constants and merged equal values, and the skeleton computes values outside the
// loops in which they do not change.
#pragma once

#include "core/result.h"
#include "jit/kernel_shape.h"

#include <llvm/ADT/SmallVector.h>
#include <llvm/IR/LLVMContext.h>
#include <llvm/IR/Module.h>
#include <llvm/Target/TargetMachine.h>

#include <memory>
#include <string>

namespace cascade {

/// A module with the LLVM context that it needs.
struct CodeModule {
    std::unique_ptr<llvm::LLVMContext> context;
    std::unique_ptr<llvm::Module> module;
    /// Whether the module contains a kernel above `largest_optimised_kernel`.
    bool is_large = false;
};

// The size of a kernel is the number of its instructions plus the loads of its Laplacians. The time
// that LLVM's optimising code generator takes grows with the square of the size. At this size it
// takes 0.2 to 0.4 s. Larger kernels get unoptimised code, which is generated in a time
// proportional to the size.
inline constexpr std::size_t largest_optimised_kernel = 3000;

/// Kernels above this size are refused. At this size, compiling takes up to 1 s.
inline constexpr std::size_t largest_native_kernel = 20000;

/// An empty module for code of the given machine.
CodeModule make_module(const llvm::TargetMachine& machine);

/// Adds the kernel as a function called `name`. Fails if the kernel is larger than
/// `largest_native_kernel`, or if LLVM's verifier rejects the code. Rejected code means a bug in
/// jit/, but the caller can still interpret the kernel.
Result<void> add_kernel(CodeModule& code, const CellKernel& kernel, const KernelShape& shape,
                        const std::string& name, const llvm::TargetMachine& machine);

/// A module that contains one kernel.
Result<CodeModule> make_code(const CellKernel& kernel, const KernelShape& shape,
                             const std::string& name, const llvm::TargetMachine& machine);

/// The form of machine code: the bytes of an object file, or text in assembly language.
enum class CodeForm { object, assembly };
Result<llvm::SmallVector<char, 0>> generate(CodeModule& code, llvm::TargetMachine& machine,
                                            CodeForm form);

}  // namespace cascade

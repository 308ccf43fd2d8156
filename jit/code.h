// From a cell kernel to LLVM IR, and from that to an object file or assembly.
//
// Internal to jit/. Objects, dumps and the code that runs in this process are all made here. No
// LLVM pass over the IR is run: the builder of kernels has folded and numbered all values and the
// skeleton has moved them out of loops, and with such passes the code would be the same.
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

/// A module with the context it lives in.
struct CodeModule {
    std::unique_ptr<llvm::LLVMContext> context;
    std::unique_ptr<llvm::Module> module;
    bool is_large = false;  ///< A kernel in it is above `largest_optimised_kernel`.
};

// The size of a kernel is the number of its instructions and of the loads of its Laplacians. The
// time of LLVM's optimising code generator grows with the square of the size: at this size it is
// 0.2 to 0.4 s. Larger kernels get unoptimised code, whose time grows linearly.
inline constexpr std::size_t largest_optimised_kernel = 3000;

/// Larger kernels are refused. At this size, compiling takes up to 1 s.
inline constexpr std::size_t largest_native_kernel = 20000;

/// An empty module for a machine's code.
CodeModule make_module(const llvm::TargetMachine& machine);

/// Adds the kernel as a function `name`. Fails if the kernel is larger than `largest_native_kernel`
/// or if LLVM's verifier rejects the code (a bug of ours, but the caller can interpret the kernel).
Result<void> add_kernel(CodeModule& code, const CellKernel& kernel, const KernelShape& shape,
                        const std::string& name, const llvm::TargetMachine& machine);

/// A module of one kernel.
Result<CodeModule> make_code(const CellKernel& kernel, const KernelShape& shape,
                             const std::string& name, const llvm::TargetMachine& machine);

/// Machine code as the bytes of an object file, or as assembly text.
enum class CodeForm { object, assembly };
Result<llvm::SmallVector<char, 0>> generate(CodeModule& code, llvm::TargetMachine& machine,
                                            CodeForm form);

}  // namespace cascade

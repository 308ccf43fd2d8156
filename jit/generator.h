// The code generator: LLVM hidden by a table of functions.
//
// Internal to jit/. Loading libLLVM takes longer than a small run, so all code that needs it is in
// a module, `libcascade_llvm.so`, loaded at the first request for a kernel that no cache has. It is
// found like a shared library, by the paths that the program, or libcascade, was linked with.
#pragma once

#include "jit/code_image.h"
#include "jit/jit.h"
#include "jit/kernel_shape.h"

#include <string>

namespace cascade {

/// The functions of the module. Several threads may call them. Options have been checked.
struct CodeGenerator {
    /// Machine code of a kernel for this processor.
    Result<CodeImage> (*compile)(const CellKernel& kernel, const KernelShape& shape, int optimise);
    // The functions of jit/jit.h.
    Result<std::string> (*dump_llvm)(const CellKernel&, Stencil, const JitOptions&);
    Result<std::string> (*dump_assembly)(const CellKernel&, Stencil, const JitOptions&);
    Result<std::vector<std::uint8_t>> (*compile_object)(const ObjectContent&, Stencil,
                                                        const std::string& cpu);
    std::vector<std::string> (*known_targets)();
};

/// Loads the module at the first call. Fails if there is none, or if it is of another build.
Result<const CodeGenerator*> code_generator();

/// The name of the module's only symbol: a function that takes the caller's `code_version` and
/// returns the table, or null if the module's own version differs.
inline constexpr const char* generator_symbol = "cascade_code_generator";
using GeneratorEntry = const CodeGenerator*(const char* version);

/// Differs between builds that may make different code of the same kernel: a hash of the sources of
/// this room and of ir/, and of LLVM's version.
const char* code_version();

/// Fails on options that are out of range.
Result<void> check_options(const JitOptions& options);

/// Changes when the machine's LLVM library is replaced. Empty if unknown.
std::string llvm_identity();

}  // namespace cascade

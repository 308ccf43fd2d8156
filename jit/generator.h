// The code generator: LLVM behind a table of functions.
//
// Internal to jit/. libLLVM takes four times as long to load as a small run takes, so everything
// that needs it is a module, `libcascade_llvm.so`, which is loaded when code must be made that no
// cache has. It is found as shared libraries are, by the paths that the program, or libcascade, was
// linked with.
#pragma once

#include "jit/code_image.h"
#include "jit/jit.h"
#include "jit/kernel_shape.h"

#include <string>

namespace cascade {

/// What the module gives. All may be called from several threads; options have been checked.
struct CodeGenerator {
    /// Code of the kernel.
    Result<CodeImage> (*compile)(const CellKernel& kernel, const KernelShape& shape, int optimise);
    // The functions of jit/jit.h.
    Result<std::string> (*dump_llvm)(const CellKernel&, Stencil, const JitOptions&);
    Result<std::string> (*dump_assembly)(const CellKernel&, Stencil, const JitOptions&);
    Result<std::vector<std::uint8_t>> (*compile_object)(const ObjectContent&, Stencil,
                                                        const std::string& target);
    std::vector<std::string> (*known_targets)();
    std::string (*describe)();
};

/// Loads the module if that was not done. Fails where there is none, or one of another build.
Result<const CodeGenerator*> code_generator();

/// The name of the module's only symbol: a function that takes the `code_version` of whoever asks
/// and gives the table, or null if its own is another.
inline constexpr const char* generator_symbol = "cascade_code_generator";
using GeneratorEntry = const CodeGenerator*(const char* version);

/// Differs where the same kernel may get other code: a hash of the sources of this room and of ir/,
/// and LLVM's version.
const char* code_version();

/// Differs when the library of LLVM on this machine was replaced. Empty if that is not known.
std::string llvm_identity();

}  // namespace cascade

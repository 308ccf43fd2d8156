// The code generator: a table of functions behind which LLVM is hidden.
//
// Internal to jit/. Loading libLLVM takes longer than a small run. So all code that needs LLVM is
// in a module, `libcascade_llvm.so`, which is loaded only when a kernel is requested that is in no
// cache. The module is searched for like a shared library, in the paths with which the program or
// libcascade was linked.
#pragma once

#include "jit/code_image.h"
#include "jit/jit.h"
#include "jit/kernel_shape.h"

#include <string>

namespace cascade {

/// The functions of the module. Several threads may call them at once. Callers must check the
/// options first.
struct CodeGenerator {
    /// Compiles a kernel to machine code for this processor.
    Result<CodeImage> (*compile)(const CellKernel& kernel, const KernelShape& shape, int optimise);
    // These do what the functions of the same names in jit/jit.h do.
    Result<std::string> (*dump_llvm)(const CellKernel&, Stencil, const JitOptions&);
    Result<std::string> (*dump_assembly)(const CellKernel&, Stencil, const JitOptions&);
    Result<std::vector<std::uint8_t>> (*compile_object)(const ObjectContent&, Stencil,
                                                        const std::string& cpu);
    std::vector<std::string> (*known_targets)();
};

/// Returns the table of functions. The first call loads the module. Fails if there is no module, or
/// if it belongs to another build.
Result<const CodeGenerator*> code_generator();

/// The name of the module's only symbol, a function. It takes the caller's `code_version` and
/// returns the table, or null if the module's own version differs.
inline constexpr const char* generator_symbol = "cascade_code_generator";
using GeneratorEntry = const CodeGenerator*(const char* version);

/// A text that differs between two builds if they may generate different code for the same kernel:
/// a hash of the sources of jit/ and ir/ and of LLVM's version.
const char* code_version();

/// Fails if options are out of range.
Result<void> check_options(const JitOptions& options);

/// A text that changes when the machine's LLVM library is replaced. Empty if unknown.
std::string llvm_identity();

}  // namespace cascade

// Native code for cell kernels, by LLVM 19.
//
// The only header of this room that others include; LLVM's own headers stay inside jit/*.cpp.
#pragma once

#include "ir/backend.h"

#include <memory>
#include <string>
#include <vector>

namespace cascade {

struct JitOptions {
    int lanes = 0;      ///< Cells per vector: 4, 8 or 16; 0 takes the host's widest.
    int optimise = 2;   ///< 0 … 3, of LLVM's pipeline and code generator.
};

/// A backend whose kernels are machine code of this process. Fails if the host is not supported.
Result<std::unique_ptr<Backend>> make_jit(const JitOptions& options = {});

/// The kernel's LLVM IR after optimisation (`--dump llvm`) or its assembly (`--dump asm`).
Result<std::string> dump_llvm(const CellKernel& kernel, Stencil stencil, const JitOptions& options);
Result<std::string> dump_assembly(const CellKernel& kernel, Stencil stencil,
                                  const JitOptions& options);

/// Cascade's version of LLVM and the host's CPU name and vector width, for `--version`.
std::string describe_jit();

/// What an object file holds: a kernel under a C name.
struct ObjectOptions {
    std::string function_name;   ///< A C identifier.
    std::string target = "";     ///< A CPU as LLVM names it: "x86-64-v3", "znver4"; "" is the host.
};

/// The bytes of a relocatable object file with one function
///
///     void NAME(const float *const *fields, const unsigned char *const *masks,
///               const float *uniforms, float *const *results,
///               int64_t width, int64_t stride, int64_t row_begin, int64_t row_end);
///
/// that computes rows [row_begin, row_end): the same code and ABI as the JIT's own kernels.
Result<std::vector<std::uint8_t>> compile_object(const CellKernel& kernel, Stencil stencil,
                                                 const ObjectOptions& options);

/// CPU names that `--target` accepts for this machine's architecture.
std::vector<std::string> known_targets();

}  // namespace cascade

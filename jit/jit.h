// Native code for cell kernels, by LLVM 19.
//
// The only header of this room that others include; LLVM's own headers stay inside jit/*.cpp, and
// LLVM is loaded when the first kernel must be compiled that no cache has.
#pragma once

#include "ir/backend.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace cascade {

struct JitOptions {
    int lanes = 0;     ///< Cells of binary32 per vector: 4, 8 or 16 (half as many of binary64);
                       ///< 0 takes the host's widest.
    int optimise = 2;  ///< 0 … 3, of LLVM's code generator.
    /// Compiled kernels are kept in this folder and found there by later processes; empty: none.
    /// One that cannot be used, for whatever reason, is as good as none.
    std::filesystem::path cache = {};
};

/// A backend whose kernels are machine code of this process. Fails on options out of range. Its
/// compile() may be called from several threads, which compile different kernels at the same time,
/// and fails where LLVM cannot be loaded, if the host is not supported, and on kernels of more than
/// 20,000 instructions (about; a Laplacian counts for more); the interpreter can run those.
Result<std::unique_ptr<Backend>> make_jit(const JitOptions& options = {});

/// The LLVM IR that the kernel's code is generated from (`--dump llvm`), or its assembly
/// (`--dump asm`).
Result<std::string> dump_llvm(const CellKernel& kernel, Stencil stencil, const JitOptions& options);
Result<std::string> dump_assembly(const CellKernel& kernel, Stencil stencil,
                                  const JitOptions& options);

/// Cascade's version of LLVM and the host's CPU name and vector width, for `--version`.
std::string describe_jit();

/// A function of an object file: a kernel under a C name.
struct NamedKernel {
    std::string name;  ///< A C identifier.
    CellKernel kernel;
};

/// Constant numbers of an object file: `extern const float NAME[]`, aligned to 64 bytes.
struct NamedNumbers {
    std::string name;  ///< A C identifier.
    std::vector<float> values;
};

/// What an object file holds.
struct ObjectContent {
    std::vector<NamedKernel> functions;
    std::vector<NamedNumbers> numbers = {};
};

/// The bytes of a relocatable object file for the CPU `target`, as LLVM names it ("x86-64-v3",
/// "znver4"; "" is the host). Each kernel becomes a function
///
///     void NAME(const float *const *fields, const unsigned char *const *masks,
///               const float *uniforms, float *const *results,
///               int64_t width, int64_t stride, int64_t row_begin, int64_t row_end, int64_t
///               is_near);
///
/// (`is_near` is not 0 where all fields are in a near cache, so that nothing need be fetched ahead;
/// for grids of several slices `int64_t slice_rows, int64_t slice` come after: row j of slice k is
/// then row k * slice_rows + j, slice_rows is the height plus 2, and a call stays in one slice)
/// (of kernels of binary64 with double for float) that computes rows [row_begin, row_end): the same
/// code and ABI as the JIT's own kernels. It calls nothing. Planes are laid out as in PlaneLayout:
/// pointers are to cell (0, 0), of numbers aligned to 64 bytes and of masks to 16; `stride` is a
/// multiple of 16 elements, with 16 or more before and after each row; `width` is at least 1. The
/// bits are those of a run if the processor flushes denormal inputs and results meanwhile (FTZ and
/// DAZ on x86). Kernels for linked cells are refused.
Result<std::vector<std::uint8_t>> compile_object(const ObjectContent& content, Stencil stencil,
                                                 const std::string& target);

/// CPU names that `--target` accepts for this machine's architecture.
std::vector<std::string> known_targets();

}  // namespace cascade

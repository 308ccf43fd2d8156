// Native code for cell kernels, by LLVM 19.
//
// The only header of this room that others include. LLVM's own headers stay inside jit/*.cpp, and
// LLVM is loaded for the first kernel that no cache has.
#pragma once

#include "ir/backend.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace cascade {

struct JitOptions {
    int lanes = 0;     ///< Cells of binary32 per vector: 4, 8 or 16 (half as many of binary64); 0
                       ///< for the host's widest.
    int optimise = 2;  ///< 0 … 3, of LLVM's code generator.
    /// Compiled kernels are stored in this folder for later processes. If it is empty or cannot be
    /// used, none are.
    std::filesystem::path cache = {};
};

/// Is LLVM part of this build? Without it, all code generation below fails.
bool has_jit();

/// A backend whose kernels are machine code in this process. Fails on options out of range. Several
/// threads may call its compile(), and compile different kernels at the same time. It fails if LLVM
/// cannot be loaded or does not support the host, and on kernels of more than about 20,000
/// instructions (a Laplacian counts for more), which the interpreter can run.
Result<std::unique_ptr<Backend>> make_jit(const JitOptions& options = {});

/// The LLVM IR of the kernel's code (`--dump llvm`), or its assembly (`--dump asm`).
Result<std::string> dump_llvm(const CellKernel& kernel, Stencil stencil, const JitOptions& options);
Result<std::string> dump_assembly(const CellKernel& kernel, Stencil stencil,
                                  const JitOptions& options);

/// Cascade's version of LLVM and the host's vector width, for `--version`. Does not load LLVM.
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

/// Kernels as a relocatable object file for the CPU `cpu`, as LLVM names it ("x86-64-v3", "znver4";
/// "" is the host). Returns the file's bytes. Each kernel becomes a function, in kernels of
/// binary64 with double for float:
///
///     void NAME(const float *const *fields, const unsigned char *const *masks,
///               const float *uniforms, float *const *results,
///               int64_t column_begin, int64_t column_end, int64_t stride,
///               int64_t row_begin, int64_t row_end, int64_t is_near);
///
/// It computes columns [column_begin, column_end) of rows [row_begin, row_end) by the same code as
/// the JIT, and calls no functions.
///
/// - `fields`, `masks`, `uniforms` and `results` have an entry for each slot of the kernel.
/// Pointers
///   are to cell (0, 0) of planes in the layout of PlaneLayout, aligned to 64 bytes for numbers and
///   to 16 for masks.
/// - `column_begin` is a multiple of 16, and so is `column_end`, unless it is the number of cells
/// in
///   a row. There is at least one column. `stride` is the number of elements from a row to the
///   next, a multiple of 16. At least 16 elements lie before and after the cells of a row.
/// - `is_near` is 0, or 1 if all fields are in a near cache and need no prefetches.
/// - Kernels for grids of several slices have two more arguments, `int64_t slice_rows` and
///   `int64_t slice`. Row j of slice k is then row k * slice_rows + j, where slice_rows is the
///   height plus 2, and all rows of a call lie in the slice `slice`.
///
/// The bits equal a run's if the processor flushes denormal inputs and results meanwhile (FTZ and
/// DAZ on x86). Fails on kernels for linked cells, on invalid C names, and on unknown CPUs.
Result<std::vector<std::uint8_t>> compile_object(const ObjectContent& content, Stencil stencil,
                                                 const std::string& cpu);

/// CPU names that `--target` accepts for this machine's architecture.
std::vector<std::string> known_targets();

}  // namespace cascade

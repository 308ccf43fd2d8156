// Native code for cell kernels, made by LLVM 19.
//
// This is the only header of jit/ that other rooms include. LLVM's own headers are included only by
// jit/*.cpp, and LLVM is loaded only when a kernel is requested that is in no cache.
#pragma once

#include "ir/backend.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace cascade {

struct JitOptions {
    /// The number of cells of binary32 per vector: 4, 8 or 16. A vector has half as many cells of
    /// binary64. 0 selects the host's widest vectors.
    int lanes = 0;
    int optimise = 2;  ///< The optimisation level of LLVM's code generator, 0 … 3.
    /// The folder in which compiled kernels are stored for later processes. Kernels are not stored
    /// if the folder is empty or cannot be used.
    std::filesystem::path cache = {};
};

/// Whether LLVM is part of this build. Without it, all code generation below fails.
bool has_jit();

/// A backend whose kernels are machine code in this process. Fails if options are out of range.
/// Several threads may call compile() at once, to compile different kernels at the same time.
/// compile() fails if LLVM cannot be loaded or does not support the host. It also fails for kernels
/// of more than about 20,000 instructions (a Laplacian counts as several), which the interpreter
/// can run.
Result<std::unique_ptr<Backend>> make_jit(const JitOptions& options = {});

/// The LLVM IR of a kernel (`--dump llvm`), or its assembly (`--dump asm`).
Result<std::string> dump_llvm(const CellKernel& kernel, Stencil stencil, const JitOptions& options);
Result<std::string> dump_assembly(const CellKernel& kernel, Stencil stencil,
                                  const JitOptions& options);

/// Text for `--version`: the version of LLVM and the host's vector width. Does not load LLVM.
std::string describe_jit();

/// A function of an object file: a kernel, and the function's name in C.
struct NamedKernel {
    std::string name;  ///< A C identifier.
    CellKernel kernel;
};

/// An array of constants of an object file, `extern const float NAME[]`, aligned to 64 bytes.
struct NamedNumbers {
    std::string name;  ///< A C identifier.
    std::vector<float> values;
};

/// The content of an object file.
struct ObjectContent {
    std::vector<NamedKernel> functions;
    std::vector<NamedNumbers> numbers = {};
};

/// Compiles kernels to a relocatable object file for a CPU. `cpu` is LLVM's name of it
/// ("x86-64-v3", "znver4"); "" is the host. Returns the file's bytes. Each kernel becomes a
/// function. In kernels of binary64, read double for float:
///
///     void NAME(const float *const *fields, const unsigned char *const *masks,
///               const float *uniforms, float *const *results,
///               int64_t column_begin, int64_t column_end, int64_t stride,
///               int64_t row_begin, int64_t row_end, int64_t is_near);
///
/// The function computes columns [column_begin, column_end) of rows [row_begin, row_end). It
/// consists of the same code that the JIT generates, and calls no functions.
///
/// - `fields`, `masks`, `uniforms` and `results` have an entry for each slot of the kernel.
///   Pointers are to cell (0, 0) of planes in the layout of PlaneLayout, aligned to 64 bytes for
///   numbers and to 16 bytes for masks.
/// - `column_begin` is a multiple of 16. So is `column_end`, unless it is the number of cells in a
///   row. There is at least one column. `stride` is the number of elements from a row to the next,
///   a multiple of 16. At least 16 elements are before and after the cells of a row.
/// - `is_near` is 1 if all fields are in a near cache and need no prefetches, else 0.
/// - Kernels for grids of several slices have two more arguments of type int64_t, `slice_rows` and
///   `slice`. Row j of slice k is then row k * slice_rows + j, where slice_rows is the height plus
///   2. All rows of a call must be in the slice `slice`.
///
/// The results have the same bits as the results of a run if the processor flushes denormal inputs
/// and results while the function runs (FTZ and DAZ on x86). Fails for kernels for linked cells,
/// for invalid C names, and for unknown CPUs.
Result<std::vector<std::uint8_t>> compile_object(const ObjectContent& content, Stencil stencil,
                                                 const std::string& cpu);

/// The CPU names that `--target` accepts for this machine's architecture.
std::vector<std::string> known_targets();

}  // namespace cascade

// Cell kernels as WebAssembly modules. A browser compiles a module in milliseconds. Modules use the
// memory of their caller. They need SIMD of 128 bits and no other extension. Relaxed SIMD would
// give results that depend on the machine.
//
// This is the only header of wasm/ that other rooms include.
#pragma once

#include "core/grid.h"
#include "core/result.h"
#include "ir/cell_kernel.h"

#include <cstdint>
#include <vector>

namespace cascade {

struct WasmOptions {
    /// If true, denormal numbers are flushed wherever an x86 processor would flush them, which
    /// takes several times as long. If false, only results are flushed, and the bits match the
    /// interpreter's after keep_denormals().
    bool is_exact = false;
};

/// The bytes of a module for a kernel that runs on grids with this stencil. Fails for kernels with
/// a multiply_add, which WebAssembly does not have, and for kernels of more than 20,000
/// instructions.
///
/// The module imports only the memory "env" "memory" and exports only the function "run":
///
///     const module = new WebAssembly.Module(bytes);
///     const {run} = new WebAssembly.Instance(module, {env: {memory}}).exports;
///     run(fields, masks, uniforms, results, column_begin, column_end, stride, row_begin, row_end);
///
/// All arguments are 32-bit integers, and there is no result. Addresses are counted in bytes from
/// the beginning of the memory:
///
/// - `fields`, `masks` and `results` are addresses of tables. A table has an address (32 bits,
///   little endian) for each slot: the address of cell (0, 0, 0) of a plane in the layout of
///   PlaneLayout. Planes of fields and results contain floats, and planes of masks contain bytes.
///   `uniforms` is the address of one float for each slot. In kernels of binary64 all floats are
///   doubles. If the kernel has no slots of a kind, the argument may be 0.
/// - The function computes columns [column_begin, column_end), at least one, of rows [row_begin,
///   row_end). `column_begin` is a multiple of 16. So is `column_end`, unless it is the number of
///   cells in a row. `stride` is PlaneLayout::stride.
/// - As ir/backend.h allows, an output may be a field that sole_results() names. Kernels may
///   overwrite the padding after the last cell of a row, up to a multiple of 16 cells.
/// - Fields that are read in other cells must have their halo filled.
///
/// More arguments depend on the stencil:
///
/// - Grids of one slice: `left_column` and `right_column`, the members of HaloColumns. The function
///   copies these columns to columns −1 and `column_end` of each computed row. `column_end` must
///   then be the end of the row. −1 and −1 mean no copies.
/// - Grids of several slices: `slice_rows` and `slice`. Row j of slice k is row k * slice_rows + j,
///   where slice_rows is the height plus 2 (PlaneLayout::slice_rows()). All rows of a call must be
///   in the slice `slice`.
/// - Linked cells, which are computed in whole rows: the addresses of the arrays of a LinkTable:
///   `starts`, `bases`, `offsets`, `weights`, the gradient's x, y and z, and `filled`. An address
///   that the kernel does not need may be 0.
///
/// A caller that is itself WebAssembly, such as the engine of pages, puts `run` into its table of
/// functions. The index there is a function pointer, whose arguments have the type int32_t.
Result<std::vector<std::uint8_t>> wasm_module(const CellKernel& kernel, Stencil stencil,
                                              const WasmOptions& options = {});

}  // namespace cascade

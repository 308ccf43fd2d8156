// Cell kernels as WebAssembly modules, which a browser compiles in milliseconds and which share the
// memory of their caller. Uses SIMD of 128 bits and no other extension, least of all relaxed SIMD,
// whose results depend on the machine.
//
// The only header of this room that others include.
#pragma once

#include "core/grid.h"
#include "core/result.h"
#include "ir/cell_kernel.h"

#include <cstdint>
#include <vector>

namespace cascade {

struct WasmOptions {
    /// Flushes denormal numbers wherever a processor that flushes them would, which takes several
    /// times as long. Without it only results are flushed, and the bits match the interpreter's
    /// after keep_denormals().
    bool is_exact = false;
};

/// The bytes of a module for a kernel that runs on grids of a stencil. Fails on kernels with a
/// multiply_add, which WebAssembly does not have, and on kernels of more than 20,000 instructions.
///
/// The module only imports the memory "env" "memory" and exports the function "run":
///
///     const module = new WebAssembly.Module(bytes);
///     const {run} = new WebAssembly.Instance(module, {env: {memory}}).exports;
///     run(fields, masks, uniforms, results, column_begin, column_end, stride, row_begin, row_end);
///
/// All arguments are integers of 32 bits, and there is no result. Addresses are numbers of bytes
/// from the beginning of the memory:
///
/// - `fields`, `masks` and `results` are addresses of tables with an address (32 bits, little
///   endian) for each slot: of cell (0, 0, 0) of a plane in the layout of PlaneLayout, of float, of
///   bytes, and of float. `uniforms` is the address of a float for each slot. In kernels of
///   binary64 all these numbers are double. Arguments for which the kernel has no slots may be 0.
/// - Columns [column_begin, column_end) of rows [row_begin, row_end) are computed, at least one
///   column. `column_begin` is a multiple of 16, and so is `column_end`, unless it is the number of
///   cells in a row. `stride` is PlaneLayout::stride.
/// - As backend.h allows, an output may be a field that sole_results() names, and cells of the
///   output after the last one of a row, up to a multiple of 16, get any values.
/// - The halo of fields that are read in other cells has been filled.
///
/// More arguments depend on the stencil:
///
/// - Grids of one slice: `left_column` and `right_column`, HaloColumns that each computed row
///   copies to its columns −1 and `column_end`, which then is the end of the row; −1 and −1: none.
/// - Grids of several slices: `slice_rows` and `slice`. Row j of slice k is row
///   k * slice_rows + j, where slice_rows is the height plus 2 (PlaneLayout::slice_rows()), and all
///   rows of a call lie in the slice `slice`.
/// - Linked cells, which are computed in whole rows: the addresses of the arrays of a LinkTable:
///   `starts`, `bases`, `offsets`, `weights`, the gradient's x, y and z, and `filled`. Addresses
///   that the kernel does not need may be 0.
///
/// An engine that is WebAssembly itself puts `run` into its table of functions. There it is a
/// function pointer with that many arguments of type int32_t.
Result<std::vector<std::uint8_t>> wasm_module(const CellKernel& kernel, Stencil stencil,
                                              const WasmOptions& options = {});

}  // namespace cascade

// Runs kernels on hostile inputs and compares what executors make of them.
#pragma once

#include "core/links.h"
#include "core/plane.h"
#include "ir/backend.h"
#include "tests/support/random_stream.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cascade::test {

/// Arguments for a kernel on a grid, made from a seed: ordinary numbers, and among them NaN,
/// infinities, zeros of both signs, denormals and huge numbers. Halos of fields are filled; memory
/// that kernels have no business with holds NaN. Inputs of even seeds are said to be near. A linked
/// grid gets random links, in which its last row may be filled up.
class HostileInputs {
public:
    HostileInputs(const CellKernel& kernel, const Grid& grid, std::uint64_t seed);

    /// Runs a kernel on some or all cells, into new planes.
    std::vector<Field> run(const Kernel& kernel) const;
    std::vector<Field> run(const Kernel& kernel, const Patch& cells) const;
    /// From now on kernels that can fill columns of the halo are told to.
    void fill_columns(HaloColumns columns) { columns_ = columns; }

private:
    template <typename Number>
    void fill(const CellKernel& kernel, RandomStream& stream);
    template <typename Number>
    std::vector<Field> run_as(const Kernel& kernel, const Patch& cells) const;

    Grid grid_;
    Precision precision_;
    bool is_near_;
    std::optional<HaloColumns> columns_;
    std::size_t result_count_;
    std::vector<Field> fields_;
    Links links_;  ///< Of a linked grid.
    std::vector<Mask> masks_;
    std::vector<std::uint64_t> uniforms_;  ///< Words.
};

/// Compiles `kernel` with `backend` and runs it on the inputs that belong to `seed`.
std::vector<Field> run_kernel(Backend& backend, const CellKernel& kernel, const Grid& grid,
                              std::uint64_t seed);

/// Empty if both hold the same words in all cells, where all NaN are the same; else the first
/// difference: result, cell, both words.
std::string same_bits(const std::vector<Field>& a, const std::vector<Field>& b);

/// Empty if a run wrote only what backend.h allows: these cells, and after the last cell of a row
/// up to the next multiple of row_pad, and, if they were to be filled, the columns of the halo
/// beside them. Else the first place that was touched. Only for planes made by HostileInputs::run.
std::string stray_writes(const std::vector<Field>& results, const Patch& cells,
                         bool with_columns = false);

/// Linked cells in 1 … max_height rows of 1 … max_width.
Grid random_linked_grid(std::uint64_t seed, std::int64_t max_width, std::int64_t max_height);

/// A grid of 1 … max_width × 1 … max_height cells, more than half of the time of up to max_depth
/// slices, with any boundary along each axis.
Grid random_grid(std::uint64_t seed, std::int64_t max_width, std::int64_t max_height,
                 std::int64_t max_depth = 1);

}  // namespace cascade::test

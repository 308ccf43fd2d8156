// Runs kernels on hostile inputs and compares the results of executors.
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
/// infinities, zeros of both signs, denormals and huge numbers. Halos of fields are filled. Memory
/// that kernels must not read contains NaN. With even seeds inputs count as near
/// (KernelArgumentsOf::is_near). A linked grid gets random links, whose last row may be padded.
class HostileInputs {
public:
    HostileInputs(const CellKernel& kernel, const Grid& grid, std::uint64_t seed);

    /// Runs a kernel on some or all cells, into new planes.
    std::vector<Field> run(const Kernel& kernel) const;
    std::vector<Field> run(const Kernel& kernel, const Patch& cells) const;
    /// Makes kernels fill these columns of the halo from now on, if they can.
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
    Links links_;  ///< The links of a linked grid.
    std::vector<Mask> masks_;
    std::vector<std::uint64_t> uniforms_;  ///< The words of uniforms.
};

/// Compiles `kernel` with `backend` and runs it on the inputs that belong to `seed`.
std::vector<Field> run_kernel(Backend& backend, const CellKernel& kernel, const Grid& grid,
                              std::uint64_t seed);

/// Empty if both contain the same words in all cells, where all NaN count as equal. Otherwise the
/// first difference: the result's index, the cell, and both words.
std::string same_bits(const std::vector<Field>& a, const std::vector<Field>& b);

/// Empty if a run wrote only what backend.h allows: these cells, the padding after the last cell of
/// a row up to the next multiple of row_pad, and the halo's columns beside the cells if they were
/// to be filled. Otherwise the first wrong position. Only for planes from HostileInputs::run.
std::string stray_writes(const std::vector<Field>& results, const Patch& cells,
                         bool with_columns = false);

/// Linked cells in 1 … max_height rows of 1 … max_width.
Grid random_linked_grid(std::uint64_t seed, std::int64_t max_width, std::int64_t max_height);

/// A grid of 1 … max_width × 1 … max_height cells, in more than half of the cases with up to
/// max_depth slices, with any boundary along each axis.
Grid random_grid(std::uint64_t seed, std::int64_t max_width, std::int64_t max_height,
                 std::int64_t max_depth = 1);

}  // namespace cascade::test

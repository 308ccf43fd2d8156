// The plan by which the interpreter computes a kernel in blocks of 256 cells (internal to ir).
//
// Uniform values (constants, uniforms, and values computed from these alone) are single words,
// computed once per run. All other values are in registers of 256 words. A register is reused as
// soon as no later instruction reads its value, so a chain of a million operations needs two
// registers.
#pragma once

#include "ir/block_loops.h"
#include "ir/cell_kernel.h"

#include <array>
#include <cstdint>
#include <vector>

namespace cascade::interpreting {

inline constexpr std::int64_t block_cells = 256;

/// Where a value is stored while a block is computed.
struct Location {
    enum class Kind : std::uint8_t {
        nowhere,  ///< The operation has no such operand.
        scalar,   ///< The value is uniform. `index` is the number of the scalar.
        field,    ///< The value is in memory, in the cell itself. `index` is a field slot.
        /// The value is in memory, in a neighbouring cell. `index` is a Neighbour's payload.
        beside,
        vector,  ///< The value is in a register. `index` is the number of the register.
    };
    Kind kind = Kind::nowhere;
    std::uint32_t index = 0;
};

/// An instruction that is computed once per run, because its value is uniform.
struct ScalarStep {
    Op op = Op::constant;
    std::uint64_t payload = 0;
    std::array<std::uint32_t, 3> operands{};  ///< Indices of scalars.
};

/// An instruction that is computed into a register once per block, or once per link of the block's
/// cells.
template <typename Number>
struct BlockStep {
    Op op = Op::constant;
    std::uint64_t payload = 0;  ///< The slot or the two slots that `op` reads.
    std::uint32_t target = 0;
    std::array<Location, 3> operands{};
    BlockLoop<Number> loop = nullptr;  ///< Null if the result depends on more than the operands.
};

/// Reduces a value of links to a value of cells. The result is in register `target`.
struct Reduction {
    Op op = Op::link_sum;
    std::uint32_t target = 0;
    Location operand;
};

/// Steps and the reductions that read their results. Without reductions, each step is computed once
/// per block; with reductions, once for each link.
template <typename Number>
struct Section {
    std::vector<BlockStep<Number>> steps;
    std::vector<Reduction> reductions;
};

template <typename Number>
struct Plan {
    std::vector<ScalarStep> scalar_steps;  ///< Step k computes scalar k.
    std::vector<Section<Number>> sections = std::vector<Section<Number>>(1);
    std::vector<Location> results;
    std::uint32_t register_count = 0;
};

/// Assigns a location to every value of a kernel. `Number` is float or double, according to the
/// kernel's precision.
template <typename Number>
Plan<Number> plan_blocks(const CellKernel& kernel);

extern template Plan<float> plan_blocks(const CellKernel& kernel);
extern template Plan<double> plan_blocks(const CellKernel& kernel);

}  // namespace cascade::interpreting

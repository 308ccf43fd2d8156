// How the interpreter computes a kernel, block by block of 256 cells (internal to ir).
//
// Uniform values (constants, uniforms and what is computed from them) are single words, computed
// once per run. All others are in registers of 256 words, which are reused as soon as no later
// instruction reads them: a chain of a million operations needs two.
#pragma once

#include "ir/block_loops.h"
#include "ir/cell_kernel.h"

#include <array>
#include <cstdint>
#include <vector>

namespace cascade::interpreting {

inline constexpr std::int64_t block_cells = 256;

/// The location of a value while a block is computed.
struct Location {
    enum class Kind : std::uint8_t {
        nowhere,  ///< For operands that an operation does not have.
        scalar,   ///< Uniform: `index` counts scalars.
        field,    ///< In memory: `index` is a field slot.
        beside,   ///< In memory: `index` is the payload of a neighbour.
        vector,   ///< In a register: `index` counts registers.
    };
    Kind kind = Kind::nowhere;
    std::uint32_t index = 0;
};

/// An instruction that is computed once per run.
struct ScalarStep {
    Op op = Op::constant;
    std::uint64_t payload = 0;
    std::array<std::uint32_t, 3> operands{};  ///< Scalars.
};

/// An instruction that is computed once per block, or once per link of its cells, into a register.
template <typename Number>
struct BlockStep {
    Op op = Op::constant;
    std::uint64_t payload = 0;  ///< A slot, or two.
    std::uint32_t target = 0;
    std::array<Location, 3> operands{};
    BlockLoop<Number> loop = nullptr;  ///< For operations that only depend on their operands.
};

/// A value of cells that is computed from one of each link, in a register.
struct Reduction {
    Op op = Op::link_sum;
    std::uint32_t target = 0;
    Location operand;
};

/// Steps that are computed once per block, or for each link if there are reductions.
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

/// Assigns a location to every value of a kernel. `Number` is float or double, by its
/// precision.
template <typename Number>
Plan<Number> plan_blocks(const CellKernel& kernel);

extern template Plan<float> plan_blocks(const CellKernel& kernel);
extern template Plan<double> plan_blocks(const CellKernel& kernel);

}  // namespace cascade::interpreting

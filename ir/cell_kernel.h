// Cell kernels. A kernel is the computation that a stage performs in each cell, as a program
// without loops.
//
// A kernel is a list of instructions in static single assignment. An instruction's position
// identifies its value, and an instruction reads only values of earlier instructions. The only
// control flow is `select`. A kernel does not say which cells are neighbours (the executor's
// stencil does) or where fields are in memory (KernelArguments does). A kernel cannot fail when it
// runs, because lang/ reports users' errors before it makes a kernel.
#pragma once

#include "core/id.h"
#include "core/precision.h"
#include "ir/word_format.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// The operations of operations.def.
enum class Op : std::uint8_t {
#define CASCADE_OPERATION(name, arity, payload, meaning) name,
#include "ir/operations.def"
#undef CASCADE_OPERATION
};

enum class PayloadKind : std::uint8_t { none, bits, field, neighbour, flow, mask, uniform };

/// A row of ir/operations.def.
struct OpInfo {
    std::string_view name;
    int arity;
    PayloadKind payload;
    std::string_view meaning;
};
const OpInfo& info(Op op);
inline constexpr int op_count = 0
#define CASCADE_OPERATION(name, arity, payload, meaning) +1
#include "ir/operations.def"
#undef CASCADE_OPERATION
    ;

/// The number of values that an operation reads, at compile time.
constexpr int info_arity(Op op) {
    switch (op) {
#define CASCADE_OPERATION(name, arity, payload, meaning) \
    case Op::name:                                       \
        return arity;
#include "ir/operations.def"
#undef CASCADE_OPERATION
    }
    return 0;
}

/// The index of the instruction that computes a value.
using ValueId = Id<struct ValueTag>;
// Indices into a kernel's lists of fields, masks and uniforms.
using FieldSlot = Id<struct FieldSlotTag>;
using MaskSlot = Id<struct MaskSlotTag>;
using UniformSlot = Id<struct UniformSlotTag>;

struct Instruction {
    Op op = Op::constant;
    /// The first `info(op).arity` elements are the operands. The other elements are 0.
    std::array<ValueId, 3> operands{};
    /// The bits of a word, or a slot, as `op` requires; 0 if `op` has no payload.
    std::uint64_t payload = 0;

    /// The slot that the instruction reads. The payload of `op` must be a slot.
    std::uint32_t slot() const { return static_cast<std::uint32_t>(payload); }
    FieldSlot field() const { return FieldSlot(payload); }

    friend bool operator==(const Instruction&, const Instruction&) = default;
};

/// The payload of the operation `neighbour`: the field in `slot`, read `dx` columns, `dy` rows and
/// `dz` slices away. Each offset is −1, 0 or 1, and not all are 0. Along an axis that has only one
/// cell, executors treat the offset as 0.
struct Neighbour {
    FieldSlot slot;  ///< Less than 2^27, so that payload() fits in 32 bits.
    int dx = 0, dy = 0, dz = 0;

    static constexpr std::uint32_t offset_count = 32, last_offset = 26, own_offset = 13;

    /// The payload: 32 · slot + (dx + 1) + 3 (dy + 1) + 9 (dz + 1).
    constexpr std::uint32_t payload() const {
        return offset_count * slot.index() +
               static_cast<std::uint32_t>(dx + 1 + 3 * (dy + 1) + 9 * (dz + 1));
    }
    static constexpr Neighbour of(std::uint32_t payload) {
        const int offset = static_cast<int>(payload % offset_count);
        return {FieldSlot(payload / offset_count), offset % 3 - 1, offset / 3 % 3 - 1,
                offset / 9 - 1};
    }
};

/// The payload of the operations `link_flow` and `link_weighted`: the field `of`, whose differences
/// are summed, and the field `factor`. In link_flow each difference is multiplied by the sum of the
/// field `factor` in the two cells of the link. In link_weighted each difference is multiplied by
/// the number that the plane of `factor` has for the link (Links::numbers_of).
struct Flow {
    FieldSlot factor, of;

    constexpr std::uint64_t payload() const {
        return std::uint64_t{factor.index()} << 32 | of.index();
    }
    static constexpr Flow with(std::uint64_t payload) {
        return {FieldSlot(payload >> 32), FieldSlot(payload)};
    }
};

/// Whether an operation sums differences over the links of a cell. A Laplacian is such a sum only
/// on linked cells.
constexpr bool is_link_sum(Op op) {
    return op == Op::laplacian || op == Op::link_flow || op == Op::link_squares ||
           op == Op::link_weighted || op == Op::gradient_x || op == Op::gradient_y ||
           op == Op::gradient_z;
}

/// Whether the payload of an operation is a Flow.
constexpr bool has_flow(Op op) { return op == Op::link_flow || op == Op::link_weighted; }

/// Whether an operation reduces the values of a cell's links to one value of the cell.
constexpr bool is_link_reduction(Op op) {
    return op == Op::link_sum || op == Op::link_least || op == Op::link_greatest;
}

/// The program of one cell. `results[k]` is the value stored in output field k. Slots are indices
/// into the lists of names. Names appear only in dumps and messages.
struct CellKernel {
    IdVector<ValueId, Instruction> code;
    std::vector<ValueId> results;
    IdVector<FieldSlot, std::string> field_names;
    IdVector<MaskSlot, std::string> mask_names;
    IdVector<UniformSlot, std::string> uniform_names;
    std::vector<std::string> result_names;
    Precision precision = Precision::single;  ///< The precision of all words.
    std::vector<ValueId> kept = {};  ///< Values excluded from contraction (ir/contraction.h).

    /// Whether any instruction reads this field in other cells. If so, the field's halo must be
    /// filled before the kernel runs on a grid.
    bool reads_neighbours(FieldSlot slot) const;
};

/// For each value, whether it can differ between cells. Only values that depend on more than
/// constants and uniforms can.
IdVector<ValueId, bool> varying(const CellKernel& kernel);

/// For each field, the only result that is computed from the field. That result may overwrite the
/// field. nullopt if several results are computed from the field, or if an instruction reads the
/// field in other cells.
IdVector<FieldSlot, std::optional<std::size_t>> sole_results(const CellKernel& kernel);

/// A hash of everything that determines the generated code. Names do not change the hash.
std::uint64_t hash(const CellKernel& kernel);

/// The kernel as text, one value per line: `%7 = multiply %3, %5`. The format is stable.
std::string print(const CellKernel& kernel);

/// Checks that each operand is computed before it is used, that slots and results exist, and that
/// no result is of link level (ir/operations.def). Returns a description of the error, or an empty
/// text. Tests and debug builds call verify() after every pass that makes a kernel.
std::string verify(const CellKernel& kernel);

}  // namespace cascade

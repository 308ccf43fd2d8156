// Cell kernels: what a stage computes per cell, as one flat program.
//
// A kernel is a list of instructions in static single assignment: an instruction's position names
// its value, and it only reads earlier values. The only control flow is `select`. A kernel does not
// know which cells are neighbours (the executor's stencil does) or where fields are in memory
// (KernelArguments does). It cannot fail: lang/ finds users' errors.
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

/// A row of the table.
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
    std::array<ValueId, 3> operands{};  ///< The first `info(op).arity` count; others are 0.
    std::uint64_t payload = 0;          ///< Bits of a word, or a slot; 0 if unused.

    /// The payload of an instruction that reads a slot.
    std::uint32_t slot() const { return static_cast<std::uint32_t>(payload); }
    FieldSlot field() const { return FieldSlot(payload); }

    friend bool operator==(const Instruction&, const Instruction&) = default;
};

/// The operands of `neighbour`: the field in `slot`, `dx` columns, `dy` rows and `dz` slices away.
/// Each offset is −1, 0 or 1, and not all are 0. Executors treat an offset along an axis of one
/// cell as 0.
struct Neighbour {
    FieldSlot slot;  ///< Below 2^27.
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

/// The operands of `link_flow`: the field `of`, whose differences flow, and the field `factor`,
/// whose mean over the two cells multiplies them.
struct Flow {
    FieldSlot factor, of;

    constexpr std::uint64_t payload() const {
        return std::uint64_t{factor.index()} << 32 | of.index();
    }
    static constexpr Flow with(std::uint64_t payload) {
        return {FieldSlot(payload >> 32), FieldSlot(payload)};
    }
};

/// Whether an operation is a sum over the links of a cell, on a surface.
constexpr bool is_link_sum(Op op) {
    return op == Op::laplacian || op == Op::link_flow || op == Op::link_squares ||
           op == Op::gradient_x || op == Op::gradient_y || op == Op::gradient_z;
}

/// Whether an operation computes a value of a cell from values of its links.
constexpr bool is_link_reduction(Op op) {
    return op == Op::link_sum || op == Op::link_least || op == Op::link_greatest;
}

/// The program of one cell. `results[k]` is the value stored in output field k. Slot numbers are
/// indices into the lists of slot names, which serve dumps and messages.
struct CellKernel {
    IdVector<ValueId, Instruction> code;
    std::vector<ValueId> results;
    IdVector<FieldSlot, std::string> field_names;
    IdVector<MaskSlot, std::string> mask_names;
    IdVector<UniformSlot, std::string> uniform_names;
    std::vector<std::string> result_names;
    Precision precision = Precision::single;  ///< The precision of all words.
    std::vector<ValueId> kept = {};  ///< Values excluded from contraction (ir/contraction.h).

    /// Whether some instruction reads this field slot in other cells, which needs the halo on
    /// grids.
    bool reads_neighbours(FieldSlot slot) const;
};

/// For each value, whether it can differ between cells: whether it depends on more than uniforms.
IdVector<ValueId, bool> varying(const CellKernel& kernel);

/// For each field, the only result that is computed from it. That result may overwrite the field.
/// nullopt if several results are or if the field is read in other cells.
IdVector<FieldSlot, std::optional<std::size_t>> sole_results(const CellKernel& kernel);

/// A hash of all properties that determine the generated code, which excludes names.
std::uint64_t hash(const CellKernel& kernel);

/// The kernel as text, one value per line: `%7 = multiply %3, %5`. The format is stable.
std::string print(const CellKernel& kernel);

/// Checks that operands precede their users, that slots and results exist, and that no result is of
/// link level (operations.def). Returns the error or an empty text. Tests and debug builds call it
/// after every pass that makes a kernel.
std::string verify(const CellKernel& kernel);

}  // namespace cascade

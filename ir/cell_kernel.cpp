// The table of operations. Prints, hashes and verifies kernels.
#include "ir/cell_kernel.h"

#include "core/check.h"
#include "ir/loop_levels.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace cascade {
namespace {

constexpr OpInfo table[] = {
#define CASCADE_OPERATION(name, arity, payload, meaning) \
    {#name, arity, PayloadKind::payload, meaning},
#include "ir/operations.def"
#undef CASCADE_OPERATION
};

/// One step of a multiplicative hash. The shift mixes high bits into the low bits, because hash
/// tables take their index from the low bits.
std::uint64_t mix(std::uint64_t hash, std::uint64_t value) {
    hash = (hash ^ value) * 0x9e3779b97f4a7c15ULL;
    return hash ^ (hash >> 32);
}

template <typename Slot>
std::string slot_text(const IdVector<Slot, std::string>& names, Slot slot) {
    if (slot < names.next()) return fmt::format(" {}", names[slot]);
    return fmt::format(" slot {} of {}", slot.index(), names.size());
}

std::string payload_text(const CellKernel& kernel, const Instruction& instruction) {
    const std::uint32_t payload = instruction.slot();
    switch (info(instruction.op).payload) {
        case PayloadKind::none: return "";
        case PayloadKind::bits:
            if (kernel.precision == Precision::single) {
                return fmt::format(" 0x{:08x}  # {}", payload, to_number(payload));
            }
            return fmt::format(" 0x{:016x}  # {}", instruction.payload,
                               number_of(instruction.payload, kernel.precision));
        case PayloadKind::field: return slot_text(kernel.field_names, instruction.field());
        case PayloadKind::neighbour: {
            const Neighbour at = Neighbour::of(payload);
            return fmt::format("{} at ({}, {}, {})", slot_text(kernel.field_names, at.slot), at.dx,
                               at.dy, at.dz);
        }
        case PayloadKind::flow: {
            const Flow flow = Flow::with(instruction.payload);
            return fmt::format("{} times{}", slot_text(kernel.field_names, flow.of),
                               slot_text(kernel.field_names, flow.factor));
        }
        case PayloadKind::mask: return slot_text(kernel.mask_names, MaskSlot(payload));
        case PayloadKind::uniform: return slot_text(kernel.uniform_names, UniformSlot(payload));
    }
    return "";
}

std::size_t slot_count(const CellKernel& kernel, PayloadKind kind) {
    switch (kind) {
        case PayloadKind::field:
        case PayloadKind::flow:
        case PayloadKind::neighbour: return kernel.field_names.size();
        case PayloadKind::mask: return kernel.mask_names.size();
        case PayloadKind::uniform: return kernel.uniform_names.size();
        default: return 0;
    }
}

std::string verify_payload(const CellKernel& kernel, const Instruction& instruction) {
    const PayloadKind kind = info(instruction.op).payload;
    if (kind == PayloadKind::bits) {
        const bool fits = instruction.payload <= format_of(kernel.precision).all();
        return fits ? "" : "has more bits than its word";
    }
    if (kind == PayloadKind::none) {
        return instruction.payload == 0 ? "" : "has a payload but takes none";
    }
    std::uint64_t slot = instruction.payload;
    if (kind == PayloadKind::neighbour) {
        const std::uint32_t offset = slot % Neighbour::offset_count;
        if (offset > Neighbour::last_offset) return "reads farther than the next cell";
        if (offset == Neighbour::own_offset) return "reads the cell itself as a neighbour";
        slot = Neighbour::of(instruction.slot()).slot.index();
    }
    if (kind == PayloadKind::flow) {
        const Flow flow = Flow::with(instruction.payload);
        slot = std::max(flow.factor, flow.of).index();
    }
    const std::size_t slots = slot_count(kernel, kind);
    return slot < slots ? "" : fmt::format("names slot {} of {}", slot, slots);
}

std::string verify_shift(const CellKernel& kernel, const Instruction& instruction) {
    if (instruction.op != Op::bits_shift_left && instruction.op != Op::bits_shift_right) return "";
    const Instruction& amount = kernel.code[instruction.operands[1]];
    if (amount.op != Op::constant) return "shifts by an amount that is not constant";
    const auto most = static_cast<std::uint64_t>(format_of(kernel.precision).bits - 1);
    return amount.payload <= most ? "" : fmt::format("shifts by {}", amount.payload);
}

std::string verify_instruction(const CellKernel& kernel, ValueId id) {
    const Instruction& instruction = kernel.code[id];
    if (static_cast<int>(instruction.op) >= op_count) return "is no operation of the table";
    for (std::size_t k = 0; k < instruction.operands.size(); ++k) {
        const ValueId operand = instruction.operands[k];
        if (static_cast<int>(k) >= info(instruction.op).arity) {
            if (operand != ValueId{}) return "has an operand too many";
        } else if (operand >= id) {
            return fmt::format("reads %{}, which does not come before it", operand.index());
        }
    }
    if (std::string wrong = verify_payload(kernel, instruction); !wrong.empty()) return wrong;
    return verify_shift(kernel, instruction);
}

}  // namespace

static_assert(std::size(table) == static_cast<std::size_t>(op_count));

const OpInfo& info(Op op) {
    CHECK(static_cast<int>(op) < op_count, "cell kernel: the operation is one of the table");
    return table[static_cast<std::size_t>(op)];
}

bool CellKernel::reads_neighbours(FieldSlot slot) const {
    for (const Instruction& instruction : code) {
        if (instruction.op == Op::neighbour) {
            if (Neighbour::of(instruction.slot()).slot == slot) return true;
        } else if (is_link_sum(instruction.op) || instruction.op == Op::theirs) {
            if (instruction.field() == slot) return true;
            const bool is_flow = has_flow(instruction.op);
            if (is_flow && Flow::with(instruction.payload).factor == slot) return true;
        }
    }
    return false;
}

IdVector<ValueId, bool> varying(const CellKernel& kernel) {
    IdVector<ValueId, bool> varies;
    varies.reserve(kernel.code.size());
    for (const Instruction& instruction : kernel.code) {
        const auto arity = static_cast<std::size_t>(info(instruction.op).arity);
        // A reduction differs between cells even if its operand does not, because cells have
        // different numbers of links.
        bool differs =
            is_link_reduction(instruction.op) ||
            (arity == 0 && instruction.op != Op::constant && instruction.op != Op::uniform);
        for (std::size_t k = 0; k < arity; ++k) {
            differs = differs || varies[instruction.operands[k]];
        }
        varies.push_back(differs);
    }
    return varies;
}

IdVector<FieldSlot, std::optional<std::size_t>> sole_results(const CellKernel& kernel) {
    const std::size_t none = kernel.results.size(), several = none + 1;
    IdVector<ValueId, std::size_t> users(kernel.code.size(), none);
    IdVector<FieldSlot, std::size_t> readers(kernel.field_names.size(), none);
    const auto add = [&](std::size_t& known, std::size_t user) {
        known = known == none || known == user ? user : several;
    };
    for (std::size_t k = 0; k < none; ++k) add(users[kernel.results[k]], k);
    for (const ValueId id : kernel.code.ids_backwards()) {
        if (users[id] == none) continue;
        const Instruction& instruction = kernel.code[id];
        for (int k = 0; k < info(instruction.op).arity; ++k) {
            add(users[instruction.operands[static_cast<std::size_t>(k)]], users[id]);
        }
        if (instruction.op == Op::field) {
            add(readers[instruction.field()], users[id]);
        } else if (instruction.op == Op::neighbour) {
            readers[Neighbour::of(instruction.slot()).slot] = several;
        } else if (is_link_sum(instruction.op) || instruction.op == Op::theirs) {
            readers[instruction.field()] = several;
            if (has_flow(instruction.op)) {
                readers[Flow::with(instruction.payload).factor] = several;
            }
        }
    }
    IdVector<FieldSlot, std::optional<std::size_t>> sole;
    for (const std::size_t reader : readers) {
        sole.push_back(reader < none ? std::optional(reader) : std::nullopt);
    }
    return sole;
}

std::uint64_t hash(const CellKernel& kernel) {
    std::uint64_t result = mix(kernel.code.size(), kernel.results.size());
    if (kernel.precision != Precision::single) result = mix(result, bytes_of(kernel.precision));
    for (const Instruction& instruction : kernel.code) {
        const auto [a, b, c] = instruction.operands;
        result = mix(result, static_cast<std::uint64_t>(instruction.op) << 32 | a.index());
        if (info(instruction.op).arity > 1)
            result = mix(result, std::uint64_t{b.index()} << 32 | c.index());
        result = mix(result, instruction.payload);
    }
    for (const ValueId value : kernel.results) result = mix(result, value.index());
    return result;
}

std::string print(const CellKernel& kernel) {
    fmt::memory_buffer text;
    const auto out = std::back_inserter(text);
    for (const ValueId id : kernel.code.ids()) {
        const Instruction& instruction = kernel.code[id];
        const OpInfo& op = info(instruction.op);
        fmt::format_to(out, "%{} = {}", id.index(), op.name);
        for (std::size_t k = 0; static_cast<int>(k) < op.arity; ++k) {
            fmt::format_to(out, "{} %{}", k == 0 ? "" : ",", instruction.operands[k].index());
        }
        fmt::format_to(out, "{}\n", payload_text(kernel, instruction));
    }
    for (std::size_t k = 0; k < kernel.results.size(); ++k) {
        const std::string name =
            k < kernel.result_names.size() ? kernel.result_names[k] : std::to_string(k);
        fmt::format_to(out, "result {} = %{}\n", name, kernel.results[k].index());
    }
    return fmt::to_string(text);
}

std::string verify(const CellKernel& kernel) {
    for (const ValueId id : kernel.code.ids()) {
        const std::string wrong = verify_instruction(kernel, id);
        if (!wrong.empty()) return fmt::format("%{} {}", id.index(), wrong);
    }
    const IdVector<ValueId, LoopLevel> levels = loop_levels_of(kernel);
    for (std::size_t k = 0; k < kernel.results.size(); ++k) {
        const ValueId result = kernel.results[k];
        const char* const wrong = result >= kernel.code.next()        ? "does not exist"
                                  : levels[result] == LoopLevel::link ? "is of links, not of cells"
                                                                      : nullptr;
        if (wrong != nullptr) {
            return fmt::format("result {} is %{}, which {}", k, result.index(), wrong);
        }
    }
    if (kernel.result_names.size() != kernel.results.size()) {
        return fmt::format("{} results have {} names", kernel.results.size(),
                           kernel.result_names.size());
    }
    return "";
}

}  // namespace cascade

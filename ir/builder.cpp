// Emits instructions, evaluates operations on constants, and reuses equal values.
#include "ir/builder.h"

#include "core/check.h"
#include "core/floating_point.h"
#include "ir/interpreter.h"

#include <cmath>
#include <limits>
#include <optional>

namespace cascade {
namespace {

std::uint64_t hash_of(const Instruction& instruction) {
    std::uint64_t hash = static_cast<std::uint64_t>(instruction.op) + 1;
    const auto add = [&](std::uint64_t word) {
        hash = (hash ^ word) * 0x9e3779b97f4a7c15ULL;
        hash ^= hash >> 29;
    };
    for (const ValueId operand : instruction.operands) add(operand.index());
    add(instruction.payload);
    return hash;
}

template <typename Slot>
Slot slot_of(const std::string& name, IdVector<Slot, std::string>& names,
             std::unordered_map<std::string, Slot>& slots) {
    const auto [entry, is_new] = slots.try_emplace(name, names.next());
    if (is_new) names.push_back(name);
    return entry->second;
}

/// Whether the result of an operation is always read as a number, never as bits. All results that
/// are NaN are then equivalent.
bool yields_number(Op op) {
    return (op >= Op::add && op <= Op::divide) || (op >= Op::square_root && op <= Op::multiply_add);
}

/// Whether the result of an operation is the number 1 or 0.
bool yields_truth(Op op) { return op == Op::mask || (op >= Op::less && op <= Op::logical_not); }

}  // namespace

// Stores every NaN as the same word, so that kernels do not depend on which NaN the host's
// processor produces.
ValueId KernelBuilder::number(double value) {
    if (std::isnan(value)) return word(format().nan());
    const std::uint64_t bits = word_of(value, precision());
    return word(format().is_denormal(bits) ? bits & format().sign() : bits);
}

ValueId KernelBuilder::word(std::uint64_t bits) {
    return emit({Op::constant, {}, bits & format().all()});
}

FieldSlot KernelBuilder::field_slot(const std::string& name) {
    return slot_of(name, kernel_.field_names, field_slots_);
}

MaskSlot KernelBuilder::mask_slot(const std::string& name) {
    return slot_of(name, kernel_.mask_names, mask_slots_);
}

UniformSlot KernelBuilder::uniform_slot(const std::string& name) {
    return slot_of(name, kernel_.uniform_names, uniform_slots_);
}

ValueId KernelBuilder::field(FieldSlot slot) { return emit({Op::field, {}, slot.index()}); }
ValueId KernelBuilder::laplacian(FieldSlot slot) { return emit({Op::laplacian, {}, slot.index()}); }
ValueId KernelBuilder::neighbour(FieldSlot slot, int dx, int dy, int dz) {
    for (const int offset : {dx, dy, dz}) {
        CHECK(-1 <= offset && offset <= 1, "builder: a neighbour is at most one cell away");
    }
    if (dx == 0 && dy == 0 && dz == 0) return field(slot);
    return emit({Op::neighbour, {}, Neighbour{slot, dx, dy, dz}.payload()});
}

ValueId KernelBuilder::over_links(Op op, FieldSlot slot) {
    CHECK(is_link_sum(op) && !has_flow(op), "builder: it is a sum of differences of one field");
    return emit({op, {}, slot.index()});
}

ValueId KernelBuilder::link_flow(Flow flow) { return emit({Op::link_flow, {}, flow.payload()}); }
ValueId KernelBuilder::link_weighted(Flow flow) {
    return emit({Op::link_weighted, {}, flow.payload()});
}
ValueId KernelBuilder::theirs(FieldSlot slot) { return emit({Op::theirs, {}, slot.index()}); }
ValueId KernelBuilder::mask(MaskSlot slot) { return emit({Op::mask, {}, slot.index()}); }
ValueId KernelBuilder::uniform(UniformSlot slot) { return emit({Op::uniform, {}, slot.index()}); }
ValueId KernelBuilder::cell_column() { return emit({Op::cell_column, {}, 0}); }
ValueId KernelBuilder::cell_row() { return emit({Op::cell_row, {}, 0}); }
ValueId KernelBuilder::cell_slice() { return emit({Op::cell_slice, {}, 0}); }

ValueId KernelBuilder::apply(Op op, ValueId a) {
    CHECK(info(op).arity == 1, "builder: the operation takes one operand");
    return emit({op, {a}, 0});
}

ValueId KernelBuilder::apply(Op op, ValueId a, ValueId b) {
    CHECK(info(op).arity == 2, "builder: the operation takes two operands");
    return emit({op, {a, b}, 0});
}

ValueId KernelBuilder::apply(Op op, ValueId a, ValueId b, ValueId c) {
    CHECK(info(op).arity == 3, "builder: the operation takes three operands");
    return emit({op, {a, b, c}, 0});
}

ValueId KernelBuilder::minimum(ValueId a, ValueId b) {
    const ValueId a_is_nan = apply(Op::not_equal, a, a);
    return select(apply(Op::logical_or, apply(Op::less, a, b), a_is_nan), a, b);
}

ValueId KernelBuilder::maximum(ValueId a, ValueId b) {
    const ValueId a_is_nan = apply(Op::not_equal, a, a);
    return select(apply(Op::logical_or, apply(Op::less, b, a), a_is_nan), a, b);
}

ValueId KernelBuilder::clamp_below(ValueId x, ValueId bound) {
    return select(apply(Op::less, x, bound), bound, x);
}

ValueId KernelBuilder::clamp_above(ValueId x, ValueId bound) {
    return select(apply(Op::less, bound, x), bound, x);
}

void KernelBuilder::result(const std::string& name, ValueId value) {
    CHECK(value < next(), "builder: a result is a value of this builder");
    kernel_.results.push_back(value);
    kernel_.result_names.push_back(name);
}

ValueId KernelBuilder::emit(Instruction instruction) {
    const int arity = info(instruction.op).arity;
    for (std::size_t k = 0; static_cast<int>(k) < arity; ++k) {
        CHECK(instruction.operands[k] < next(), "builder: an operand is a value of this builder");
    }
    if (arity > 0 && !is_link_reduction(instruction.op)) {
        if (const std::optional<ValueId> known = simplify(instruction)) return *known;
    }
    const ValueId id = next();
    const bool is_product = instruction.op == Op::multiply || instruction.op == Op::divide;
    if (!is_product || products_ == EqualProducts::are_one) {
        std::uint64_t key = hash_of(instruction);
        for (auto found = numbering_.find(key); found != numbering_.end();
             found = numbering_.find(++key)) {
            if (kernel_.code[found->second] == instruction) return found->second;
        }
        numbering_.emplace(key, id);
    }
    kernel_.code.push_back(instruction);
    return id;
}

/// Returns the value of an instruction if it is known when the kernel is built; otherwise nullopt.
std::optional<ValueId> KernelBuilder::simplify(const Instruction& instruction) {
    const auto [a, b, c] = instruction.operands;
    const int arity = info(instruction.op).arity;
    const bool is_foldable =
        is_constant(a) && (arity < 2 || is_constant(b)) && (arity < 3 || is_constant(c));
    if (is_foldable) return fold(instruction);
    if (instruction.op == Op::select) {
        if (b == c) return b;
        if (is_constant(a)) return is_true_word(kernel_.code[a].payload) ? b : c;
    }
    if (instruction.op == Op::logical_and || instruction.op == Op::logical_or) {
        if (is_constant(a)) return simplify_logic(instruction.op, b, kernel_.code[a].payload);
        if (is_constant(b)) return simplify_logic(instruction.op, a, kernel_.code[b].payload);
    }
    return std::nullopt;
}

ValueId KernelBuilder::fold(const Instruction& instruction) {
    const auto [a, b, c] = instruction.operands;
    const FlushDenormals environment;
    const std::uint64_t bits =
        evaluate(instruction.op, kernel_.code[a].payload, kernel_.code[b].payload,
                 kernel_.code[c].payload, precision());
    return word(format().is_nan(bits) && yields_number(instruction.op) ? format().nan() : bits);
}

/// Whether a word, read as a number, is true. Denormal numbers count as zero.
bool KernelBuilder::is_true_word(std::uint64_t word) const {
    return (word & format().exponent()) != 0;
}

/// Simplifies `x and known` or `x or known`.
std::optional<ValueId> KernelBuilder::simplify_logic(Op op, ValueId x, std::uint64_t known) {
    const bool decides = is_true_word(known) == (op == Op::logical_or);
    if (decides) return number(op == Op::logical_or ? 1 : 0);
    if (yields_truth(kernel_.code[x].op)) return x;
    return std::nullopt;
}

CellKernel KernelBuilder::finish() && {
    const IdVector<ValueId, Instruction> code = std::move(kernel_.code);
    IdVector<ValueId, bool> needed(code.size());
    for (const ValueId id : kernel_.results) needed[id] = true;
    for (const ValueId id : code.ids_backwards()) {
        const int arity = needed[id] ? info(code[id].op).arity : 0;
        for (std::size_t k = 0; static_cast<int>(k) < arity; ++k) {
            needed[code[id].operands[k]] = true;
        }
    }
    kernel_.code.clear();
    IdVector<ValueId, ValueId> renamed(code.size());
    for (const ValueId id : code.ids()) {
        if (!needed[id]) continue;
        Instruction instruction = code[id];
        const int arity = info(instruction.op).arity;
        for (std::size_t k = 0; static_cast<int>(k) < arity; ++k) {
            instruction.operands[k] = renamed[instruction.operands[k]];
        }
        renamed[id] = next();
        kernel_.code.push_back(instruction);
    }
    for (ValueId& id : kernel_.results) id = renamed[id];
    std::erase_if(kernel_.kept, [&](ValueId id) { return !needed[id]; });
    for (ValueId& id : kernel_.kept) id = renamed[id];
    return std::move(kernel_);
}

}  // namespace cascade

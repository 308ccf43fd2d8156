// Writes instructions for each operation, and converts values from one form to another.
#include "wasm/body.h"

#include "core/check.h"

#include <cmath>
#include <limits>
#include <utility>

namespace cascade::wasm {
namespace {

/// Whether the operation copies words unchanged, so that its result may be denormal although exact
/// arithmetic flushes.
bool passes_words(Op op) {
    return op == Op::field || op == Op::neighbour || op == Op::theirs || op == Op::uniform ||
           (op >= Op::cell_column && op <= Op::cell_slice) || op == Op::negate ||
           op == Op::absolute || op == Op::select ||
           (op >= Op::bits_add && op <= Op::bits_shift_right);
}

}  // namespace

Body::Body(const KernelPart& part, Function& function, Cells& cells, bool is_exact)
    : part_(part),
      kernel_(part.kernel),
      function_(function),
      cells_(cells),
      is_exact_(is_exact),
      levels_(loop_levels_of(kernel_)),
      schedule_(cell_schedule_of(kernel_, levels_)),
      readers_(kernel_.code.size()),
      values_(kernel_.code.size()) {
    // The number of times that the code of each value is written.
    IdVector<ValueId, int> times(kernel_.code.size(), 1);
    for (const ValueId id : times.ids()) times[id] = levels_[id] < LoopLevel::link;
    for (const LinkLoop& loop : schedule_.loops) {
        for (const ValueId id : loop.values) ++times[id];
    }
    for (const ValueId id : kernel_.results) ++readers_[id];
    for (const ValueId id : kernel_.code.ids_backwards()) {
        if (readers_[id] == 0) continue;
        for (const ValueId operand : operands_of(kernel_.code[id])) readers_[operand] += times[id];
    }
}

/// Whether a select chooses the lesser or the greater of the two numbers that its condition
/// compares. WebAssembly has instructions for this choice, which do not flush.
bool Body::is_bound(const Instruction& instruction) const {
    if (is_exact_ || instruction.op != Op::select) return false;
    const auto [a, b, c] = instruction.operands;
    const Instruction& condition = kernel_.code[a];
    const auto [p, q, unused] = condition.operands;
    return condition.op == Op::less && ((b == p && c == q) || (b == q && c == p));
}

std::span<const ValueId> Body::operands_of(const Instruction& instruction) const {
    const std::span<const ValueId> all(instruction.operands.data(),
                                       static_cast<std::size_t>(info(instruction.op).arity));
    return is_bound(instruction) ? all.subspan(1) : all;
}

void Body::write(LoopLevel level) {
    level_ = level;
    readers_to_come_ = readers_;
    const std::vector<ValueId>& results = kernel_.results;
    std::size_t stored = 0;
    if (level != LoopLevel::cell) {
        for (const ValueId id : kernel_.code.ids()) {
            if (levels_[id] == level) define(id);
        }
        return;
    }
    for (const LinkLoop& loop : schedule_.loops) {
        for (const ValueId id : loop.before) define(id);
        write_loop(loop);
    }
    for (const ValueId id : schedule_.after) {
        define(id);
        if (!part_.is_in_order) continue;
        while (stored < results.size() && results[stored] <= id) store(stored++);
    }
    while (stored < results.size()) store(stored++);
}

void Body::define(ValueId id) {
    if (readers_[id] == 0) return;
    const Instruction& instruction = kernel_.code[id];
    values_[id] = value_of(instruction);
    for (const ValueId operand : operands_of(instruction)) release(operand);
}

// Code of links is written separately from code of cells. So if the code of links needs another
// form of a cell's value, the code for that form still comes before the loop.
void Body::write_loop(const LinkLoop& loop) {
    for (const ValueId id : loop.reductions) {
        code().get(beginning_of(kernel_.code[id].op));
        values_[id] = {};
        values_[id].number = keep();
    }
    cells_.begin_links();
    level_ = LoopLevel::link;
    for (const ValueId id : loop.values) define(id);
    for (const ValueId id : loop.reductions) reduce(id);
    for (const ValueId id : loop.values) give_back(id);
    level_ = LoopLevel::cell;
    cells_.end_links();
    for (const ValueId id : loop.reductions) {
        if (kernel_.code[id].op != Op::link_sum) continue;
        code().get(*values_[id].number);
        code().get(function_.constant(0));
        code().write(Lanes::add);  // Turns −0 into 0.
        code().set(*values_[id].number);
    }
    for (const ValueId id : std::exchange(read_in_loop_, {})) release(id);
}

/// The value with which a reduction begins, which is its result for a cell without links.
Local Body::beginning_of(Op op) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return function_.number(op == Op::link_sum ? 0 : op == Op::link_least ? infinity : -infinity);
}

/// Adds a link's value to a total, or keeps the lesser or greater of the two.
void Body::reduce(ValueId id) {
    if (readers_[id] == 0) return;
    const auto [op, operands, payload] = kernel_.code[id];
    const Local total = *values_[id].number;
    if (op == Op::link_sum) code().get(total);
    code().get(operand(operands[0]));
    code().get(beginning_of(op));  // In a lane without a link, this value changes no total.
    code().get(cells_.is_link());
    code().write(Whole::choose);
    if (op == Op::link_sum) {
        arithmetic().add();
    } else {
        const Local value = keep();
        for (const Local local : {total, total, value, total, value}) code().get(local);
        code().write(op == Op::link_least ? Lanes::less : Lanes::greater);
        code().write(Whole::choose);
        for (const Local local : {total, total}) code().get(local);
        code().write(Lanes::not_equal);
        code().write(Whole::choose);
        function_.give_back(value, level_);
    }
    code().set(total);
    release(operands[0]);
}

void Body::store(std::size_t result) {
    const ValueId id = kernel_.results[result];
    if (is_exact_) {
        cells_.store(part_.results[result], number(id));
    } else {
        // Without this flush, processors would compute with denormal numbers in every step while a
        // field decays, and take many times as long. Inside a step denormal numbers are rare, so
        // other values are not flushed.
        code().get(number(id));
        Arithmetic(function_, LoopLevel::cell, true).flush();
        const Local flushed = keep();
        cells_.store(part_.results[result], flushed);
        function_.give_back(flushed);
    }
    release(id);
}

void Body::release(ValueId id) {
    if (levels_[id] < LoopLevel::cell) return;
    if (levels_[id] < level_) {
        read_in_loop_.push_back(id);
    } else if (--readers_to_come_[id] == 0) {
        give_back(id);
    }
}

/// Releases the locals of all forms of a value.
void Body::give_back(ValueId id) {
    Value& value = values_[id];
    const auto give_back = [&](std::optional<Local> local) {
        if (local) function_.give_back(*local, levels_[id]);
    };
    if (!value.is_of_source) give_back(value.is_boolean ? value.truth : value.number);
    give_back(value.is_boolean ? value.number : value.truth);
    give_back(value.operand);
    value = {};
}

Local Body::number(ValueId id) {
    Value& value = values_[id];
    if (!value.number) {
        Code& own = function_.at(levels_[id]);
        own.get(*value.truth);
        own.get(function_.constant(function_.format().one()));
        own.write(Whole::bits_and);
        value.number = function_.keep(levels_[id]);
    }
    return *value.number;
}

Local Body::operand(ValueId id) {
    Value& value = values_[id];
    if (!is_exact_ || !value.may_be_denormal) return number(id);
    if (!value.operand) {
        function_.at(levels_[id]).get(number(id));
        Arithmetic(function_, levels_[id], is_exact_).flush();
        value.operand = function_.keep(levels_[id]);
    }
    return *value.operand;
}

// Denormal numbers are false, as in is_true() of ir/word_operations.h.
Local Body::truth(ValueId id) {
    Value& value = values_[id];
    if (!value.truth) {
        const WordFormat format = function_.format();
        Code& own = function_.at(levels_[id]);
        own.get(number(id));
        own.get(function_.constant(format.all() ^ format.sign()));
        own.write(Whole::bits_and);
        own.get(function_.constant(format.fraction() + 1));
        own.write(Lanes::word_greater_equal);
        value.truth = function_.keep(levels_[id]);
    }
    return *value.truth;
}

Body::Value Body::value_of(const Instruction& instruction) {
    const Op op = instruction.op;
    Value value;
    value.may_be_denormal =
        op == Op::constant ? function_.format().is_denormal(instruction.payload) : passes_words(op);
    value.is_boolean = op == Op::mask || (op >= Op::less && op <= Op::logical_not);
    std::optional<Local> local = source(instruction);
    value.is_of_source = local.has_value();
    if (!local) {
        push(instruction);
        local = keep();
    }
    (value.is_boolean ? value.truth : value.number) = local;
    return value;
}

std::optional<Local> Body::source(const Instruction& instruction) {
    switch (instruction.op) {
        case Op::constant: return function_.constant(instruction.payload);
        case Op::field: return cells_.field(instruction.field());
        case Op::laplacian: return cells_.laplacian(instruction.field());
        case Op::neighbour: return cells_.neighbour(Neighbour::of(instruction.slot()));
        case Op::link_flow:
        case Op::link_squares:
        case Op::link_weighted:
        case Op::gradient_x:
        case Op::gradient_y:
        case Op::gradient_z: return cells_.link_sum(instruction);
        case Op::theirs: return cells_.theirs(instruction.field());
        case Op::mask: return cells_.mask(MaskSlot(instruction.slot()));
        case Op::uniform: return cells_.uniform(UniformSlot(instruction.slot()));
        case Op::cell_column: return cells_.cell_column();
        case Op::cell_row: return cells_.cell_row();
        case Op::cell_slice: return cells_.cell_slice();
        default: return std::nullopt;
    }
}

/// Leaves the result on the stack. For comparisons and logic the result is in the form `truth`.
void Body::push(const Instruction& instruction) {
    const auto [a, b, unused] = instruction.operands;
    switch (instruction.op) {
        case Op::add: push_operands(a, b); return arithmetic().add();
        case Op::subtract: push_operands(a, b); return arithmetic().subtract();
        case Op::multiply: push_operands(a, b); return arithmetic().multiply();
        case Op::divide: push_operands(a, b); return arithmetic().divide();
        case Op::negate: return push_words(Lanes::negate, {a});
        case Op::absolute: return push_words(Lanes::absolute, {a});
        case Op::square_root: return push_numbers(Lanes::square_root, {a});
        case Op::round_to_even: return push_numbers(Lanes::nearest, {a});
        case Op::scale_by_power: return push_scaled(a, b);
        case Op::less: return push_numbers(Lanes::less, {a, b});
        case Op::less_equal: return push_numbers(Lanes::less_equal, {a, b});
        case Op::equal: return push_numbers(Lanes::equal, {a, b});
        case Op::not_equal: return push_numbers(Lanes::not_equal, {a, b});
        case Op::logical_and: return push_truths(Whole::bits_and, {a, b});
        case Op::logical_or: return push_truths(Whole::bits_or, {a, b});
        case Op::logical_not: return push_truths(Whole::bits_not, {a});
        case Op::select: return push_choice(instruction);
        case Op::bits_add: return push_words(Lanes::word_add, {a, b});
        case Op::bits_subtract: return push_words(Lanes::word_subtract, {a, b});
        case Op::bits_multiply: return push_words(Lanes::word_multiply, {a, b});
        case Op::bits_and: return push_words(Whole::bits_and, {a, b});
        case Op::bits_or: return push_words(Whole::bits_or, {a, b});
        case Op::bits_xor: return push_words(Whole::bits_xor, {a, b});
        case Op::bits_shift_left:
        case Op::bits_shift_right: return push_shifted(instruction);
        case Op::bits_to_number: return push_converted(a);
        default: CHECK(false, "an operation of the table that WebAssembly has");
    }
}

void Body::push_choice(const Instruction& instruction) {
    const auto [a, b, c] = instruction.operands;
    if (is_bound(instruction)) {
        const bool takes_greater = kernel_.code[a].operands[0] == c;
        return push_words(takes_greater ? Lanes::second_if_greater : Lanes::second_if_less, {c, b});
    }
    code().get(number(b));
    code().get(number(c));
    code().get(truth(a));
    code().write(Whole::choose);
}

// The algorithm is the same as in scale_by_power() of ir/word_operations.h.
void Body::push_scaled(ValueId a, ValueId b) {
    const WordFormat format = function_.format();
    code().get(operand(b));
    code().get(function_.number(std::ldexp(1.5, format.fraction_bits) + 2 * format.bias));
    code().write(Lanes::add);
    const Local sum = keep();
    code().get(sum);
    push_shift(Lanes::word_shift_right, 1);
    const Local half = keep();
    code().get(operand(a));
    code().get(half);
    push_shift(Lanes::word_shift_left, format.fraction_bits);
    arithmetic().multiply();
    code().get(sum);
    code().get(half);
    code().write(Lanes::word_subtract);
    push_shift(Lanes::word_shift_left, format.fraction_bits);
    arithmetic().multiply();
    function_.give_back(sum, level_);
    function_.give_back(half, level_);
}

void Body::push_shift(Lanes shift, int amount) {
    code().integer(amount);
    code().write(shift);
}

// WebAssembly shifts all lanes by the same amount. If the amounts may differ, lanes are shifted one
// by one.
void Body::push_shifted(const Instruction& instruction) {
    const auto [a, b, unused] = instruction.operands;
    const bool is_left = instruction.op == Op::bits_shift_left;
    const bool is_single = function_.precision() == Precision::single;
    const Local words = number(a);
    code().get(words);
    if (kernel_.code[b].op == Op::constant) {
        return push_shift(is_left ? Lanes::word_shift_left : Lanes::word_shift_right,
                          static_cast<int>(kernel_.code[b].payload));
    }
    const Local amounts = number(b);
    for (int lane = 0; lane < function_.lanes(); ++lane) {
        for (const Local from : {words, amounts}) {
            code().get(from);
            code().write(Lanes::word_extract, lane);
        }
        code().write(is_single ? is_left ? Plain::shift_left : Plain::shift_right
                     : is_left ? Plain::long_shift_left
                               : Plain::long_shift_right);
        code().write(Lanes::word_replace, lane);
    }
}

// WebAssembly cannot convert vectors of 64-bit words, so lanes are converted one by one.
void Body::push_converted(ValueId a) {
    code().get(number(a));
    if (function_.precision() == Precision::single) return code().write(Whole::numbers_of_words);
    for (int lane = 0; lane < function_.lanes(); ++lane) {
        code().get(number(a));
        code().write(Lanes::word_extract, lane);
        code().write(Plain::long_to_number);
        code().write(Lanes::replace, lane);
    }
}

}  // namespace cascade::wasm

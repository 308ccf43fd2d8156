// The meaning of every operation of ir/operations.def in LLVM's instructions.
#include "jit/emit_body.h"

#include "core/check.h"
#include "core/floating_point.h"
#include "ir/interpreter.h"

#include <llvm/IR/Constants.h>
#include <llvm/IR/DerivedTypes.h>
#include <llvm/IR/Intrinsics.h>

#include <array>

namespace cascade {
namespace {

/// Is `value` the constant `magnitude`, or minus that, in all lanes?
bool is_plus_or_minus(llvm::Value* value, double magnitude) {
    const auto* constant = llvm::dyn_cast<llvm::Constant>(value);
    if (!constant) return false;
    const llvm::Constant* element = constant->getSplatValue();
    const auto* number = llvm::dyn_cast_or_null<llvm::ConstantFP>(element);
    if (!number) return false;
    return number->isExactlyValue(magnitude) || number->isExactlyValue(-magnitude);
}

}  // namespace

llvm::APFloat number_constant(std::uint64_t word, Precision precision) {
    const auto bits = static_cast<unsigned>(format_of(precision).bits);
    return {precision == Precision::single ? llvm::APFloat::IEEEsingle()
                                           : llvm::APFloat::IEEEdouble(),
            llvm::APInt(bits, word)};
}

BodyScope::BodyScope(const CellKernel& kernel, std::span<const Level> levels, Level level,
                     Builder& builder, Lane& lane, const KernelShape& shape, BodyScope* outer)
    : kernel_(kernel),
      format_(format_of(kernel.precision)),
      levels_(levels),
      level_(level),
      shape_(shape),
      builder_(builder),
      lane_(lane),
      outer_(outer),
      number_type_(llvm::FixedVectorType::get(number_type(builder, kernel.precision),
                                              static_cast<unsigned>(shape.lanes))),
      bits_type_(llvm::FixedVectorType::get(word_type(builder, kernel.precision),
                                            static_cast<unsigned>(shape.lanes))),
      values_(kernel.code.size()) {}

void BodyScope::emit() {
    for (ValueId id = 0; id < kernel_.code.size(); ++id) {
        if (levels_[id] == level_) values_[id] = emit(kernel_.code[id]);
    }
}

BodyScope& BodyScope::owner(ValueId id) {
    BodyScope* scope = this;
    while (scope->level_ != levels_[id]) {
        CHECK(scope->outer_, "a value belongs to a scope that is open");
        scope = scope->outer_;
    }
    return *scope;
}

// A form is made in the scope that owns the value, so that inner loops do not make it again.
llvm::Value* BodyScope::number(ValueId id) {
    BodyScope& scope = owner(id);
    Forms& value = scope.values_[id];
    if (value.number) return value.number;
    value.number = value.bits
                       ? scope.builder_.CreateBitCast(value.bits, number_type_)
                       : scope.builder_.CreateSelect(value.truth, hidden(format_.one()), hidden(0));
    return value.number;
}

llvm::Value* BodyScope::bits(ValueId id) {
    BodyScope& scope = owner(id);
    Forms& value = scope.values_[id];
    if (!value.bits) {
        llvm::Value* from = number(id);
        value.bits = scope.builder_.CreateBitCast(from, bits_type_);
    }
    return value.bits;
}

llvm::Value* BodyScope::truth(ValueId id) {
    BodyScope& scope = owner(id);
    Forms& value = scope.values_[id];
    if (!value.truth) {
        llvm::Value* from = scope.operand(id);
        value.truth = scope.builder_.CreateFCmpUNE(from, splat(0));
    }
    return value.truth;
}

llvm::Constant* BodyScope::splat(std::uint64_t word) const {
    return llvm::ConstantFP::get(number_type_, number_constant(word, kernel_.precision));
}

llvm::Constant* BodyScope::word_splat(std::uint64_t word) const {
    return llvm::ConstantInt::get(bits_type_, word);
}

// The word with a denormal number replaced by zero of its sign, in integer operations: these are
// beyond what LLVM may do to floating-point ones.
llvm::Value* BodyScope::flushed(ValueId id) {
    llvm::Value* word = bits(id);
    llvm::Value* exponent = builder_.CreateAnd(word, word_splat(format_.exponent()));
    llvm::Value* is_tiny = builder_.CreateICmpEQ(exponent, word_splat(0));
    llvm::Value* zero = builder_.CreateAnd(word, word_splat(format_.sign()));
    return builder_.CreateBitCast(builder_.CreateSelect(is_tiny, zero, word), number_type_);
}

// A constant that all of LLVM takes for a variable. It belongs to the outermost scope.
llvm::Value* BodyScope::hidden(std::uint64_t word) {
    BodyScope* scope = this;
    while (scope->outer_) scope = scope->outer_;
    llvm::Value*& value = scope->hidden_[word];
    if (!value) value = scope->lane_.hidden(word);
    return value;
}

// The word of a value that is the same constant in all cells. LLVM may have found that out.
std::optional<std::uint64_t> BodyScope::constant_word(ValueId id) {
    const Forms& value = forms(id);
    llvm::Value* form = value.truth && value.is_boolean ? value.truth
                        : value.number                  ? value.number
                                                        : value.bits;
    const auto* constant = llvm::dyn_cast<llvm::Constant>(form);
    const llvm::Constant* element = constant ? constant->getSplatValue() : nullptr;
    if (const auto* number = llvm::dyn_cast_or_null<llvm::ConstantFP>(element)) {
        return number->getValueAPF().bitcastToAPInt().getZExtValue();
    }
    if (const auto* integer = llvm::dyn_cast_or_null<llvm::ConstantInt>(element)) {
        const std::uint64_t word = integer->getZExtValue();
        return form == value.truth ? word * format_.one() : word;
    }
    return std::nullopt;
}

// An operand of arithmetic. LLVM does not always flush constants.
llvm::Value* BodyScope::operand(ValueId id) {
    return forms(id).may_be_denormal && constant_word(id) ? flushed(id) : number(id);
}

// An operand whose partner may be the constant ±`neutral`, which would make the operation the
// identity: LLVM drops such operations, also in one branch of a choice.
llvm::Value* BodyScope::operand(ValueId id, ValueId partner, double neutral) {
    if (!forms(id).may_be_denormal) return number(id);
    const bool may_be_neutral =
        is_plus_or_minus(operand(partner), neutral) || forms(partner).may_be_neutral;
    return may_be_neutral ? flushed(id) : operand(id);
}

// Evaluates an operation on constants.
bool BodyScope::is_evaluated(const Instruction& instruction, Forms& value) {
    std::array<std::uint64_t, 3> words{};
    const auto arity = static_cast<std::size_t>(info(instruction.op).arity);
    if (arity == 0) return false;
    for (std::size_t k = 0; k < arity; ++k) {
        const auto word = constant_word(instruction.operands[k]);
        if (!word) return false;
        words[k] = *word;
    }
    const FlushDenormals environment;
    const std::uint64_t word =
        evaluate(instruction.op, words[0], words[1], words[2], kernel_.precision);
    value.number = splat(word);
    value.may_be_denormal = format_.is_denormal(word);
    value.is_choice = true;
    return true;
}

BodyScope::Forms BodyScope::emit(const Instruction& instruction) {
    Forms value;
    if (is_evaluated(instruction, value)) return value;
    switch (instruction.op) {
        case Op::constant:
        case Op::field:
        case Op::laplacian:
        case Op::neighbour:
        case Op::link_flow:
        case Op::link_squares:
        case Op::gradient_x:
        case Op::gradient_y:
        case Op::gradient_z:
        case Op::mask:
        case Op::uniform:
        case Op::cell_column:
        case Op::cell_row:
        case Op::cell_slice: return emit_source(instruction);
        case Op::add:
        case Op::subtract:
        case Op::multiply:
        case Op::divide:
        case Op::negate:
        case Op::absolute:
        case Op::square_root:
        case Op::round_to_even:
        case Op::scale_by_power: return emit_arithmetic(instruction);
        case Op::multiply_add: return emit_multiply_add(instruction);
        case Op::less:
        case Op::less_equal:
        case Op::equal:
        case Op::not_equal: return emit_comparison(instruction);
        case Op::logical_and:
        case Op::logical_or:
        case Op::logical_not: return emit_logic(instruction);
        case Op::select: return emit_select(instruction);
        case Op::bits_add:
        case Op::bits_subtract:
        case Op::bits_multiply:
        case Op::bits_and:
        case Op::bits_or:
        case Op::bits_xor:
        case Op::bits_shift_left:
        case Op::bits_shift_right:
        case Op::bits_to_number: return emit_word(instruction);
    }
    CHECK(false, "an operation of the table");
    return {};
}

BodyScope::Forms BodyScope::emit_source(const Instruction& instruction) {
    Forms value;
    switch (instruction.op) {
        case Op::constant:
            value.number = splat(instruction.payload);
            value.may_be_denormal = format_.is_denormal(instruction.payload);
            value.is_choice = true;
            break;
        case Op::field:
            value.number = lane_.field(instruction.slot());
            value.may_be_denormal = true;
            break;
        case Op::laplacian: value.number = lane_.laplacian(instruction.slot()); break;
        case Op::neighbour:
            value.number = lane_.neighbour(Neighbour::of(instruction.slot()));
            value.may_be_denormal = true;
            break;
        case Op::link_flow:
        case Op::link_squares:
        case Op::gradient_x:
        case Op::gradient_y:
        case Op::gradient_z: value.number = lane_.link_sum(instruction); break;
        case Op::mask:
            value.truth = lane_.mask(instruction.slot());
            value.is_boolean = value.is_choice = true;
            break;
        case Op::uniform:
            value.number = lane_.uniform(instruction.slot());
            value.may_be_denormal = true;
            break;
        default:
            value.bits = instruction.op == Op::cell_row     ? lane_.cell_row()
                         : instruction.op == Op::cell_slice ? lane_.cell_slice()
                                                            : lane_.cell_column();
            value.may_be_denormal = true;
            break;
    }
    return value;
}

BodyScope::Forms BodyScope::emit_arithmetic(const Instruction& instruction) {
    const ValueId a = instruction.operands[0];
    const ValueId b = instruction.operands[1];
    Forms value;
    value.may_be_neutral =
        forms(a).may_be_neutral || (info(instruction.op).arity == 2 && forms(b).may_be_neutral);
    switch (instruction.op) {
        case Op::add: value.number = builder_.CreateFAdd(operand(a, b, 0), operand(b, a, 0)); break;
        case Op::subtract:
            value.number = builder_.CreateFSub(operand(a, b, 0), operand(b, a, 0));
            break;
        case Op::multiply:
            value.number = builder_.CreateFMul(operand(a, b, 1), operand(b, a, 1));
            break;
        case Op::divide: value.number = builder_.CreateFDiv(operand(a, b, 1), operand(b)); break;
        case Op::negate:
            value.number = builder_.CreateFNeg(number(a));
            value.may_be_denormal = forms(a).may_be_denormal;
            break;
        case Op::absolute:
            value.number = builder_.CreateUnaryIntrinsic(llvm::Intrinsic::fabs, number(a));
            value.may_be_denormal = forms(a).may_be_denormal;
            break;
        case Op::round_to_even: value.number = rounded_to_even(a); break;
        case Op::scale_by_power: value.number = scaled_by_power(a, b); break;
        default:
            value.number = builder_.CreateUnaryIntrinsic(llvm::Intrinsic::sqrt, operand(a));
            break;
    }
    return value;
}

// LLVM drops a factor of ±1, and then what is added, if that is 0.
BodyScope::Forms BodyScope::emit_multiply_add(const Instruction& instruction) {
    const auto [a, b, c] = instruction.operands;
    Forms value;
    value.may_be_neutral =
        forms(a).may_be_neutral || forms(b).may_be_neutral || forms(c).may_be_neutral;
    value.number = builder_.CreateIntrinsic(llvm::Intrinsic::fma, {number_type_},
                                            {operand(a, b, 1), operand(b, a, 1), operand(c)});
    return value;
}

BodyScope::Forms BodyScope::emit_comparison(const Instruction& instruction) {
    llvm::Value* a = operand(instruction.operands[0]);
    llvm::Value* b = operand(instruction.operands[1]);
    Forms value;
    value.is_boolean = value.is_choice = true;
    switch (instruction.op) {
        case Op::less: value.truth = builder_.CreateFCmpOLT(a, b); break;
        case Op::less_equal: value.truth = builder_.CreateFCmpOLE(a, b); break;
        case Op::equal: value.truth = builder_.CreateFCmpOEQ(a, b); break;
        default: value.truth = builder_.CreateFCmpUNE(a, b); break;
    }
    return value;
}

BodyScope::Forms BodyScope::emit_logic(const Instruction& instruction) {
    llvm::Value* a = truth(instruction.operands[0]);
    Forms value;
    value.is_boolean = value.is_choice = true;
    switch (instruction.op) {
        case Op::logical_and:
            value.truth = builder_.CreateAnd(a, truth(instruction.operands[1]));
            break;
        case Op::logical_or:
            value.truth = builder_.CreateOr(a, truth(instruction.operands[1]));
            break;
        default: value.truth = builder_.CreateNot(a); break;
    }
    return value;
}

// One branch of a choice, as a number. Between constants they are hidden; a constant beside
// something else stays, so that a clamp becomes the processor's max.
llvm::Value* BodyScope::branch(ValueId id, ValueId other) {
    const auto word = constant_word(id);
    return word && forms(other).is_choice ? hidden(*word) : number(id);
}

// A choice between numbers by their comparison becomes the processor's min or max, which flush
// denormals: such words are chosen as integers.
BodyScope::Forms BodyScope::emit_select(const Instruction& instruction) {
    const auto [condition, then, otherwise] = instruction.operands;
    llvm::Value* choice = truth(condition);
    const Forms& first = forms(then);
    const Forms& second = forms(otherwise);
    Forms value;
    value.is_choice = first.is_choice && second.is_choice;
    if (first.is_boolean && second.is_boolean) {
        value.truth = builder_.CreateSelect(choice, truth(then), truth(otherwise));
        value.is_boolean = true;
        return value;
    }
    value.may_be_denormal = first.may_be_denormal || second.may_be_denormal;
    value.may_be_neutral =
        first.is_choice || second.is_choice || first.may_be_neutral || second.may_be_neutral;
    llvm::Value* a = branch(then, otherwise);
    llvm::Value* b = branch(otherwise, then);
    if (value.may_be_denormal) {
        value.bits = builder_.CreateSelect(choice, builder_.CreateBitCast(a, bits_type_),
                                           builder_.CreateBitCast(b, bits_type_));
    } else {
        value.number = builder_.CreateSelect(choice, a, b);
    }
    return value;
}

BodyScope::Forms BodyScope::emit_word(const Instruction& instruction) {
    llvm::Value* a = bits(instruction.operands[0]);
    Forms value;
    if (instruction.op == Op::bits_to_number) {
        value.number = builder_.CreateSIToFP(a, number_type_);
        // A bit that is tested needs no conversion.
        value.truth = builder_.CreateICmpNE(a, llvm::ConstantInt::get(bits_type_, 0));
        return value;
    }
    llvm::Value* b = bits(instruction.operands[1]);
    // Amounts above 31 (63) do not occur; the mask keeps LLVM from drawing conclusions from that,
    // and vanishes where the amount is a constant.
    const auto amount = [&] {
        return builder_.CreateAnd(b, word_splat(static_cast<std::uint64_t>(format_.bits - 1)));
    };
    value.may_be_denormal = true;
    value.may_be_neutral = true;
    switch (instruction.op) {
        case Op::bits_add: value.bits = builder_.CreateAdd(a, b); break;
        case Op::bits_subtract: value.bits = builder_.CreateSub(a, b); break;
        case Op::bits_multiply: value.bits = builder_.CreateMul(a, b); break;
        case Op::bits_and: value.bits = builder_.CreateAnd(a, b); break;
        case Op::bits_or: value.bits = builder_.CreateOr(a, b); break;
        case Op::bits_xor: value.bits = builder_.CreateXor(a, b); break;
        case Op::bits_shift_left: value.bits = builder_.CreateShl(a, amount()); break;
        default: value.bits = builder_.CreateLShr(a, amount()); break;
    }
    return value;
}

}  // namespace cascade

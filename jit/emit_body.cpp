// The meaning of every operation of ir/operations.def in LLVM's instructions.
#include "jit/emit_body.h"

#include "core/check.h"

#include <llvm/IR/Constants.h>
#include <llvm/IR/DerivedTypes.h>
#include <llvm/IR/Intrinsics.h>

#include <algorithm>

namespace cascade {
namespace {

constexpr std::uint32_t exponent_bits = 0x7f800000;
constexpr std::uint32_t fraction_bits = 0x007fffff;
constexpr std::uint32_t sign_bit = 0x80000000;

bool is_denormal(std::uint32_t word) {
    return (word & exponent_bits) == 0 && (word & fraction_bits) != 0;
}

/// Is `value` the constant `magnitude`, or minus that, in all lanes?
bool is_plus_or_minus(llvm::Value* value, float magnitude) {
    const auto* constant = llvm::dyn_cast<llvm::Constant>(value);
    if (!constant) return false;
    const llvm::Constant* element = constant->getSplatValue();
    const auto* number = llvm::dyn_cast_or_null<llvm::ConstantFP>(element);
    if (!number) return false;
    return number->isExactlyValue(magnitude) || number->isExactlyValue(-magnitude);
}

Level level_of_source(Op op) {
    switch (op) {
        case Op::field:
        case Op::laplacian:
        case Op::mask:
        case Op::cell_column: return Level::cell;
        case Op::cell_row: return Level::row;
        default: return Level::call;
    }
}

llvm::Value* not_here() {
    CHECK(false, "a lane is asked for values of its own level");
    return nullptr;
}

}  // namespace

llvm::Value* Lane::uniform(std::uint32_t) { return not_here(); }
llvm::Value* Lane::cell_row() { return not_here(); }
llvm::Value* Lane::field(std::uint32_t) { return not_here(); }
llvm::Value* Lane::laplacian(std::uint32_t) { return not_here(); }
llvm::Value* Lane::mask(std::uint32_t) { return not_here(); }
llvm::Value* Lane::cell_column() { return not_here(); }

std::vector<Level> levels_of(const CellKernel& kernel) {
    std::vector<Level> levels;
    levels.reserve(kernel.code.size());
    for (const Instruction& instruction : kernel.code) {
        Level level = level_of_source(instruction.op);
        for (int k = 0; k < info(instruction.op).arity; ++k) {
            level = std::max(level, levels[instruction.operands[static_cast<std::size_t>(k)]]);
        }
        levels.push_back(level);
    }
    return levels;
}

BodyScope::BodyScope(const CellKernel& kernel, std::span<const Level> levels, Level level,
                     Builder& builder, Lane& lane, int lanes, BodyScope* outer)
    : kernel_(kernel),
      levels_(levels),
      level_(level),
      builder_(builder),
      lane_(lane),
      outer_(outer),
      number_type_(llvm::FixedVectorType::get(builder.getFloatTy(), static_cast<unsigned>(lanes))),
      bits_type_(llvm::FixedVectorType::get(builder.getInt32Ty(), static_cast<unsigned>(lanes))),
      values_(kernel.code.size()) {}

void BodyScope::emit() {
    for (ValueId id = 0; id < kernel_.code.size(); ++id) {
        if (levels_[id] != level_) continue;
        values_[id] = emit(kernel_.code[id]);
        values_[id].is_choice_of_constants = chooses_constants(kernel_.code[id]);
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
                       : scope.builder_.CreateSelect(value.truth, splat(to_bits(1)), splat(0));
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

llvm::Constant* BodyScope::splat(std::uint32_t word) const {
    const llvm::APFloat value(llvm::APFloat::IEEEsingle(), llvm::APInt(32, word));
    return llvm::ConstantFP::get(number_type_, value);
}

// The word with a denormal number replaced by zero of its sign, in integer operations: these are
// beyond what LLVM may do to floating-point ones.
llvm::Value* BodyScope::flushed(ValueId id) {
    const auto constant = [&](std::uint32_t word) {
        return llvm::ConstantInt::get(bits_type_, word);
    };
    llvm::Value* word = bits(id);
    llvm::Value* exponent = builder_.CreateAnd(word, constant(exponent_bits));
    llvm::Value* is_tiny = builder_.CreateICmpEQ(exponent, constant(0));
    llvm::Value* zero = builder_.CreateAnd(word, constant(sign_bit));
    return builder_.CreateBitCast(builder_.CreateSelect(is_tiny, zero, word), number_type_);
}

// An operand of arithmetic. Constants are flushed here, because LLVM's folding does not always.
llvm::Value* BodyScope::operand(ValueId id) {
    llvm::Value* value = number(id);
    const bool is_constant = llvm::isa<llvm::Constant>(value);
    return is_constant && forms(id).may_be_denormal ? flushed(id) : value;
}

// An operand whose partner may be the constant ±`neutral`, which would make the operation the
// identity: LLVM drops such operations, also in one branch of a choice between constants.
llvm::Value* BodyScope::operand(ValueId id, ValueId partner, float neutral) {
    if (!forms(id).may_be_denormal) return number(id);
    llvm::Value* other = operand(partner);
    const bool may_be_neutral = llvm::isa<llvm::Constant>(other)
                                    ? is_plus_or_minus(other, neutral)
                                    : forms(partner).is_choice_of_constants;
    return may_be_neutral ? flushed(id) : operand(id);
}

bool BodyScope::chooses_constants(const Instruction& instruction) {
    const auto [a, b, c] = instruction.operands;
    const auto chooses = [&](ValueId id) { return forms(id).is_choice_of_constants; };
    const bool is_condition = instruction.op == Op::mask ||
                              (instruction.op >= Op::less && instruction.op <= Op::logical_not);
    if (is_condition || instruction.op == Op::constant) return true;
    if (instruction.op == Op::select) return chooses(b) || chooses(c);
    switch (info(instruction.op).arity) {
        case 1: return chooses(a);
        case 2: return chooses(a) && chooses(b);
        default: return false;
    }
}

BodyScope::Forms BodyScope::emit(const Instruction& instruction) {
    switch (instruction.op) {
        case Op::constant:
        case Op::field:
        case Op::laplacian:
        case Op::mask:
        case Op::uniform:
        case Op::cell_column:
        case Op::cell_row: return emit_source(instruction);
        case Op::add:
        case Op::subtract:
        case Op::multiply:
        case Op::divide:
        case Op::negate:
        case Op::absolute:
        case Op::square_root: return emit_arithmetic(instruction);
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
            value.may_be_denormal = is_denormal(instruction.payload);
            break;
        case Op::field:
            value.number = lane_.field(instruction.payload);
            value.may_be_denormal = true;
            break;
        case Op::laplacian: value.number = lane_.laplacian(instruction.payload); break;
        case Op::mask:
            value.truth = lane_.mask(instruction.payload);
            value.is_boolean = true;
            break;
        case Op::uniform:
            value.number = lane_.uniform(instruction.payload);
            value.may_be_denormal = true;
            break;
        default:
            value.bits = instruction.op == Op::cell_row ? lane_.cell_row() : lane_.cell_column();
            value.may_be_denormal = true;
            break;
    }
    return value;
}

BodyScope::Forms BodyScope::emit_arithmetic(const Instruction& instruction) {
    const ValueId a = instruction.operands[0];
    const ValueId b = instruction.operands[1];
    Forms value;
    switch (instruction.op) {
        case Op::add:
            value.number = builder_.CreateFAdd(operand(a, b, 0), operand(b, a, 0));
            break;
        case Op::subtract:
            value.number = builder_.CreateFSub(operand(a, b, 0), operand(b, a, 0));
            break;
        case Op::multiply:
            value.number = builder_.CreateFMul(operand(a, b, 1), operand(b, a, 1));
            break;
        case Op::divide:
            value.number = builder_.CreateFDiv(operand(a, b, 1), operand(b));
            break;
        case Op::negate:
            value.number = builder_.CreateFNeg(number(a));
            value.may_be_denormal = forms(a).may_be_denormal;
            break;
        case Op::absolute:
            value.number = builder_.CreateUnaryIntrinsic(llvm::Intrinsic::fabs, number(a));
            value.may_be_denormal = forms(a).may_be_denormal;
            break;
        default:
            value.number = builder_.CreateUnaryIntrinsic(llvm::Intrinsic::sqrt, operand(a));
            break;
    }
    return value;
}

BodyScope::Forms BodyScope::emit_comparison(const Instruction& instruction) {
    llvm::Value* a = operand(instruction.operands[0]);
    llvm::Value* b = operand(instruction.operands[1]);
    Forms value;
    value.is_boolean = true;
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
    value.is_boolean = true;
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

// A choice between numbers by their comparison becomes the processor's min or max, which flush
// denormals: such words are chosen as integers.
BodyScope::Forms BodyScope::emit_select(const Instruction& instruction) {
    const auto [condition, then, otherwise] = instruction.operands;
    llvm::Value* choice = truth(condition);
    Forms value;
    if (forms(then).is_boolean && forms(otherwise).is_boolean) {
        value.truth = builder_.CreateSelect(choice, truth(then), truth(otherwise));
        value.is_boolean = true;
        return value;
    }
    value.may_be_denormal = forms(then).may_be_denormal || forms(otherwise).may_be_denormal;
    if (value.may_be_denormal) {
        value.bits = builder_.CreateSelect(choice, bits(then), bits(otherwise));
    } else {
        value.number = builder_.CreateSelect(choice, number(then), number(otherwise));
    }
    return value;
}

BodyScope::Forms BodyScope::emit_word(const Instruction& instruction) {
    llvm::Value* a = bits(instruction.operands[0]);
    Forms value;
    if (instruction.op == Op::bits_to_number) {
        value.number = builder_.CreateSIToFP(a, number_type_);
        return value;
    }
    llvm::Value* b = bits(instruction.operands[1]);
    // Amounts above 31 do not occur; the mask keeps LLVM from drawing conclusions from that, and
    // vanishes where the amount is a constant.
    const auto amount = [&] {
        return builder_.CreateAnd(b, llvm::ConstantInt::get(bits_type_, 31));
    };
    value.may_be_denormal = true;
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

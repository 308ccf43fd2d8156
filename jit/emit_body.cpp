// Translates every operation of ir/operations.def to LLVM's instructions.
#include "jit/emit_body.h"

#include "core/check.h"
#include "core/floating_point.h"
#include "ir/interpreter.h"
#include "jit/body_scope.h"

#include <llvm/IR/Intrinsics.h>
#include <llvm/IR/IntrinsicsX86.h>

#include <array>
#include <cmath>
#include <vector>

namespace cascade {

namespace {

// Operations for which only some processors have an instruction.

/// a · 2^b in all lanes, by an instruction that rounds as the environment says.
llvm::Value* scaled_by_instruction(BodyScope& scope, llvm::Value* a, llvm::Value* b) {
    const Body& body = scope.body();
    Builder& builder = scope.builder();
    const bool is_single = body.kernel.precision == Precision::single;
    const auto instruction = is_single ? llvm::Intrinsic::x86_avx512_mask_scalef_ps_512
                                       : llvm::Intrinsic::x86_avx512_mask_scalef_pd_512;
    constexpr unsigned current_rounding = 4;
    const auto lanes = static_cast<unsigned>(body.shape.lanes);
    llvm::Value* all = llvm::ConstantInt::getAllOnesValue(builder.getIntNTy(lanes));
    return builder.CreateIntrinsic(instruction, {},
                                   {a, b, a, all, builder.getInt32(current_rounding)});
}

/// The operation `round_to_even`. It uses a single instruction if the processor has one, otherwise
/// the algorithm of ir/word_operations.h, which gives the same bits. The operation `scale_by_power`
/// below also has these two forms.
llvm::Value* rounded_to_even(BodyScope& scope, ValueId a) {
    const Body& body = scope.body();
    Builder& builder = scope.builder();
    llvm::Value* number = scope.operand(a);
    if (body.shape.has_rounding) {
        return builder.CreateUnaryIntrinsic(llvm::Intrinsic::roundeven, number);
    }
    llvm::Constant* all_whole =
        llvm::ConstantFP::get(body.number_type, std::ldexp(1.0, body.format.fraction_bits));
    llvm::Value* size = builder.CreateUnaryIntrinsic(llvm::Intrinsic::fabs, number);
    llvm::Value* rounded = builder.CreateFSub(builder.CreateFAdd(size, all_whole), all_whole);
    llvm::Value* with_sign =
        builder.CreateBinaryIntrinsic(llvm::Intrinsic::copysign, rounded, number);
    return builder.CreateSelect(builder.CreateFCmpOLT(size, all_whole), with_sign, number);
}

// `added` is hidden, so that LLVM does not know the factors. Otherwise LLVM would drop a factor of
// 1, although it flushes, and would evaluate a product of known factors without flushing.
llvm::Value* scaled_by_power(BodyScope& scope, ValueId a, ValueId b) {
    const Body& body = scope.body();
    const WordFormat format = body.format;
    Builder& builder = scope.builder();
    const bool is_widest = body.shape.lanes * format.bits == 512;
    if (body.shape.has_scaling && is_widest) {
        return scaled_by_instruction(scope, scope.number(a), scope.number(b));
    }
    const double whole = std::ldexp(1.5, format.fraction_bits) + 2 * format.bias;
    llvm::Value* added = scope.hidden(word_of(whole, body.kernel.precision));
    llvm::Value* sum =
        builder.CreateBitCast(builder.CreateFAdd(scope.number(b), added), body.bits_type);
    llvm::Value* half = builder.CreateLShr(sum, body.bits(1));
    const auto power = [&](llvm::Value* exponent) {
        const auto bits = static_cast<std::uint64_t>(format.fraction_bits);
        return builder.CreateBitCast(builder.CreateShl(exponent, body.bits(bits)),
                                     body.number_type);
    };
    return builder.CreateFMul(builder.CreateFMul(scope.number(a), power(half)),
                              power(builder.CreateSub(sum, half)));
}

class BodyEmitter {
public:
    explicit BodyEmitter(BodyScope& scope)
        : scope_(scope), body_(scope.body()), builder_(scope.builder()) {}

    Forms emit(const Instruction& instruction);

private:
    std::optional<Forms> evaluated(const Instruction& instruction);
    Forms constant(std::uint64_t word) const;
    Forms emit_source(const Instruction& instruction);
    Forms emit_arithmetic(const Instruction& instruction);
    Forms emit_multiply_add(const Instruction& instruction);
    Forms emit_comparison(const Instruction& instruction);
    Forms emit_logic(const Instruction& instruction);
    Forms emit_select(const Instruction& instruction);
    Forms emit_word(const Instruction& instruction);

    BodyScope& scope_;
    const Body& body_;
    Builder& builder_;
};

// The result of an operation on constants, computed by the interpreter's function evaluate().
std::optional<Forms> BodyEmitter::evaluated(const Instruction& instruction) {
    std::array<std::uint64_t, 3> words{};
    const auto arity = static_cast<std::size_t>(info(instruction.op).arity);
    if (arity == 0) return std::nullopt;
    for (std::size_t k = 0; k < arity; ++k) {
        const auto word = scope_.constant_word(instruction.operands[k]);
        if (!word) return std::nullopt;
        words[k] = *word;
    }
    const FlushDenormals environment;
    return constant(evaluate(instruction.op, words[0], words[1], words[2], body_.kernel.precision));
}

Forms BodyEmitter::constant(std::uint64_t word) const {
    Forms value;
    value.number = body_.number(word);
    value.may_be_denormal = body_.format.is_denormal(word);
    value.is_choice = true;
    return value;
}

Forms BodyEmitter::emit(const Instruction& instruction) {
    if (const auto value = evaluated(instruction)) return *value;
    switch (instruction.op) {
        case Op::constant:
        case Op::field:
        case Op::laplacian:
        case Op::neighbour:
        case Op::link_flow:
        case Op::link_squares:
        case Op::link_weighted:
        case Op::gradient_x:
        case Op::gradient_y:
        case Op::gradient_z:
        case Op::theirs:
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
        case Op::link_sum:
        case Op::link_least:
        case Op::link_greatest: break;
    }
    CHECK(false, "an operation of the table, and no loop");
    return {};
}

Forms BodyEmitter::emit_source(const Instruction& instruction) {
    Sources& sources = scope_.sources();
    Forms value;
    switch (instruction.op) {
        case Op::constant: return constant(instruction.payload);
        case Op::field:
            value.number = sources.field(instruction.field());
            value.may_be_denormal = true;
            break;
        case Op::laplacian: value.number = sources.laplacian(instruction.field()); break;
        case Op::neighbour:
            value.number = sources.neighbour(Neighbour::of(instruction.slot()));
            value.may_be_denormal = true;
            break;
        case Op::link_flow:
        case Op::link_squares:
        case Op::link_weighted:
        case Op::gradient_x:
        case Op::gradient_y:
        case Op::gradient_z: value.number = sources.link_sum(instruction); break;
        case Op::theirs:
            value.number = sources.theirs(instruction.field());
            value.may_be_denormal = true;
            break;
        case Op::mask:
            value.truth = sources.mask(MaskSlot(instruction.slot()));
            value.is_boolean = value.is_choice = true;
            break;
        case Op::uniform:
            value.number = sources.uniform(UniformSlot(instruction.slot()));
            value.may_be_denormal = true;
            break;
        default:
            value.bits = instruction.op == Op::cell_row     ? sources.cell_row()
                         : instruction.op == Op::cell_slice ? sources.cell_slice()
                                                            : sources.cell_column();
            value.may_be_denormal = true;
            break;
    }
    return value;
}

Forms BodyEmitter::emit_arithmetic(const Instruction& instruction) {
    const ValueId a = instruction.operands[0];
    const ValueId b = instruction.operands[1];
    Forms value;
    value.may_be_neutral = scope_.forms(a).may_be_neutral ||
                           (info(instruction.op).arity == 2 && scope_.forms(b).may_be_neutral);
    switch (instruction.op) {
        case Op::add:
            value.number = builder_.CreateFAdd(scope_.operand(a, b, 0), scope_.operand(b, a, 0));
            break;
        case Op::subtract:
            value.number = builder_.CreateFSub(scope_.operand(a, b, 0), scope_.operand(b, a, 0));
            break;
        case Op::multiply:
            value.number = builder_.CreateFMul(scope_.operand(a, b, 1), scope_.operand(b, a, 1));
            break;
        case Op::divide:
            value.number = builder_.CreateFDiv(scope_.operand(a, b, 1), scope_.operand(b));
            break;
        case Op::negate:
            value.number = builder_.CreateFNeg(scope_.number(a));
            value.may_be_denormal = scope_.forms(a).may_be_denormal;
            break;
        case Op::absolute:
            value.number = builder_.CreateUnaryIntrinsic(llvm::Intrinsic::fabs, scope_.number(a));
            value.may_be_denormal = scope_.forms(a).may_be_denormal;
            break;
        case Op::round_to_even: value.number = rounded_to_even(scope_, a); break;
        case Op::scale_by_power: value.number = scaled_by_power(scope_, a, b); break;
        default:
            value.number = builder_.CreateUnaryIntrinsic(llvm::Intrinsic::sqrt, scope_.operand(a));
            break;
    }
    return value;
}

// LLVM drops a factor of ±1. It then treats the operation as a sum, and drops an added 0.
Forms BodyEmitter::emit_multiply_add(const Instruction& instruction) {
    const auto [a, b, c] = instruction.operands;
    Forms value;
    value.may_be_neutral = scope_.forms(a).may_be_neutral || scope_.forms(b).may_be_neutral ||
                           scope_.forms(c).may_be_neutral;
    value.number = builder_.CreateIntrinsic(llvm::Intrinsic::fma, {body_.number_type},
                                            {scope_.operand(a, b, 1), scope_.operand(b, a, 1),
                                             scope_.operand(c)});
    return value;
}

Forms BodyEmitter::emit_comparison(const Instruction& instruction) {
    llvm::Value* a = scope_.operand(instruction.operands[0]);
    llvm::Value* b = scope_.operand(instruction.operands[1]);
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

Forms BodyEmitter::emit_logic(const Instruction& instruction) {
    llvm::Value* a = scope_.truth(instruction.operands[0]);
    Forms value;
    value.is_boolean = value.is_choice = true;
    switch (instruction.op) {
        case Op::logical_and:
            value.truth = builder_.CreateAnd(a, scope_.truth(instruction.operands[1]));
            break;
        case Op::logical_or:
            value.truth = builder_.CreateOr(a, scope_.truth(instruction.operands[1]));
            break;
        default: value.truth = builder_.CreateNot(a); break;
    }
    return value;
}

// LLVM would turn a choice between two compared numbers into the processor's min or max, which
// flush denormals. So words that may be denormal are chosen as integers.
Forms BodyEmitter::emit_select(const Instruction& instruction) {
    const auto [condition, then, otherwise] = instruction.operands;
    llvm::Value* choice = scope_.truth(condition);
    const Forms& first = scope_.forms(then);
    const Forms& second = scope_.forms(otherwise);
    Forms value;
    value.is_choice = first.is_choice && second.is_choice;
    if (first.is_boolean && second.is_boolean) {
        value.truth = builder_.CreateSelect(choice, scope_.truth(then), scope_.truth(otherwise));
        value.is_boolean = true;
        return value;
    }
    value.may_be_denormal = first.may_be_denormal || second.may_be_denormal;
    value.may_be_neutral =
        first.is_choice || second.is_choice || first.may_be_neutral || second.may_be_neutral;
    llvm::Value* a = scope_.branch(then, otherwise);
    llvm::Value* b = scope_.branch(otherwise, then);
    if (value.may_be_denormal) {
        value.bits = builder_.CreateSelect(choice, builder_.CreateBitCast(a, body_.bits_type),
                                           builder_.CreateBitCast(b, body_.bits_type));
    } else {
        value.number = builder_.CreateSelect(choice, a, b);
    }
    return value;
}

Forms BodyEmitter::emit_word(const Instruction& instruction) {
    llvm::Value* a = scope_.bits(instruction.operands[0]);
    Forms value;
    if (instruction.op == Op::bits_to_number) {
        value.number = builder_.CreateSIToFP(a, body_.number_type);
        // The number is true if the word is not 0. Testing the word avoids the conversion.
        value.truth = builder_.CreateICmpNE(a, body_.bits(0));
        return value;
    }
    llvm::Value* b = scope_.bits(instruction.operands[1]);
    // Amounts above 31 (63 in binary64) do not occur, but LLVM cannot deduce this. In LLVM the
    // result of such a shift is undefined, so LLVM might change other code that depends on it. The
    // mask excludes such amounts. If the amount is a constant, LLVM removes the mask.
    const auto amount = [&] {
        return builder_.CreateAnd(b, body_.bits(static_cast<std::uint64_t>(body_.format.bits - 1)));
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

}  // namespace

void emit_body(BodyScope& scope) {
    const Body& body = scope.body();
    std::vector<ValueId> values;
    for (const ValueId id : body.kernel.code.ids()) {
        if (body.levels[id] == scope.level()) values.push_back(id);
    }
    emit_values(scope, values);
}

void emit_values(BodyScope& scope, llvm::ArrayRef<ValueId> values,
                 llvm::function_ref<void(ValueId)> after) {
    BodyEmitter emitter(scope);
    for (const ValueId id : values) {
        scope.define(id, emitter.emit(scope.body().kernel.code[id]));
        after(id);
    }
}

}  // namespace cascade

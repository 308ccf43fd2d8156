// Rounding to whole numbers and scaling by powers of two: instructions where the processor has
// them, and the sequences of ir/word_operations.h elsewhere, with the same bits.
#include "jit/emit_body.h"

#include <llvm/IR/IntrinsicsX86.h>

#include <cmath>

namespace cascade {

llvm::Value* BodyScope::rounded_to_even(ValueId a) {
    if (shape_.has_rounding) {
        return builder_.CreateUnaryIntrinsic(llvm::Intrinsic::roundeven, operand(a));
    }
    const auto constant = [&](double value) { return llvm::ConstantFP::get(number_type_, value); };
    llvm::Constant* all_whole = constant(std::ldexp(1.0, format_.fraction_bits));
    llvm::Value* number = operand(a);
    llvm::Value* size = builder_.CreateUnaryIntrinsic(llvm::Intrinsic::fabs, number);
    llvm::Value* rounded = builder_.CreateFSub(builder_.CreateFAdd(size, all_whole), all_whole);
    llvm::Value* with_sign =
        builder_.CreateBinaryIntrinsic(llvm::Intrinsic::copysign, rounded, number);
    return builder_.CreateSelect(builder_.CreateFCmpOLT(size, all_whole), with_sign, number);
}

// The number that is added is hidden: LLVM would drop a factor of 1, which flushes, and compute a
// product of known factors without flushing it.
llvm::Value* BodyScope::scaled_by_power(ValueId a, ValueId b) {
    const bool is_widest = shape_.lanes * format_.bits == 512;
    if (shape_.has_scaling && is_widest) return scaled_by_instruction(number(a), number(b));
    const double whole = std::ldexp(1.5, format_.fraction_bits) + 2 * format_.bias;
    llvm::Value* added = hidden(word_of(whole, kernel_.precision));
    llvm::Value* sum = builder_.CreateBitCast(builder_.CreateFAdd(number(b), added), bits_type_);
    llvm::Value* half = builder_.CreateLShr(sum, word_splat(1));
    const auto power = [&](llvm::Value* exponent) {
        const auto bits = static_cast<std::uint64_t>(format_.fraction_bits);
        return builder_.CreateBitCast(builder_.CreateShl(exponent, word_splat(bits)), number_type_);
    };
    return builder_.CreateFMul(builder_.CreateFMul(number(a), power(half)),
                               power(builder_.CreateSub(sum, half)));
}

// All lanes, rounded as the environment says.
llvm::Value* BodyScope::scaled_by_instruction(llvm::Value* a, llvm::Value* b) {
    const bool is_single = kernel_.precision == Precision::single;
    const auto instruction = is_single ? llvm::Intrinsic::x86_avx512_mask_scalef_ps_512
                                       : llvm::Intrinsic::x86_avx512_mask_scalef_pd_512;
    constexpr unsigned current_rounding = 4;
    llvm::Value* all =
        llvm::ConstantInt::getAllOnesValue(builder_.getIntNTy(static_cast<unsigned>(shape_.lanes)));
    return builder_.CreateIntrinsic(instruction, {},
                                    {a, b, a, all, builder_.getInt32(current_rounding)});
}

}  // namespace cascade

// Rounding to whole numbers, and scaling by powers of two.
#include "jit/whole_numbers.h"

#include <llvm/IR/IntrinsicsX86.h>

#include <cmath>

namespace cascade {
namespace {

/// In all lanes, with the rounding of the environment.
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

}  // namespace

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

// The number that is added is hidden: LLVM would drop a factor of 1, which flushes, and compute a
// product of known factors without flushing it.
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

}  // namespace cascade

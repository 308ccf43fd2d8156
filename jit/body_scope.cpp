// Converts values from one form to another, and passes them from outer scopes to inner ones.
#include "jit/body_scope.h"

#include "core/check.h"

#include <llvm/IR/Constants.h>
#include <llvm/IR/DerivedTypes.h>

namespace cascade {
namespace {

/// Whether all lanes of `value` are the constant `magnitude` or −`magnitude`.
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

Body body_of(const CellKernel& kernel, const KernelShape& shape, Builder& builder) {
    const auto vector_of = [&](llvm::Type* element) {
        return llvm::FixedVectorType::get(element, static_cast<unsigned>(shape.lanes));
    };
    return {kernel,
            shape,
            format_of(kernel.precision),
            loop_levels_of(kernel),
            vector_of(number_type(builder, kernel.precision)),
            vector_of(word_type(builder, kernel.precision))};
}

llvm::Constant* Body::number(std::uint64_t word) const {
    return llvm::ConstantFP::get(number_type, number_constant(word, kernel.precision));
}

llvm::Constant* Body::bits(std::uint64_t word) const {
    return llvm::ConstantInt::get(bits_type, word);
}

BodyScope& BodyScope::owner(ValueId id) {
    BodyScope* scope = this;
    while (scope->level_ != body_.levels[id]) {
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
    value.number = value.bits ? scope.builder_.CreateBitCast(value.bits, body_.number_type)
                              : scope.builder_.CreateSelect(value.truth, hidden(body_.format.one()),
                                                            hidden(0));
    return value.number;
}

llvm::Value* BodyScope::bits(ValueId id) {
    BodyScope& scope = owner(id);
    Forms& value = scope.values_[id];
    if (!value.bits) {
        llvm::Value* from = number(id);
        value.bits = scope.builder_.CreateBitCast(from, body_.bits_type);
    }
    return value.bits;
}

llvm::Value* BodyScope::truth(ValueId id) {
    BodyScope& scope = owner(id);
    Forms& value = scope.values_[id];
    if (!value.truth) {
        llvm::Value* from = scope.operand(id);
        value.truth = scope.builder_.CreateFCmpUNE(from, body_.number(0));
    }
    return value.truth;
}

// The number, or zero of the same sign if the number is denormal. Uses integer operations, which
// LLVM does not alter.
llvm::Value* BodyScope::flushed(ValueId id) {
    llvm::Value* word = bits(id);
    llvm::Value* exponent = builder_.CreateAnd(word, body_.bits(body_.format.exponent()));
    llvm::Value* is_tiny = builder_.CreateICmpEQ(exponent, body_.bits(0));
    llvm::Value* zero = builder_.CreateAnd(word, body_.bits(body_.format.sign()));
    return builder_.CreateBitCast(builder_.CreateSelect(is_tiny, zero, word), body_.number_type);
}

llvm::Value* BodyScope::hidden(std::uint64_t word) {
    BodyScope* scope = this;
    while (scope->outer_) scope = scope->outer_;
    llvm::Value*& value = scope->hidden_[word];
    if (!value) value = scope->sources_.hidden(word);
    return value;
}

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
        return form == value.truth ? word * body_.format.one() : word;
    }
    return std::nullopt;
}

// A constant that may be denormal is flushed here, because LLVM may evaluate operations on
// constants without flushing.
llvm::Value* BodyScope::operand(ValueId id) {
    return forms(id).may_be_denormal && constant_word(id) ? flushed(id) : number(id);
}

// LLVM drops an operation whose only effect is to flush. It does so even if `partner` is a choice
// and the operation has no other effect in only one of its branches.
llvm::Value* BodyScope::operand(ValueId id, ValueId partner, double neutral) {
    if (!forms(id).may_be_denormal) return number(id);
    const bool may_be_neutral =
        is_plus_or_minus(operand(partner), neutral) || forms(partner).may_be_neutral;
    return may_be_neutral ? flushed(id) : operand(id);
}

// A constant is hidden if the other branch is a constant, too. It is not hidden if the other branch
// is a variable, so that a clamp becomes the processor's max.
llvm::Value* BodyScope::branch(ValueId id, ValueId other) {
    const auto word = constant_word(id);
    return word && forms(other).is_choice ? hidden(*word) : number(id);
}

}  // namespace cascade

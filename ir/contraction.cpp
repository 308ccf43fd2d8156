// Rebuilds the kernel in one pass over its code. If both operands of a sum are products, the first
// product is fused, unless only the second product has a uniform factor.
#include "ir/contraction.h"

#include "ir/builder.h"

#include <optional>
#include <vector>

namespace cascade {
namespace {

/// A product that may be fused. Its factors are values of the new kernel. A uniform factor comes
/// first.
struct Product {
    ValueId first;
    ValueId second;
    bool has_coefficient;  ///< Whether the first factor is uniform.
};

class Contraction {
public:
    explicit Contraction(const CellKernel& kernel)
        : kernel_(kernel),
          builder_(kernel.precision),
          varies_(varying(kernel)),
          is_kept_(kernel.code.size()),
          products_(kernel.code.size()),
          renamed_(kernel.code.size()) {
        for (const std::string& name : kernel.field_names) builder_.field_slot(name);
        for (const std::string& name : kernel.mask_names) builder_.mask_slot(name);
        for (const std::string& name : kernel.uniform_names) builder_.uniform_slot(name);
        for (const ValueId id : kernel.kept) is_kept_[id] = true;
    }

    /// Rewrites every value and returns the kernel. finish() drops products that were fused and
    /// that no other value reads.
    CellKernel contracted() && {
        for (const ValueId id : kernel_.code.ids()) renamed_[id] = rewritten(id);
        for (std::size_t k = 0; k < kernel_.results.size(); ++k) {
            builder_.result(kernel_.result_names[k], renamed_[kernel_.results[k]]);
        }
        return std::move(builder_).finish();
    }

private:
    ValueId rewritten(ValueId id) {
        const Instruction& instruction = kernel_.code[id];
        const auto [a, b, c] = instruction.operands;
        const bool may_change = varies_[id] && !is_kept_[id];
        if (instruction.op == Op::multiply && may_change) {
            const bool swaps = varies_[a] && !varies_[b];
            return product(id, renamed_[swaps ? b : a], renamed_[swaps ? a : b],
                           !varies_[a] || !varies_[b]);
        }
        if (instruction.op == Op::divide && may_change && !varies_[b]) {
            const ValueId reciprocal = builder_.divide(builder_.number(1), renamed_[b]);
            return product(id, reciprocal, renamed_[a], true);
        }
        if ((instruction.op == Op::add || instruction.op == Op::subtract) && a != b) {
            if (const std::optional<ValueId> fused = product_of_sum(a, b)) {
                return multiply_add(instruction, *fused);
            }
        }
        Instruction copy = instruction;
        for (int k = 0; k < info(copy.op).arity; ++k) {
            ValueId& operand = copy.operands[static_cast<std::size_t>(k)];
            operand = renamed_[operand];
        }
        return builder_.emit(copy);
    }

    ValueId product(ValueId id, ValueId first, ValueId second, bool has_coefficient) {
        products_[id] = {first, second, has_coefficient};
        return builder_.multiply(first, second);
    }

    std::optional<ValueId> product_of_sum(ValueId a, ValueId b) const {
        if (!products_[a] && !products_[b]) return std::nullopt;
        if (!products_[a] || !products_[b]) return products_[a] ? a : b;
        return products_[a]->has_coefficient && !products_[b]->has_coefficient ? a : b;
    }

    /// Fuses a product into a sum or a difference. If the product is subtracted, negates its
    /// varying factor, because a negated uniform factor would need another register.
    ValueId multiply_add(const Instruction& sum, ValueId fused) {
        const bool is_second = sum.operands[1] == fused;
        auto [first, second, has_coefficient] = *products_[fused];
        ValueId added = renamed_[sum.operands[is_second ? 0 : 1]];
        if (sum.op == Op::subtract) {
            ValueId& turned = is_second ? second : added;
            turned = builder_.apply(Op::negate, turned);
        }
        return builder_.apply(Op::multiply_add, first, second, added);
    }

    const CellKernel& kernel_;
    KernelBuilder builder_;
    IdVector<ValueId, bool> varies_, is_kept_;
    /// For each value of the old kernel: the product, if the value is one that may be fused.
    IdVector<ValueId, std::optional<Product>> products_;
    /// For each value of the old kernel, its value in the new kernel.
    IdVector<ValueId, ValueId> renamed_;
};

}  // namespace

CellKernel contracted(const CellKernel& kernel) { return Contraction(kernel).contracted(); }

}  // namespace cascade

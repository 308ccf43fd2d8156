// The rates of a system as one list of parts: definitions and rates are replaced by what they stand
// for, equal parts are one part. For formulas about formulas.
#pragma once

#include "lang/program/formula_builder.h"
#include "lang/program/program.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cascade {

/// The rules of calculus give up on formulas larger than this, which cost more than they tell.
inline constexpr std::size_t most_calculus_parts = 100'000;

class FlatRates {
public:
    explicit FlatRates(const System& system);

    /// Holds the parts of the rates first and whatever is made of them after.
    FormulaBuilder& builder() { return builder_; }
    const FormulaBuilder& builder() const { return builder_; }
    PartId rate(std::uint32_t item) const { return rates_[item]; }
    /// Another formula of the system, in the same list.
    PartId add(const Formula& formula);
    /// Parts that the rates are made of are below this.
    std::size_t part_count() const { return count_; }

private:
    FormulaBuilder builder_;
    std::vector<PartId> definitions_, rates_;
    std::size_t count_ = 0;
};

}  // namespace cascade

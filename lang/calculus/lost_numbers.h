// Finds parts of formulas that may be NaN without making any species NaN.
#pragma once

#include "lang/calculus/algebra.h"

#include <cstdint>
#include <vector>

namespace cascade {

/// A part of a formula whose value may be NaN without any visible effect: the NaN is lost.
struct LostNumber {
    Formula is_lost;  ///< A formula that is not 0 in the cells where the NaN is lost.
    Span span;        ///< Where the part is in the script.
};

/// Searches the formulas of a system.
class LostNumbers {
public:
    explicit LostNumbers(const System& system) : flat_(system) {}

    /// Finds the operands of comparisons in a formula that may be NaN because of a root, a
    /// logarithm, a quotient, a power or an arc function. A comparison with such an operand is
    /// false. An operand is left out if the result of the comparison does not matter in the cells
    /// where the operand is NaN, as in `if(u > 0, sqrt(u) < 1, 0)` or `u > 0 and sqrt(u) < 1`.
    /// Formulas that draw random numbers are left out, because a check would draw other numbers.
    /// Parts that read files are left out, too, because their NaN may be intended.
    std::vector<LostNumber> in_comparisons(const Formula& formula);
    std::vector<LostNumber> in_rate(ItemId species);

    /// Finds the whole formula of a bound or a condition, if its value may be NaN because of one of
    /// the functions named above. A bound that is NaN has no effect.
    std::vector<LostNumber> as_whole(const Formula& formula);

private:
    class Search;
    std::vector<LostNumber> in_comparisons(NodeId root);
    bool is_random(NodeId root) const;
    void know_all_parts();
    bool makes_nan(const Node& node) const;

    FlatRates flat_;
    IdVector<NodeId, bool> may_be_nan_, reads_file_;
};

}  // namespace cascade

// Finds places where a NaN in a formula is lost, so that no species ever shows it.
#pragma once

#include "lang/calculus/algebra.h"

#include <cstdint>
#include <vector>

namespace cascade {

/// A part of a formula that may be NaN unnoticed.
struct LostNumber {
    Formula is_lost;  ///< Not 0 in the cells where that happens.
    Span span;        ///< Of the part.
};

/// Searches the formulas of a system.
class LostNumbers {
public:
    explicit LostNumbers(const System& system) : flat_(system) {}

    /// The operands of comparisons in a formula that may be NaN because of a root, a logarithm, a
    /// quotient, a power or an arc function: a comparison with NaN is false. Operands are left out
    /// if a condition decides that the comparison does not matter, as in `if(u > 0, sqrt(u) < 1,
    /// 0)` or `u > 0 and sqrt(u) < 1`. Formulas that draw random numbers are left out, because a
    /// check would draw others, and so are parts that read files, in which NaN may be meant.
    std::vector<LostNumber> in_comparisons(const Formula& formula);
    std::vector<LostNumber> in_rate(ItemId species);

    /// The whole formula of a bound or a condition, if it may be NaN in the same way: a bound that
    /// is NaN holds nothing.
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

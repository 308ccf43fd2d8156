// Where a NaN is lost on its way through a formula, so that no value of a species ever shows it.
#pragma once

#include "lang/calculus/algebra.h"

#include <cstdint>
#include <vector>

namespace cascade {

/// A part of a formula that may be NaN, and whose NaN nobody would see.
struct LostNumber {
    Formula is_lost;  ///< Not 0 in cells where that has happened.
    Span span;        ///< Of the part.
};

/// Looks through formulas of a system.
class LostNumbers {
public:
    explicit LostNumbers(const System& system) : flat_(system) {}

    /// The operands of comparisons in a formula that may be NaN by a root, a logarithm, a quotient,
    /// a power or an arc: a comparison with NaN is false. Not where a condition around it decides
    /// that the comparison does not matter, as in `if(u > 0, sqrt(u) < 1, 0)` or `u > 0 and sqrt(u)
    /// < 1`. Formulas that draw random numbers have none here, for they would draw others, and so
    /// have parts that read files, in which NaN may be meant.
    std::vector<LostNumber> in_comparisons(const Formula& formula);
    std::vector<LostNumber> in_rate(std::uint32_t item);

    /// The whole formula, if it may be NaN in the same way: that of a bound, which is none where it
    /// is NaN, or of a condition.
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

// Formulas as a list of operations on numbers, for fast evaluation with thousands of values of
// parameters.
#pragma once

#include "lang/calculus/algebra.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cascade::analysis {

class Tape {
public:
    /// `results` are the formulas. They may contain numbers, functions of numbers, and the leaves
    /// that are in `inputs`.
    Tape(const Algebra& algebra, std::span<const NodeId> results, std::span<const NodeKind> inputs);

    /// The value of each formula. `inputs` has one number for each input.
    std::vector<double> run(std::span<const double> inputs) const;

private:
    struct Step {
        Function function;
        std::uint32_t a, b, c, to;
    };

    /// The initial value of each register. The inputs come first, then the numbers. Registers of
    /// results are 0.
    std::vector<double> numbers_;
    std::vector<Step> steps_;
    std::vector<std::uint32_t> results_;  ///< The register of each result.
};

}  // namespace cascade::analysis

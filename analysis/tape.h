// Formulas as a list of operations on numbers, for quick repetition at thousands of parameters.
#pragma once

#include "lang/calculus/algebra.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cascade::analysis {

class Tape {
public:
    /// The formulas may hold numbers, leaves that are among `inputs`, and functions of numbers.
    Tape(const Algebra& algebra, std::span<const NodeId> results, std::span<const NodeKind> inputs);

    /// The value of each formula. `inputs` has one number for each input.
    std::vector<double> run(std::span<const double> inputs) const;

private:
    struct Step {
        Function function;
        std::uint32_t a, b, c, to;
    };

    std::vector<double> numbers_;  ///< By register, inputs first. Those of steps are 0.
    std::vector<Step> steps_;
    std::vector<std::uint32_t> results_;  ///< The registers of results.
};

}  // namespace cascade::analysis

// Formulas as a list of operations on numbers, for the same formulas at thousands of parameters.
#pragma once

#include "lang/calculus/algebra.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cascade::analysis {

class Tape {
public:
    /// Formulas of numbers, leaves that are among `inputs`, and functions of numbers.
    Tape(const Algebra& algebra, std::span<const NodeId> results, std::span<const NodeKind> inputs);

    /// The value of each formula; `inputs` has one number for each input.
    std::vector<double> run(std::span<const double> inputs) const;

private:
    struct Step {
        Function function;
        std::uint32_t a, b, c, to;
    };

    std::vector<double> numbers_;  ///< By register: first the inputs. Those of steps are 0.
    std::vector<Step> steps_;
    std::vector<std::uint32_t> results_;  ///< Their registers.
};

}  // namespace cascade::analysis

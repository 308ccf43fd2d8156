// Evaluates expressions of the command line that have the same value in all cells, at a moment of a
// run.
#pragma once

#include "core/result.h"
#include "run/commands/stage_formulas.h"
#include "run/simulation/simulation.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cascade {

class UniformNumbers {
public:
    /// Checks the expressions of an option, such as "--log", for all stages that run. An expression
    /// that is valid in no stage, or that varies by cell, is an error in `script.diagnostics`.
    static Result<UniformNumbers> create(Script& script, const std::string& option,
                                         std::span<const std::string> expressions);

    std::size_t count() const { return formulas_.count(); }
    /// Returns the values of the expressions in a started stage. A value is NaN if its expression
    /// has no meaning in the stage.
    std::vector<double> at(const Simulation& simulation, std::uint32_t stage) const;

private:
    StageFormulas formulas_;
};

}  // namespace cascade

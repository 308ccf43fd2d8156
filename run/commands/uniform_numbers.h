// Numbers that expressions of the command line have at a moment of a run, the same for all cells.
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
    /// Checks the expressions of an option, such as "--log", for all stages that run. One that fits
    /// none of them, or varies by cell, is an error in `script.diagnostics`.
    static Result<UniformNumbers> create(Script& script, const std::string& option,
                                         std::span<const std::string> expressions);

    std::size_t count() const { return formulas_.count(); }
    /// The numbers in a started stage; NaN where an expression has no meaning in it.
    std::vector<double> at(const Simulation& simulation, std::uint32_t stage) const;

private:
    StageFormulas formulas_;
};

}  // namespace cascade

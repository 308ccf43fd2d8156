// Numbers of single cells in the log: "EXPR at (x, y)".
#pragma once

#include "core/result.h"
#include "run/commands/stage_formulas.h"
#include "run/script/script.h"
#include "run/simulation/simulation.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

/// The expressions of a log that are each evaluated in one cell.
class Probes {
public:
    /// If a text has the form "EXPR at (x, y)" or "EXPR at x, y", adds a probe and returns true. If
    /// the domain has no such place, adds no probe but an error to `script.diagnostics`.
    bool take(Script& script, const std::string& option, const std::string& text);
    /// Checks the expressions of all probes. Errors are reported in `script.diagnostics`.
    Result<void> check(Script& script, const std::string& option);
    /// Returns the values in a started stage, in the order of the probes. A value is NaN if its
    /// expression has no meaning in the stage, or if its place is outside a mask.
    std::vector<double> at(const Simulation& simulation, std::uint32_t stage) const;

private:
    std::vector<std::string> expressions_;
    /// Coordinates from 0 to 1 along the longest side of the domain.
    std::vector<std::array<double, 3>> places_;
    StageFormulas formulas_;
    bool is_wrong_ = false;
};

}  // namespace cascade

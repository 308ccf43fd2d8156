// A number of one cell in the log: "EXPR at (x, y)".
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

/// The expressions of a log that are read in one cell.
class Probes {
public:
    /// Whether a text has the form "EXPR at (x, y)" or "EXPR at x, y". If so, adds a probe, or an
    /// error in `script.diagnostics` if the domain has no such place.
    bool take(Script& script, const std::string& option, const std::string& text);
    /// Checks the expressions of all probes. Errors are reported in `script.diagnostics`.
    Result<void> check(Script& script, const std::string& option);
    /// The values in a started stage, in the order of the probes. NaN if an expression has no
    /// meaning in the stage, and outside a mask.
    std::vector<double> at(const Simulation& simulation, std::uint32_t stage) const;

private:
    std::vector<std::string> expressions_;
    std::vector<std::array<double, 3>> places_;  ///< 0 to 1 along the longest side.
    StageFormulas formulas_;
    bool is_wrong_ = false;
};

}  // namespace cascade

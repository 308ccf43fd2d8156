// Expressions of the command line, checked in every stage of a run as if it were the last.
#pragma once

#include "core/result.h"
#include "lang/program/program.h"
#include "run/script/script.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cascade {

enum class FormulaKind : std::uint8_t {
    uniform,     ///< One number for all cells.
    for_a_cell,  ///< May be another number in each.
};

class StageFormulas {
public:
    /// Checks the expressions of an option, such as "--log", for all stages that run. One that fits
    /// none of them, or is not of the kind, is an error in `script.diagnostics`.
    static Result<StageFormulas> create(Script& script, const std::string& option,
                                        std::span<const std::string> expressions, FormulaKind kind);

    /// Whether a text is an expression that has a meaning in some stage that runs.
    static bool fits_some(Script& script, const std::string& option, const std::string& text);

    std::size_t count() const { return formulas_.size(); }
    /// Null where the expression has no meaning in the stage.
    const Formula* at(std::size_t expression, std::uint32_t stage) const;
    /// Those that have a meaning, in their order.
    std::vector<const Formula*> known_in(std::uint32_t stage) const;

private:
    bool add(Script& script, const std::string& option, const std::string& text, FormulaKind kind);

    std::vector<std::vector<std::optional<Formula>>> formulas_;  ///< By expression and stage.
};

}  // namespace cascade

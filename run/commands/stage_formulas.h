// Checks expressions of the command line in every stage of a run, as if each stage were the last.
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
    uniform,     ///< The value is the same number in all cells.
    for_a_cell,  ///< The value may differ from cell to cell.
};

class StageFormulas {
public:
    /// Checks the expressions of an option, such as "--log", for all stages that run. An expression
    /// that is valid in no stage, or that is not of the given kind, is an error in
    /// `script.diagnostics`.
    static Result<StageFormulas> create(Script& script, const std::string& option,
                                        std::span<const std::string> expressions, FormulaKind kind);

    /// Whether the text is an expression that has a meaning in at least one stage that runs.
    static bool fits_some(Script& script, const std::string& option, const std::string& text);

    std::size_t count() const { return formulas_.size(); }
    /// Returns the formula of an expression in a stage. Returns null if the expression has no
    /// meaning in the stage.
    const Formula* at(std::size_t expression, std::uint32_t stage) const;
    /// Returns the formulas of the expressions that have a meaning in the stage, in the order of
    /// the expressions.
    std::vector<const Formula*> known_in(std::uint32_t stage) const;

private:
    bool add(Script& script, const std::string& option, const std::string& text, FormulaKind kind);

    /// The formula of each expression in each stage. Empty if the expression has no meaning in the
    /// stage.
    std::vector<std::vector<std::optional<Formula>>> formulas_;
};

}  // namespace cascade

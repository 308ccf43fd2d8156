// If an expression is valid in no stage, the error of the last stage is reported, as for --show.
#include "run/commands/stage_formulas.h"

#include "lang/check/check.h"
#include "lang/lower/lower.h"
#include "lang/syntax/parse.h"

#include <fmt/format.h>

namespace cascade {

Result<StageFormulas> StageFormulas::create(Script& script, const std::string& option,
                                            std::span<const std::string> expressions,
                                            FormulaKind kind) {
    StageFormulas all;
    bool right = true;
    for (const std::string& text : expressions) {
        right = all.add(script, option, text, kind) && right;
    }
    if (!right) return failure(fmt::format("an expression of {} is wrong", option));
    return all;
}

bool StageFormulas::fits_some(Script& script, const std::string& option, const std::string& text) {
    Diagnostics unspoken;
    const SourceId source = script.sources.add(fmt::format("<{}>", option), text);
    const auto expression = parse_expression(source, script.sources, script.tree, unspoken);
    for (std::uint32_t k = 0; expression && k < script.stage_count(); ++k) {
        Diagnostics of_stage;
        check_view(script.tree, *expression, k, k, *script.program, script.sources, of_stage);
        if (!of_stage.has_errors()) return true;
    }
    return false;
}

bool StageFormulas::add(Script& script, const std::string& option, const std::string& text,
                        FormulaKind kind) {
    const SourceId source = script.sources.add(fmt::format("<{}>", option), text);
    const auto expression =
        parse_expression(source, script.sources, script.tree, script.diagnostics);
    if (!expression) return false;
    std::vector<std::optional<Formula>> formulas;
    bool fits_some = false;
    for (std::uint32_t k = 0; k < script.stage_count(); ++k) {
        Diagnostics unspoken;
        auto formula =
            check_view(script.tree, *expression, k, k, *script.program, script.sources, unspoken);
        if (unspoken.has_errors()) formula.reset();
        if (formula && formula->nodes.back().type != ValueType::number) {
            script.diagnostics.error(formula->nodes.back().span, option + " takes numbers");
            return false;
        }
        if (formula && kind == FormulaKind::uniform &&
            !plan_view(*script.program, *formula, k).is_uniform) {
            script.diagnostics.error(
                formula->nodes.back().span, "this value differs from cell to cell",
                option + " takes one number for all cells, such as mean(e over domain)");
            return false;
        }
        fits_some = fits_some || formula;
        formulas.push_back(std::move(formula));
    }
    if (!fits_some) {
        const std::uint32_t stage = script.final_stage();
        check_view(script.tree, *expression, stage, stage, *script.program, script.sources,
                   script.diagnostics);
        return false;
    }
    formulas_.push_back(std::move(formulas));
    return true;
}

const Formula* StageFormulas::at(std::size_t expression, std::uint32_t stage) const {
    const auto& formula = formulas_[expression][stage];
    return formula ? &*formula : nullptr;
}

std::vector<const Formula*> StageFormulas::known_in(std::uint32_t stage) const {
    std::vector<const Formula*> known;
    for (std::size_t k = 0; k < count(); ++k) {
        if (const Formula* const formula = at(k, stage)) known.push_back(formula);
    }
    return known;
}

}  // namespace cascade

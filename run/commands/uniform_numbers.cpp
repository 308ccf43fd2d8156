// Each expression is checked against every stage; where it has no meaning it has no number.
#include "run/commands/uniform_numbers.h"

#include "lang/check/check.h"
#include "lang/lower/lower.h"
#include "lang/syntax/parse.h"

#include <fmt/format.h>

#include <limits>

namespace cascade {

Result<UniformNumbers> UniformNumbers::create(Script& script, const std::string& option,
                                              std::span<const std::string> expressions) {
    UniformNumbers numbers;
    bool right = true;
    for (const std::string& text : expressions) {
        right = numbers.add(script, option, text) && right;
    }
    if (!right) return failure(fmt::format("an expression of {} is wrong", option));
    return numbers;
}

bool UniformNumbers::add(Script& script, const std::string& option, const std::string& text) {
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
        if (formula && !plan_view(*script.program, *formula, k).is_uniform) {
            script.diagnostics.error(
                formula->nodes.back().span, "this differs from cell to cell",
                option + " takes one number for all cells, such as mean(e over domain)");
            return false;
        }
        fits_some = fits_some || formula;
        formulas.push_back(std::move(formula));
    }
    if (!fits_some) {
        // The message is that of the last stage, as for --show.
        const std::uint32_t stage = script.final_stage();
        check_view(script.tree, *expression, stage, stage, *script.program, script.sources,
                   script.diagnostics);
        return false;
    }
    formulas_.push_back(std::move(formulas));
    return true;
}

std::vector<double> UniformNumbers::at(const Simulation& simulation, std::uint32_t stage) const {
    std::vector<const Formula*> here;
    for (const auto& formulas : formulas_) {
        if (formulas[stage]) here.push_back(&*formulas[stage]);
    }
    const std::vector<double> known = evaluate_numbers(simulation, here, stage);
    auto number = known.begin();
    std::vector<double> numbers;
    for (const auto& formulas : formulas_) {
        numbers.push_back(formulas[stage] ? *number++ : std::numeric_limits<double>::quiet_NaN());
    }
    return numbers;
}

}  // namespace cascade

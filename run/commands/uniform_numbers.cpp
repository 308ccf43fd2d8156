// An expression that has no meaning in a stage has the value NaN there.
#include "run/commands/uniform_numbers.h"

#include <limits>

namespace cascade {

Result<UniformNumbers> UniformNumbers::create(Script& script, const std::string& option,
                                              std::span<const std::string> expressions) {
    auto formulas = StageFormulas::create(script, option, expressions, FormulaKind::uniform);
    if (!formulas) return tl::unexpected(formulas.error());
    UniformNumbers numbers;
    numbers.formulas_ = *std::move(formulas);
    return numbers;
}

std::vector<double> UniformNumbers::at(const Simulation& simulation, std::uint32_t stage) const {
    const std::vector<double> known =
        evaluate_numbers(simulation, formulas_.known_in(stage), stage);
    auto number = known.begin();
    std::vector<double> numbers;
    for (std::size_t k = 0; k < count(); ++k) {
        const bool is_known = formulas_.at(k, stage) != nullptr;
        numbers.push_back(is_known ? *number++ : std::numeric_limits<double>::quiet_NaN());
    }
    return numbers;
}

}  // namespace cascade

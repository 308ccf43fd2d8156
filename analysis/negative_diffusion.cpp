// Evaluates the factors of diffusion with the starting values of parameters.
#include "analysis/negative_diffusion.h"

#include "analysis/start_values.h"
#include "lang/calculus/algebra.h"
#include "lang/calculus/diffusion.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade::analysis {

namespace {

class ConstantFactors {
public:
    ConstantFactors(const Program& program, std::uint32_t stage)
        : program_(program), stage_(stage), starts_(start_values(algebra_, program, stage, {})) {}

    /// The value of a formula; 0 for a formula without nodes. Empty if the value differs from cell
    /// to cell or changes in time.
    std::optional<double> value(const Formula& formula) {
        if (formula.nodes.empty()) return 0;
        const bool is_known = std::all_of(formula.nodes.begin(), formula.nodes.end(), is_plain);
        if (!is_known || changes_in_time(program_, stage_, formula)) return std::nullopt;
        const StartValue start = start_value(algebra_, program_, formula, starts_);
        if (start.differs || start.is_unknown || !algebra_.is_number(start.scatter, 0)) {
            return std::nullopt;
        }
        const double* const number = algebra_[start.value].as<double>();
        return number ? std::optional(*number) : std::nullopt;
    }

private:
    /// Whether the starting value of a node is its value at all times. For other nodes, such as
    /// sums over the domain, the starting value is only an estimate.
    static bool is_plain(const Node& node) {
        const bool is_function = node.is<Call>() && is_elementary(node.function);
        return is_function || node.is<double>() || node.is<ItemId>();
    }

    const Program& program_;
    std::uint32_t stage_;
    Algebra algebra_;
    IdVector<ItemId, StartValue> starts_;
};

/// The coefficient of diffusion. Empty unless it is negative and no other term damps short waves.
std::optional<double> coefficient(ConstantFactors& factors, const SpeciesDiffusion& diffusion) {
    double lowest = 0;
    for (std::size_t term = 0; term < mixed_term; ++term) {
        const auto value = factors.value(diffusion[term]);
        const bool is_second_order = term == 0 || term >= laplacian_powers;
        if (!value || *value > 0 || (*value < 0 && !is_second_order)) return std::nullopt;
        lowest = std::min(lowest, *value);
    }
    return lowest < 0 ? std::optional(lowest) : std::nullopt;
}

}  // namespace

std::optional<std::string> negative_diffusion(const Program& program, std::uint32_t stage) {
    const auto diffusion = diffusion_of(program, stage);
    ConstantFactors factors(program, stage);
    const System& system = program.system_of(stage);
    for (const SpeciesId species : diffusion.ids()) {
        const auto found = coefficient(factors, diffusion[species]);
        if (!found) continue;
        return fmt::format(
            "{} has a negative diffusion coefficient, {:.4g}: the shortest waves grow fastest, "
            "however short the steps are",
            system.item_name(system.species()[species]), *found);
    }
    return std::nullopt;
}

}  // namespace cascade::analysis

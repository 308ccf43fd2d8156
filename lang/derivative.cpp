// Derivatives of rates: forwards, one species at a time, through a list of parts that definitions
// and rates share.
#include "lang/derivative.h"

#include "lang/derivative_rules.h"
#include "lang/flat_rates.h"

#include <vector>

namespace cascade {

namespace {

/// Formulas larger than this cost more than they tell.
constexpr std::size_t most_parts = 100'000;

/// The slopes by a species of all parts of the rates. Empty where there is no rule for one that a
/// rate needs, and where they are too many.
std::optional<std::vector<Slope>> slopes_of(FlatRates& rates, std::uint32_t species,
                                            const Grid& grid) {
    std::vector<Slope> slopes;
    slopes.reserve(rates.part_count());
    for (PartId id = 0; id < rates.part_count(); ++id) {
        const auto slope = slope_of(rates.builder(), id, species, slopes, grid);
        if (!slope || rates.builder().size() > most_parts) return std::nullopt;
        slopes.push_back(*slope);
    }
    return slopes;
}

}  // namespace

std::optional<Formula> rate_derivative(const Program& program, std::uint32_t stage,
                                       std::uint32_t of, std::uint32_t by) {
    FlatRates rates(program.system_of(stage));
    const auto slopes = slopes_of(rates, by, program.domain.grid);
    if (!slopes) return std::nullopt;
    return rates.builder().formula((*slopes)[rates.rate(of)].own);
}

std::optional<JacobianBound> jacobian_bound(const Program& program, std::uint32_t stage) {
    const System& system = program.system_of(stage);
    FlatRates rates(program.system_of(stage));
    FormulaBuilder& builder = rates.builder();
    const PartId zero = builder.number(0);
    std::vector<PartId> whole(system.quantities.size(), zero), reaction = whole,
                        without_own = whole;
    for (std::uint32_t by = 0; by < system.quantities.size(); ++by) {
        if (!system.is_species(by)) continue;
        const auto slopes = slopes_of(rates, by, program.domain.grid);
        if (!slopes) return std::nullopt;
        for (std::uint32_t of = 0; of < system.quantities.size(); ++of) {
            if (!system.is_species(of)) continue;
            const Slope& slope = (*slopes)[rates.rate(of)];
            const PartId own = builder.absolute(slope.own);
            reaction[of] = builder.add(reaction[of], builder.add(own, slope.wide));
            whole[of] = builder.add(whole[of], builder.add(own, slope.far));
            without_own[of] = builder.add(without_own[of],
                                          of == by ? own : builder.add(own, slope.far));
        }
    }
    const auto largest = [&](const std::vector<PartId>& sums) {
        PartId most = zero;
        for (std::uint32_t of = 0; of < system.quantities.size(); ++of) {
            if (!system.is_species(of)) continue;
            most = builder.is_number(most, 0) ? sums[of] : builder.maximum(most, sums[of]);
        }
        return builder.formula(most);
    };
    return JacobianBound{largest(whole), largest(reaction), largest(without_own)};
}

}  // namespace cascade

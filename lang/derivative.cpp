// Derivatives of rates: forwards, one species at a time, through a list of parts that definitions
// and rates share.
#include "lang/derivative.h"

#include "lang/check_circles.h"
#include "lang/derivative_rules.h"
#include "lang/formula_builder.h"

#include <vector>

namespace cascade {

namespace {

/// Formulas larger than this cost more than they tell.
constexpr std::size_t most_parts = 100'000;

/// The rates of a system without definitions.
class FlatRates {
public:
    FlatRates(const Program& program, std::uint32_t stage)
        : program_(program), system_(program.system_of(stage)) {
        const auto definition_count = static_cast<std::uint32_t>(system_.definitions.size());
        definitions_.resize(definition_count);
        rates_.resize(system_.quantities.size());
        for (const std::uint32_t value : topological_order(step_dependencies(system_)).order) {
            if (value < definition_count) {
                definitions_[value] = add(system_.definitions[value].formula);
            } else if (system_.is_species(value - definition_count)) {
                rates_[value - definition_count] = add(system_.rates[value - definition_count]);
            }
        }
        count_ = builder_.size();
    }

    FormulaBuilder& builder() { return builder_; }
    PartId rate(std::uint32_t item) const { return rates_[item]; }

    /// The slopes by a species of all parts of the rates. Empty where there is no rule for one that
    /// a rate needs, and where they are too many.
    std::optional<std::vector<Slope>> slopes(std::uint32_t species) {
        std::vector<Slope> slopes;
        slopes.reserve(count_);
        for (PartId id = 0; id < count_; ++id) {
            const auto slope = slope_of(builder_, id, species, slopes, program_.domain.grid);
            if (!slope || builder_.size() > most_parts) return std::nullopt;
            slopes.push_back(*slope);
        }
        return slopes;
    }

private:
    PartId add(const Formula& formula) {
        std::vector<PartId> places;
        places.reserve(formula.nodes.size());
        for (const Node& node : formula.nodes) {
            Node copy = node;
            copy.span = {};
            if (node.kind == NodeKind::definition) {
                places.push_back(definitions_[node.index]);
                continue;
            }
            if (node.kind == NodeKind::rate) {
                places.push_back(rates_[node.index]);
                continue;
            }
            if (node.kind == NodeKind::call) {
                for (std::size_t n = 0; n < operand_count(node); ++n) {
                    copy.operands[n] = places[node.operands[n]];
                }
            }
            places.push_back(builder_.part(copy));
        }
        return places.back();
    }

    const Program& program_;
    const System& system_;
    FormulaBuilder builder_;
    std::vector<PartId> definitions_, rates_;
    std::size_t count_ = 0;
};

}  // namespace

std::optional<Formula> rate_derivative(const Program& program, std::uint32_t stage,
                                       std::uint32_t of, std::uint32_t by) {
    FlatRates rates(program, stage);
    const auto slopes = rates.slopes(by);
    if (!slopes) return std::nullopt;
    return rates.builder().formula((*slopes)[rates.rate(of)].own);
}

std::optional<JacobianBound> jacobian_bound(const Program& program, std::uint32_t stage) {
    const System& system = program.system_of(stage);
    FlatRates rates(program, stage);
    FormulaBuilder& builder = rates.builder();
    const PartId zero = builder.number(0);
    std::vector<PartId> whole(system.quantities.size(), zero), reaction = whole;
    for (std::uint32_t by = 0; by < system.quantities.size(); ++by) {
        if (!system.is_species(by)) continue;
        const auto slopes = rates.slopes(by);
        if (!slopes) return std::nullopt;
        for (std::uint32_t of = 0; of < system.quantities.size(); ++of) {
            if (!system.is_species(of)) continue;
            const Slope& slope = (*slopes)[rates.rate(of)];
            const PartId own = builder.absolute(slope.own);
            reaction[of] = builder.add(reaction[of], builder.add(own, slope.wide));
            whole[of] = builder.add(whole[of], builder.add(own, slope.far));
        }
    }
    PartId largest = zero, largest_reaction = zero;
    for (std::uint32_t of = 0; of < system.quantities.size(); ++of) {
        if (!system.is_species(of)) continue;
        largest = builder.is_number(largest, 0) ? whole[of] : builder.maximum(largest, whole[of]);
        largest_reaction = builder.is_number(largest_reaction, 0)
                               ? reaction[of]
                               : builder.maximum(largest_reaction, reaction[of]);
    }
    return JacobianBound{builder.formula(largest), builder.formula(largest_reaction)};
}

}  // namespace cascade

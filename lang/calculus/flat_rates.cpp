// Expands definitions in topological order and numbers equal parts once (hash consing).
#include "lang/calculus/flat_rates.h"

#include "lang/program/dependencies.h"

namespace cascade {

FlatRates::FlatRates(const System& system) {
    const auto definition_count = static_cast<std::uint32_t>(system.definitions.size());
    definitions_.resize(definition_count);
    rates_.resize(system.quantities.size());
    for (const std::uint32_t value : topological_order(step_dependencies(system)).order) {
        if (value < definition_count) {
            definitions_[value] = add(system.definitions[value].formula);
        } else if (system.is_species(value - definition_count)) {
            rates_[value - definition_count] = add(system.rates[value - definition_count]);
        }
    }
    count_ = builder_.size();
}

PartId FlatRates::add(const Formula& formula) {
    std::vector<PartId> places;
    places.reserve(formula.nodes.size());
    for (const Node& node : formula.nodes) {
        Node copy = node;
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

}  // namespace cascade

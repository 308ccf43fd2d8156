// Puts formulas into a graph. Each formula is added in one loop over its nodes.
#include "lang/program/flatten.h"

#include "core/check.h"
#include "lang/program/dependencies.h"

#include <array>
#include <utility>

namespace cascade {

NodeId Flattening::add(const Formula& formula, Noise noise) {
    CHECK(!formula.nodes.empty(), "a checked formula has nodes");
    const auto number = static_cast<std::uint32_t>(origins_.size());
    origins_.push_back({&formula, std::move(noise)});
    IdVector<NodeId, NodeId> places;
    places.reserve(formula.nodes.size());
    for (Node node : formula.nodes) {
        const auto* own = node.as<ItemId>();
        if (const auto* definition = node.as<DefinitionId>()) {
            places.push_back(definitions_.at(*definition));
        } else if (const auto* rate = node.as<Rate>()) {
            places.push_back(rates_.at(rate->species));
        } else if (own != nullptr && items_.contains(*own)) {
            places.push_back(items_.at(*own));
        } else {
            for (NodeId& operand : node.reads()) operand = places[operand];
            const Written written{number, places.next()};
            places.push_back(vectors_ ? vectors_->add(node, written) : graph_.add(node, written));
        }
    }
    return places.back();
}

void Flattening::add_rates(const System& system) {
    const auto definition_count = static_cast<std::uint32_t>(system.definitions.size());
    for (const std::uint32_t value : topological_order(step_dependencies(system)).order) {
        if (value < definition_count) {
            const DefinitionId id(value);
            const auto& [name, span, formula] = system.definitions[id];
            definitions_[id] = add(formula, {name, true});
            names_.emplace_back(definitions_[id], name);
        } else if (const ItemId item(value - definition_count); system.is_species(item)) {
            const std::string name = system.quantities[item].name + "'";
            rates_[item] = add(system.rates[item], {name, true});
            names_.emplace_back(rates_[item], name);
        }
    }
}

std::vector<std::pair<NodeId, std::string>> Flattening::names() const {
    static constexpr std::array<const char*, 3> ends{".x", ".y", ".z"};
    auto names = names_;
    if (!vectors_) return names;
    for (const auto& [id, name] : names_) {
        const auto* const parts = vectors_->known_components(id);
        if (parts == nullptr) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const NodeId part = (*parts)[k].term;
            if (!graph_.is_number(part)) names.emplace_back(part, name + ends[k]);
        }
    }
    return names;
}

}  // namespace cascade

// Finds the values that each value of a system reads.
#include "lang/program/dependencies.h"

namespace cascade {

namespace {

std::vector<std::uint32_t> reads_of(const System& system, const Formula& formula) {
    std::vector<std::uint32_t> reads;
    const auto definition_count = static_cast<std::uint32_t>(system.definitions.size());
    for (const Node& node : formula.nodes) {
        if (const auto* id = node.as<DefinitionId>()) reads.push_back(id->index());
        if (const auto* rate = node.as<Rate>()) {
            reads.push_back(definition_count + rate->species.index());
        }
    }
    return reads;
}

}  // namespace

Dependencies step_dependencies(const System& system) {
    Dependencies reads;
    for (const Definition& definition : system.definitions) {
        reads.push_back(reads_of(system, definition.formula));
    }
    for (const Formula& rate : system.rates) reads.push_back(reads_of(system, rate));
    return reads;
}

Dependencies item_dependencies(const std::vector<const Formula*>& items) {
    Dependencies reads(items.size());
    for (std::size_t item = 0; item < items.size(); ++item) {
        if (items[item] == nullptr) continue;
        for (const Node& node : items[item]->nodes) {
            const auto* own = node.as<ItemId>();
            if (own == nullptr) continue;
            const std::uint32_t count = node.type == ValueType::vector ? 3 : 1;
            for (std::uint32_t k = 0; k < count; ++k) reads[item].push_back(own->index() + k);
        }
    }
    return reads;
}

IdVector<ItemId, bool> items_of_aggregates(const Stage& stage) {
    IdVector<ItemId, bool> late(stage.items.size(), false);
    for (const ItemId item : stage.order) {
        for (const Node& node : stage.items[item].nodes) {
            const auto* own = node.as<ItemId>();
            const bool reads_one = own != nullptr && late[*own];
            if (is_aggregate(node) || reads_one) late[item] = true;
        }
    }
    return late;
}

}  // namespace cascade

// Finds which values read which.
#include "lang/program/dependencies.h"

namespace cascade {

namespace {

void add_reads(const System& system, const Formula& formula, std::vector<std::uint32_t>& reads) {
    const auto definition_count = static_cast<std::uint32_t>(system.definitions.size());
    for (const Node& node : formula.nodes) {
        if (node.kind == NodeKind::definition) reads.push_back(node.index);
        if (node.kind == NodeKind::rate) reads.push_back(definition_count + node.index);
    }
}

}  // namespace

Dependencies step_dependencies(const System& system) {
    Dependencies reads(system.definitions.size() + system.rates.size());
    for (std::size_t i = 0; i < system.definitions.size(); ++i) {
        add_reads(system, system.definitions[i].formula, reads[i]);
    }
    for (std::size_t i = 0; i < system.rates.size(); ++i) {
        add_reads(system, system.rates[i], reads[system.definitions.size() + i]);
    }
    return reads;
}

Dependencies item_dependencies(const std::vector<const Formula*>& items) {
    Dependencies reads(items.size());
    for (std::size_t item = 0; item < items.size(); ++item) {
        if (items[item] == nullptr) continue;
        for (const Node& node : items[item]->nodes) {
            if (node.kind == NodeKind::own) reads[item].push_back(node.index);
        }
    }
    return reads;
}

}  // namespace cascade

// Puts formulas into one graph; definitions and rates are replaced by their expressions.
#pragma once

#include "lang/program/expression_graph.h"

#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace cascade {

/// The source of a formula's random numbers.
struct Noise {
    std::string origin;       ///< The name of the item or definition, or of a species with a prime.
    bool every_step = false;  ///< New numbers in each step.
    std::string owner = {};   ///< To whom the numbers belong; empty: the stage.
};

/// A formula that was put into a graph (Written::formula).
struct Origin {
    const Formula* formula = nullptr;
    Noise noise;
};

/// Writes formulas into a graph one after another.
class Flattening {
public:
    explicit Flattening(ExpressionGraph& graph) : graph_(graph) {}

    /// Adds a formula and returns the node of its value. Definitions, rates and items of the stage
    /// that it reads become the nodes known for them; items without a known node stay items.
    NodeId add(const Formula& formula, Noise noise = {});
    /// Adds a system's definitions and rates, each after those that it reads.
    void add_rates(const System& system);
    void set_item(ItemId item, NodeId value) { items_[item] = value; }

    NodeId rate(ItemId species) const { return rates_.at(species); }
    NodeId definition(DefinitionId id) const { return definitions_.at(id); }
    const std::vector<Origin>& origins() const { return origins_; }
    /// The names of definitions and rates, by node.
    const std::vector<std::pair<NodeId, std::string>>& names() const { return names_; }

private:
    ExpressionGraph& graph_;
    std::vector<Origin> origins_;
    std::unordered_map<ItemId, NodeId> items_, rates_;
    std::unordered_map<DefinitionId, NodeId> definitions_;
    std::vector<std::pair<NodeId, std::string>> names_;
};

}  // namespace cascade

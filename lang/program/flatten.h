// Formulas in one graph: definitions and rates are replaced by what they stand for.
#pragma once

#include "lang/program/expression_graph.h"

#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace cascade {

/// Where the random numbers of a formula come from.
struct Noise {
    std::string origin;       ///< The item's or definition's name, or a species' with a prime.
    bool every_step = false;  ///< New numbers in each step.
    std::string owner = {};   ///< Whose numbers they are; empty: the stage's.
};

/// A formula that a graph was made of (Written::formula).
struct Origin {
    const Formula* formula = nullptr;
    Noise noise;
};

/// Writes formulas into a graph, one after another.
class Flattening {
public:
    explicit Flattening(ExpressionGraph& graph) : graph_(graph) {}

    /// Adds a formula and returns the node that is its value. What it reads of definitions, rates
    /// and items of the stage is taken from the nodes known for them; items without one stay.
    NodeId add(const Formula& formula, Noise noise = {});
    /// Adds a system's definitions and rates, each after those that it reads.
    void add_rates(const System& system);
    void set_item(std::uint32_t item, NodeId value) { items_[item] = value; }

    NodeId rate(std::uint32_t item) const { return rates_.at(item); }
    const std::vector<Origin>& origins() const { return origins_; }
    /// What a user calls the values of definitions and rates.
    const std::vector<std::pair<NodeId, std::string>>& names() const { return names_; }

private:
    ExpressionGraph& graph_;
    std::vector<Origin> origins_;
    std::unordered_map<std::uint32_t, NodeId> items_, definitions_, rates_;
    std::vector<std::pair<NodeId, std::string>> names_;
};

}  // namespace cascade

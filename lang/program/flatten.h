// Puts formulas into one graph. The expressions of definitions and rates take the place of the
// nodes that read them.
#pragma once

#include "lang/program/field_vectors.h"

#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace cascade {

/// How the random numbers of a formula are drawn.
struct Noise {
    /// The name of the item or definition that has the formula. For a rate, the name of the species
    /// followed by a prime.
    std::string origin;
    bool every_step = false;  ///< Whether each step draws new numbers.
    /// If not empty, random numbers depend on this name in place of the stage's name.
    std::string owner = {};
};

/// A formula that was put into a graph. Written::formula is the index of its Origin.
struct Origin {
    const Formula* formula = nullptr;
    Noise noise;
};

/// Writes formulas into a graph, one after another.
class Flattening {
public:
    /// If `space` is given, vectors are rewritten when they are added
    /// (lang/program/field_vectors.h).
    explicit Flattening(ExpressionGraph& graph, const std::optional<FieldSpace>& space = {})
        : graph_(graph) {
        if (space) vectors_.emplace(graph, *space);
    }

    /// Adds a formula and returns the node of its value. Each definition, rate and item of the
    /// stage that the formula reads is replaced by the node that was set for it. Items for which no
    /// node was set stay as nodes.
    NodeId add(const Formula& formula, Noise noise = {});
    /// Adds a system's definitions and rates, each after the definitions and rates that it reads.
    void add_rates(const System& system);
    void set_item(ItemId item, NodeId value) { items_[item] = value; }

    NodeId rate(ItemId species) const { return rates_.at(species); }
    NodeId definition(DefinitionId id) const { return definitions_.at(id); }
    const std::vector<Origin>& origins() const { return origins_; }
    /// The nodes of definitions and rates, with their names. Components of a vector J have names
    /// such as J.x.
    std::vector<std::pair<NodeId, std::string>> names() const;

private:
    ExpressionGraph& graph_;
    std::optional<FieldVectors> vectors_;
    std::vector<Origin> origins_;
    std::unordered_map<ItemId, NodeId> items_, rates_;
    std::unordered_map<DefinitionId, NodeId> definitions_;
    std::vector<std::pair<NodeId, std::string>> names_;
};

}  // namespace cascade

// Puts formulas into one graph; definitions and rates are replaced by their expressions.
#pragma once

#include "lang/program/field_vectors.h"

#include <optional>
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
    /// With a space, vectors are written out (lang/program/field_vectors.h).
    explicit Flattening(ExpressionGraph& graph, const std::optional<FieldSpace>& space = {})
        : graph_(graph) {
        if (space) vectors_.emplace(graph, *space);
    }

    /// Adds a formula and returns the node of its value. Definitions, rates and items of the stage
    /// that it reads become the nodes known for them; items without a known node stay items.
    NodeId add(const Formula& formula, Noise noise = {});
    /// Adds a system's definitions and rates, each after those that it reads.
    void add_rates(const System& system);
    void set_item(ItemId item, NodeId value) { items_[item] = value; }

    NodeId rate(ItemId species) const { return rates_.at(species); }
    NodeId definition(DefinitionId id) const { return definitions_.at(id); }
    const std::vector<Origin>& origins() const { return origins_; }
    /// The names of definitions and rates, by node; J.x of the components of a vector J.
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

// Computes expressions of a stage in all cells at once, with exact derivatives.
//
// They are the expressions from which kernels are lowered, after all graph passes. Numbers are
// computed in double precision. Each function of numbers passes derivatives on by the rules of
// calculus, and each operator by the sparse matrix of its differences.
#pragma once

#include "continuation/differences.h"
#include "continuation/part.h"
#include "core/result.h"
#include "lang/calculus/algebra.h"
#include "lang/lower/crossings.h"
#include "lang/lower/plan_graph.h"

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cascade::continuation {

/// Returns the values of a formula that depends on no unknown: one for each cell of the grid, or a
/// single one if all are equal.
using ConstantValues = std::function<std::vector<double>(const Formula& formula)>;

/// The parts of the items that change, which are the species and the parameter. The values of a
/// species include the halo.
using ItemParts = std::map<ItemId, Part>;

class FieldExpressions {
public:
    /// `changing` are the items that change. If an expression cannot be computed here, fails with
    /// the reason, worded to continue a sentence that begins with the stage.
    static Result<FieldExpressions> create(lowering::Expressions expressions,
                                           const lowering::PassContext& context,
                                           const PaddedGrid& grid, std::span<const ItemId> changing,
                                           const ConstantValues& constants);

    /// Computes one operator from the parts of its operands.
    using OperatorRule = Part (FieldExpressions::*)(const Node& node, const Boundaries& beyond);
    /// The rule of an operator. Null for plain differences, divergences, means and other functions.
    static OperatorRule rule_of(Function function);

    /// Whether no value that is constant during the continuation varies along an axis, up to the
    /// accuracy of a metric. If so, the expressions treat all cells along this axis alike.
    bool is_same_along(int axis) const;
    /// Whether any value that is constant during the continuation differs from cell to cell, apart
    /// from the areas of cells.
    bool has_places() const { return has_places_; }
    std::size_t root_count() const { return plan_->roots().size(); }
    Differences& differences() { return *differences_; }
    /// The parts of the roots. If `with_slopes` is false, no part has slopes.
    std::vector<Part> roots(const ItemParts& items, bool with_slopes);

private:
    FieldExpressions(lowering::Expressions expressions, const lowering::PassContext& context,
                     const PaddedGrid& grid);

    Result<void> prepare(std::span<const ItemId> changing, const ConstantValues& constants);
    Result<void> prepare_node(NodeId id, std::span<const ItemId> changing,
                              const ConstantValues& constants);
    Result<void> prepare_leaf(NodeId id, const ConstantValues& constants);
    Result<void> prepare_call(NodeId id);
    std::string name_of(NodeId id) const;

    bool is_number_in_cell(NodeId id) const;
    void compute(NodeId id, const ItemParts& items, bool with_slopes);
    Values folded(const Node& node) const;
    SparseRows chained(NodeId id) const;
    Part operated(NodeId id);
    Part over_links(const Node& node);
    Part read(const Reads& reads, NodeId operand) const;
    Part beside(const Node& node, const Boundaries& beyond);
    Part squared_gradient(const Node& node, const Boundaries& beyond);
    Part advection(const Node& node, const Boundaries& beyond);
    Part diffusion(const Node& node, const Boundaries& beyond);
    Part upwind(const Node& node, const Boundaries& beyond);
    Part limited(const Node& node, const Boundaries& beyond);
    Part flow(NodeId velocity, NodeId operand, int axis, const Boundaries& beyond);
    Part aggregated(const Node& node);
    Part difference(NodeId operand, Difference kind, int first, int second,
                    const Boundaries& beyond);

    struct AtFace;
    Part divergence(NodeId id);
    Part through_sides(NodeId flux, int axis, Part at_faces);

    std::shared_ptr<lowering::PlanGraph> plan_;
    const PaddedGrid* grid_;
    std::shared_ptr<Differences> differences_;
    IdVector<NodeId, lowering::Crossing> crossings_;
    Algebra algebra_;            ///< The nodes of the plan, then their derivatives.
    std::vector<NodeId> order_;  ///< The nodes whose values change, operands first.
    IdVector<NodeId, bool> changes_;
    bool has_places_ = false;
    /// The derivatives of each function of numbers with respect to its operands.
    IdVector<NodeId, std::array<std::optional<NodeId>, most_operands>> slope_nodes_;
    IdVector<NodeId, Part> parts_;
};

}  // namespace cascade::continuation

// Prepares the nodes, and computes functions of numbers and the chain rule.
#include "continuation/field_expressions.h"

#include "core/check.h"
#include "lang/calculus/derivative_rules.h"
#include "lang/program/fold.h"
#include "lang/program/vector_functions.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade::continuation {

namespace {

/// Whether an operator of numbers can be computed here. Vectors are computed where `div` reads
/// them.
bool is_known_operator(const Node& node) {
    const bool is_sum_of_cells = is_aggregate(node) && is_linear_in(node.function, 0, 1);
    return is_sum_of_cells || node.calls(Function::div) || node.calls(Function::bordered) ||
           difference_of(node.function) || FieldExpressions::rule_of(node.function) != nullptr;
}

/// Whether the values of a call are read only once, before any item changes.
bool is_constant_call(const Node& node) {
    const FunctionKind kind = info(node.function).kind;
    return kind == FunctionKind::shape || kind == FunctionKind::text;
}

}  // namespace

FieldExpressions::FieldExpressions(lowering::Expressions expressions,
                                   const lowering::PassContext& context, const PaddedGrid& grid)
    : plan_(std::make_shared<lowering::PlanGraph>(std::move(expressions), context)),
      grid_(&grid),
      differences_(std::make_shared<Differences>(grid)),
      crossings_(lowering::crossings_of(*plan_)) {}

Result<FieldExpressions> FieldExpressions::create(lowering::Expressions expressions,
                                                  const lowering::PassContext& context,
                                                  const PaddedGrid& grid,
                                                  std::span<const ItemId> changing,
                                                  const ConstantValues& constants) {
    FieldExpressions result(std::move(expressions), context, grid);
    if (auto done = result.prepare(changing, constants); !done) {
        return tl::unexpected(done.error());
    }
    return result;
}

std::string FieldExpressions::name_of(NodeId id) const {
    const Node& node = (*plan_)[id];
    if (!node.is<Call>()) return "a value";
    return fmt::format("'{}'", info(node.function).spelling);
}

bool FieldExpressions::is_number_in_cell(NodeId id) const {
    const Node& node = algebra_[id];
    return node.type == ValueType::number && !node.is<TextId>();
}

Result<void> FieldExpressions::prepare(std::span<const ItemId> changing,
                                       const ConstantValues& constants) {
    const lowering::PlanGraph& plan = *plan_;
    const auto needed = needed_by(plan.expressions().graph, plan.roots());
    for (const NodeId id : plan.ids()) {
        const Node& node = plan[id];
        if (needed[id] && (is_draw(node) || node.is(Builtin::t) || node.is(Builtin::step))) {
            return is_draw(node) ? failure("random numbers in its rates leave no state steady")
                                 : failure("its rates depend on time, so that no state is steady");
        }
        // Nodes that are not needed keep their ids, but lose their content.
        const NodeId copy = algebra_.add(needed[id] ? node : Node{.kind = TextId(id.index())});
        CHECK(copy == id, "the nodes of a graph differ");
    }
    parts_.resize(plan.size());
    slope_nodes_.resize(plan.size());
    for (const NodeId id : plan.ids()) {
        changes_.push_back(false);
        if (!needed[id]) continue;
        if (auto done = prepare_node(id, changing, constants); !done) return done;
    }
    for (std::size_t k = plan.size(); k < algebra_.size(); ++k) {
        const NodeId id(k);
        const auto reads = algebra_[id].reads();
        changes_.push_back(std::ranges::any_of(reads, [&](NodeId read) { return changes_[read]; }));
        parts_.emplace_back();
        if (changes_[id]) {
            order_.push_back(id);
        } else {
            compute(id, {}, false);
        }
    }
    return {};
}

Result<void> FieldExpressions::prepare_node(NodeId id, std::span<const ItemId> changing,
                                            const ConstantValues& constants) {
    const Node& node = (*plan_)[id];
    const auto* item = node.as<ItemId>();
    changes_[id] = (item != nullptr && std::ranges::find(changing, *item) != changing.end()) ||
                   std::ranges::any_of(node.reads(), [&](NodeId read) { return changes_[read]; });
    const bool is_leaf = !node.is<Call>() || is_constant_call(node);
    if (is_leaf && !changes_[id]) return prepare_leaf(id, constants);
    if (node.is<Call>()) {
        if (auto done = prepare_call(id); !done) return done;
    }
    if (!is_number_in_cell(id)) return {};
    if (changes_[id]) {
        order_.push_back(id);
    } else {
        compute(id, {}, false);
    }
    return {};
}

/// Reads the values of a leaf that does not change, and copies them to the halo.
Result<void> FieldExpressions::prepare_leaf(NodeId id, const ConstantValues& constants) {
    const lowering::PlanGraph& plan = *plan_;
    const Node& node = plan[id];
    if (node.is<TextId>()) return {};
    if (const auto* number = node.as<double>()) {
        parts_[id].values = Values::Constant(1, *number);
        return {};
    }
    if (node.is<InsideMask>()) {
        parts_[id].values = Values::Zero(grid_->size());
        for (Index k = 0; k < grid_->size(); ++k) {
            if (grid_->is_inside(k)) parts_[id].values[k] = 1;
        }
        return {};
    }
    const bool is_known = node.is<ItemId>() || node.is<StageItem>() || node.is<Builtin>() ||
                          node.is<Call>() || node.is<MetricPlane>() || node.is<ModelPlane>() ||
                          node.is<SurfaceValueId>();
    if (!is_known) return failure("its rates read values that only a run has");
    if (plan.is_open(id)) {
        return failure("its rates read an earlier stage beyond sides that have values");
    }
    const std::vector<double> values = constants(formula_of(plan.expressions().graph.nodes(), id));
    if (plan.is_uniform(id) || values.size() == 1) {
        parts_[id].values = Values::Constant(1, values.front());
        return {};
    }
    has_places_ = has_places_ || !node.is(ModelPlane::area);
    Values padded = Values::Zero(grid_->size());
    for (std::size_t k = 0; k < values.size(); ++k) {
        const Index cell = grid_->positions()[k];
        if (grid_->is_inside(cell)) padded[cell] = values[k];
    }
    const std::vector<Index> sources = grid_->sources(plan.boundary(id));
    parts_[id].values = padded(sources);
    return {};
}

Result<void> FieldExpressions::prepare_call(NodeId id) {
    const Node node = (*plan_)[id];
    if (node.type == ValueType::tensor || node.type == ValueType::vector) {
        const bool is_tensor = node.type == ValueType::tensor;
        if (is_tensor ? node.calls(Function::tensor) : makes_flux(node.function)) return {};
        return failure(fmt::format("its rates use {}, which is not supported here", name_of(id)));
    }
    if (is_constant_call(node)) {
        return failure(fmt::format("{} in its rates changes with the state", name_of(id)));
    }
    if (is_known_operator(node)) return {};
    if (!is_elementary(node.function)) {
        return failure(fmt::format("its rates use {}, which is not supported here", name_of(id)));
    }
    if (!changes_[id]) return {};
    for (std::size_t n = 0; n < node.operand_count; ++n) {
        if (!changes_[node.operands[n]]) continue;
        slope_nodes_[id][n] = partial_derivative(algebra_, node, n);
        if (!slope_nodes_[id][n]) {
            return failure(fmt::format("{} in its rates has no derivative", name_of(id)));
        }
    }
    return {};
}

Values FieldExpressions::folded(const Node& node) const {
    Index size = 1;
    for (const NodeId read : node.reads()) size = std::max(size, parts_[read].values.size());
    std::array<Values, most_operands> spreads;
    OperandColumns columns;
    Values result(size);
    columns.fill(result.data());
    for (std::size_t n = 0; n < node.operand_count; ++n) {
        const Values& values = parts_[node.operands[n]].values;
        columns[n] = values.data();
        if (values.size() == size) continue;
        spreads[n] = spread(values, size);
        columns[n] = spreads[n].data();
    }
    const bool is_done =
        fold(node.function, columns, {result.data(), static_cast<std::size_t>(size)});
    CHECK(is_done, "functions of numbers can be computed");
    return result;
}

void FieldExpressions::compute(NodeId id, const ItemParts& items, bool with_slopes) {
    const Node& node = algebra_[id];
    Part& part = parts_[id];
    if (const auto* number = node.as<double>()) {
        part.values = Values::Constant(1, *number);
    } else if (const auto* item = node.as<ItemId>()) {
        const Part& known = items.at(*item);
        part.values = known.values;
        if (with_slopes) part.slopes = known.slopes;
    } else if (is_elementary(node.function)) {
        if (!with_slopes) part.values = folded(node);
        if (with_slopes) part.slopes = chained(id);
    } else {
        part = operated(id);
    }
}

/// The slopes of a function of numbers, by the chain rule.
SparseRows FieldExpressions::chained(NodeId id) const {
    const Node& node = algebra_[id];
    SparseRows sum;
    for (std::size_t n = 0; n < node.operand_count; ++n) {
        const auto& slope = slope_nodes_[id][n];
        if (!slope) continue;
        const Part& factor = parts_[*slope];
        const bool is_nothing = factor.is_uniform() && factor.values[0] == 0;
        if (is_nothing || parts_[node.operands[n]].is_constant()) continue;
        add_rows(sum, scaled(factor.values, parts_[node.operands[n]].slopes));
    }
    const Index size = parts_[id].values.size();
    if (sum.rows() > 0 && sum.rows() < size) sum = scaled(Values::Ones(size), sum);
    return sum;
}

bool FieldExpressions::is_same_along(int axis) const {
    const Index step = grid_->shift(Offset::along(axis, 1));
    const auto is_same = [&](const Values& values) {
        const double least = 1e-7 * values.abs().maxCoeff() + 1e-9;
        return std::ranges::all_of(grid_->cells(), [&](Index cell) {
            const bool is_last = grid_->position(cell, axis) + 1 == grid_->length(axis);
            return is_last || std::abs(values[cell + step] - values[cell]) <= least;
        });
    };
    return std::ranges::all_of(parts_.ids(), [&](NodeId id) {
        return changes_[id] || parts_[id].is_uniform() || is_same(parts_[id].values);
    });
}

std::vector<Part> FieldExpressions::roots(const ItemParts& items, bool with_slopes) {
    for (const NodeId id : order_) {
        parts_[id].slopes.resize(0, 0);
        compute(id, items, false);
    }
    if (with_slopes) {
        for (const NodeId id : order_) {
            if (id.index() < plan_->size()) compute(id, items, true);
        }
    }
    std::vector<Part> roots;
    for (const NodeId root : plan_->roots()) roots.push_back(parts_[root]);
    return roots;
}

}  // namespace cascade::continuation

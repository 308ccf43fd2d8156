// Operators of derivatives, fluxes and means over the domain.
#include "continuation/field_expressions.h"
#include "core/check.h"
#include "lang/program/vector_functions.h"

#include <span>
#include <utility>

namespace cascade::continuation {

namespace {

/// Takes the rows of `first` where `is_first` is 1, and the rows of `second` where it is 0.
Part chosen(const Values& is_first, const Part& first, const Part& second) {
    Part a = product(Part{is_first, {}}, first);
    return sum(a, product(Part{1 - is_first, {}}, second));
}

}  // namespace

Part FieldExpressions::difference(NodeId operand, Difference kind, int first, int second,
                                  const Boundaries& beyond) {
    if (parts_[operand].is_uniform()) return {};
    return read(differences_->in_cells(kind, first, second, beyond), operand);
}

/// Applies a difference to an operand. The operand's values beyond the border of a mask may come
/// from other nodes.
Part FieldExpressions::read(const Reads& reads, NodeId operand) const {
    const Node& node = algebra_[operand];
    if (!node.calls(Function::bordered)) return applied(reads.all, parts_[operand]);
    const auto all = [&](NodeId id) {
        const Part& part = parts_[id];
        return part.is_uniform() ? product(Part{Values::Ones(grid_->size()), {}}, part) : part;
    };
    return sum(applied(reads.inside, all(node.operands[0])),
               sum(applied(reads.once, all(node.operands[1])),
                   applied(reads.twice, all(node.operands[2]))));
}

/// Applies the rules of lang/lower/lower_operators.cpp, but expands sums of products over links: Σ
/// w (a_i + a_j) (e_j − e_i) = a L(e) + L(a e) − e L(a), where L is the Laplacian.
Part FieldExpressions::over_links(const Node& node) {
    const Part& of = parts_[node.reads().back()];
    if (of.is_uniform()) return {};
    if (const Derivative derivative = derivative_of(node.function); derivative.order == 1) {
        return applied(differences_->gradient_over_links(derivative.first), of);
    }
    const SparseRows& links = differences_->over_links();
    const Part change = applied(links, of);
    if (node.calls(Function::grad2)) {
        const Part squares = applied(links, product(of, of));
        return scaled(sum(squares, scaled(product(of, change), -2)), 0.5);
    }
    if (node.operand_count == 1) return change;
    const Part& weight = parts_[node.operands[0]];
    if (weight.is_uniform()) return product(weight, change);
    const Part flow = sum(product(weight, change), applied(links, product(weight, of)));
    return scaled(sum(flow, scaled(product(of, applied(links, weight)), -1)), 0.5);
}

Part FieldExpressions::operated(NodeId id) {
    const Node& node = (*plan_)[id];
    if (is_aggregate(node)) return aggregated(node);
    if (node.calls(Function::bordered)) return parts_[node.operands[0]];
    if (grid_->links() != nullptr && is_stencil(node.function)) return over_links(node);
    if (node.calls(Function::div)) return divergence(id);
    const Boundaries beyond = plan_->boundary(id);
    const NodeId operand = node.reads().back();
    if (const auto own = difference_of(node.function)) {
        return difference(operand, own->difference, own->first, own->second, beyond);
    }
    const OperatorRule rule = rule_of(node.function);
    CHECK(rule != nullptr, "operators have been checked");
    return (this->*rule)(node, beyond);
}

FieldExpressions::OperatorRule FieldExpressions::rule_of(Function function) {
    static constexpr std::pair<Function, OperatorRule> rules[] = {
        {Function::beside, &FieldExpressions::beside},
        {Function::grad2, &FieldExpressions::squared_gradient},
        {Function::advect, &FieldExpressions::advection},
        {Function::diffuse, &FieldExpressions::diffusion},
        {Function::upwind, &FieldExpressions::upwind},
        {Function::limited, &FieldExpressions::limited},
    };
    for (const auto& [of, rule] : rules) {
        if (of == function) return rule;
    }
    return nullptr;
}

Part FieldExpressions::beside(const Node& node, const Boundaries& beyond) {
    const Part& of = parts_[node.operands[0]];
    if (of.is_uniform()) return of;
    return read(differences_->beside(Offset::of(node.as<Call>()->detail), beyond),
                node.operands[0]);
}

Part FieldExpressions::squared_gradient(const Node& node, const Boundaries& beyond) {
    Part squares;
    for (const int axis : grid_->axes().present) {
        const Part along = difference(node.operands[0], Difference::central, axis, 0, beyond);
        squares = sum(squares, product(along, along));
    }
    return squares;
}

Part FieldExpressions::advection(const Node& node, const Boundaries& beyond) {
    Part all;
    for (const int axis : grid_->axes().present) {
        if (axis + 1 >= node.operand_count) continue;
        const NodeId velocity = node.operands[static_cast<std::size_t>(axis)];
        all = sum(all, flow(velocity, node.reads().back(), axis, beyond));
    }
    return all;
}

/// Adds up second derivatives times the entries of a tensor, which is the first operand.
Part FieldExpressions::diffusion(const Node& node, const Boundaries& beyond) {
    const Node& tensor = (*plan_)[node.operands[0]];
    const auto term = [&](std::size_t entry, Difference kind, int first, int second) {
        return product(parts_[tensor.operands[entry]],
                       difference(node.reads().back(), kind, first, second, beyond));
    };
    return sum(sum(term(0, Difference::second, 0, 0), term(2, Difference::second, 1, 0)),
               scaled(term(1, Difference::mixed, 0, 1), 2));
}

Part FieldExpressions::upwind(const Node& node, const Boundaries& beyond) {
    return flow(node.operands[0], node.reads().back(), static_cast<int>(node.as<Call>()->detail),
                beyond);
}

/// Computes v · (v > 0 ? c − W : E − c) / h, where c is the value of a cell, and W and E are the
/// values of the cells before and after it.
Part FieldExpressions::flow(NodeId velocity, NodeId operand, int axis, const Boundaries& beyond) {
    const Part& v = parts_[velocity];
    const Values is_forwards = (v.values > 0).cast<double>();
    const Part backward = difference(operand, Difference::backward, axis, 0, beyond);
    const Part forward = difference(operand, Difference::forward, axis, 0, beyond);
    return product(v, chosen(is_forwards, backward, forward));
}

/// Van Leer's limiter, as in lang/lower/lower_operators.cpp.
Part FieldExpressions::limited(const Node& node, const Boundaries& beyond) {
    const NodeId operand = node.reads().back();
    const auto axis = static_cast<int>(node.as<Call>()->detail);
    const Part a =
        scaled(difference(operand, Difference::forward, axis, 0, beyond), grid_->spacing());
    const Part b =
        scaled(difference(operand, Difference::backward, axis, 0, beyond), grid_->spacing());
    const Values is_monotone = (a.values * b.values > 0).cast<double>();
    // Where the slope is 0, any divisor but 0 will do.
    const Part divisor = chosen(is_monotone, sum(a, b), Part{Values::Ones(1), {}});
    const Part mean = scaled(quotient(product(a, b), divisor), 2);
    return product(Part{is_monotone, {}}, mean);
}

Part FieldExpressions::aggregated(const Node& node) {
    const Part& of = parts_[node.operands[0]];
    const bool is_mean = node.calls(Function::domain_mean);
    const auto count = static_cast<double>(grid_->cell_count());
    const double factor = is_mean ? 1 / count : 1;
    if (of.is_uniform()) return scaled(of, is_mean ? 1 : count);
    std::vector<Eigen::Triplet<double>> entries;
    for (const Index cell : grid_->cells()) entries.emplace_back(0, cell, factor);
    SparseRows row(1, grid_->size());
    row.setFromTriplets(entries.begin(), entries.end());
    return applied(row, of);
}

/// Computes a component of a vector at all faces along an axis.
struct FieldExpressions::AtFace {
    FieldExpressions& own;
    int axis = 0, component = 0;

    Part flow(NodeId vector) const { return vector_by(*this, *own.plan_, (*own.plan_)[vector]); }
    Part average(NodeId number) const {
        const Part& part = own.parts_[number];
        if (part.is_uniform()) return part;
        return own.read(own.differences_->at_faces(Difference::average, axis), number);
    }

    Part gradient(NodeId of) const {
        const Part& part = own.parts_[of];
        if (part.is_uniform() || !own.grid_->axes().has(component)) return {};
        return own.read(component == axis ? own.differences_->at_faces(Difference::across, axis)
                                          : own.differences_->along_faces(axis, component),
                        of);
    }
    Part components(std::span<const NodeId> parts) const {
        const auto k = static_cast<std::size_t>(component);
        return k < parts.size() ? average(parts[k]) : Part{};
    }
    Part negative(NodeId vector) const { return scaled(flow(vector), -1); }
    Part sum(NodeId a, NodeId b) const { return continuation::sum(flow(a), flow(b)); }
    Part difference(NodeId a, NodeId b) const {
        return continuation::sum(flow(a), scaled(flow(b), -1));
    }
    Part quotient(NodeId vector, NodeId by) const {
        const Part divisor = average(by);
        if (divisor.is_uniform()) return continuation::quotient(flow(vector), divisor);
        // Rows that belong to no face are 0. There, the divisor is set to 1.
        const Values nowhere = (divisor.values == 0).cast<double>();
        return continuation::quotient(flow(vector), continuation::sum(divisor, Part{nowhere, {}}));
    }
    Part product(NodeId a, NodeId b, bool is_vector_first) const {
        return is_vector_first ? continuation::product(flow(a), average(b))
                               : continuation::product(average(a), flow(b));
    }
    Part turned(NodeId tensor, NodeId vector) const {
        const Node& entries = (*own.plan_)[tensor];
        const int size = lowering::tensor_size(entries);
        Part all;
        for (int column = 0; component < size && column < size; ++column) {
            const std::size_t entry = lowering::tensor_entry(size, component, column);
            const AtFace aside{own, axis, column};
            all = continuation::sum(all, continuation::product(average(entries.operands[entry]),
                                                               aside.flow(vector)));
        }
        return all;
    }
};

Part FieldExpressions::through_sides(NodeId flux, int axis, Part at_faces) {
    const lowering::Crossing& crossing = crossings_[flux];
    if (!crossing.goes_across || at_faces.is_uniform()) return at_faces;
    if (grid_->has_outside() && !crossing.is_open[static_cast<std::size_t>(Side::border)]) {
        at_faces = product(at_faces, Part{differences_->within_border(axis), {}});
    }
    for (const int side : {2 * axis, 2 * axis + 1}) {
        const auto k = static_cast<std::size_t>(side);
        const SideKind usual = SideRules(plan_->grid().boundary).at[k].kind;
        const bool is_open =
            crossing.has_species ? crossing.is_open[k] : usual == SideKind::periodic;
        if (is_open) continue;
        at_faces = product(at_faces, Part{1 - differences_->on_side(side), {}});
    }
    return at_faces;
}

Part FieldExpressions::divergence(NodeId id) {
    const NodeId flux = (*plan_)[id].operands[0];
    const Boundaries beyond = plan_->boundary(id);
    Part all;
    for (const int axis : grid_->axes().present) {
        Part at_faces = AtFace{*this, axis, axis}.flow(flux);
        if (at_faces.is_uniform()) {
            at_faces = product(Part{Values::Ones(grid_->size()), {}}, at_faces);
        }
        at_faces = through_sides(flux, axis, std::move(at_faces));
        all = sum(all, applied(differences_->between_faces(axis, beyond), at_faces));
    }
    return all;
}

}  // namespace cascade::continuation

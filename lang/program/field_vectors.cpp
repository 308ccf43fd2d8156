// Rewrites vectors, by one rule for each kind of vector. The components of a vector are made when
// they are first needed.
#include "lang/program/field_vectors.h"

#include "lang/program/vector_functions.h"
#include "lang/vocabulary/function_groups.h"

#include <array>
#include <span>
#include <vector>

namespace cascade {

namespace {

constexpr std::array right_planes{ModelPlane::right_x, ModelPlane::right_y, ModelPlane::right_z};
constexpr std::array down_planes{ModelPlane::down_x, ModelPlane::down_y, ModelPlane::down_z};

}  // namespace

TensorEntries tensor_entries(ExpressionGraph& graph, NodeId a1, NodeId a2, NodeId theta) {
    const Term first{&graph, a1}, second{&graph, a2}, angle{&graph, theta};
    const Term along = square(first), across = square(second);
    const Term cosine = cos(angle), sine = sin(angle);
    const Term cosine2 = square(cosine), sine2 = square(sine);
    const Term along_x = along * cosine2, a11 = along_x + across * sine2;
    const Term along_y = along * sine2, a22 = along_y + across * cosine2;
    const Term mixed = sine * cosine;
    return {a11, (along - across) * mixed, a22};
}

ModelTensor model_tensor(ExpressionGraph& graph, NodeId tensor) {
    // The least part of the diffusion that is computed over links, relative to the mean of a1² and
    // a2². This part is large enough to damp the shortest waves along a direction in which nothing
    // spreads.
    constexpr double least_part = 1.0 / 32;
    const auto leaf = [&](const NodeKind& kind) { return Term{&graph, graph.leaf(kind)}; };
    const auto operand = [&](std::size_t n) { return Term{&graph, graph[tensor].operands[n]}; };
    const Term first = square(operand(0)), second = square(operand(1)), theta = operand(2);
    const Term half = leaf(0.5);
    const Term mean = half * (first + second), written = half * (first - second);
    const Term most = leaf(ModelPlane::evenness) * mean, least = -most;
    const Term apart = max(least, min(written, most));
    const Term share = leaf(1 - 2 * least_part), below = share * abs(apart);
    ModelTensor result;
    result.low = mean - below;
    result.rest = below - apart;
    result.along = leaf(2.0) * apart;
    const Term cosine = cos(theta), sine = sin(theta);
    for (std::size_t k = 0; k < 3; ++k) {
        const Term right = cosine * leaf(right_planes[k]);
        result.t[k] = right + sine * leaf(down_planes[k]);
    }
    return result;
}

TensorMatrix tensor_matrix(ExpressionGraph& graph, NodeId tensor, bool on_model) {
    const Node node = graph[tensor];
    const auto a = [&](std::size_t n) { return Term{&graph, node.operands[n]}; };
    const Term zero{&graph, graph.number(0)};
    if (on_model) {
        const ModelTensor of = model_tensor(graph, tensor);
        const Term across = of.low + of.rest;
        TensorMatrix matrix;
        for (std::size_t i = 0; i < 3; ++i) {
            const Term part = of.along * of.t[i];
            for (std::size_t j = 0; j < 3; ++j) {
                const Term entry = part * of.t[j];
                matrix[i][j] = i == j ? across + entry : entry;
            }
        }
        return matrix;
    }
    if (node.operand_count == 6)
        return {{{a(0), a(1), a(2)}, {a(1), a(3), a(4)}, {a(2), a(4), a(5)}}};
    const auto [a11, a12, a22] = node.calls(Function::symmetric)
                                     ? TensorEntries{a(0), a(1), a(2)}
                                     : tensor_entries(graph, a(0), a(1), a(2));
    return {{{a11, a12, zero}, {a12, a22, zero}, {zero, zero, zero}}};
}

std::optional<FieldSpace> FieldSpace::of(const Program& program, const System& system) {
    if (system.cells) return std::nullopt;
    const DomainSettings& domain = program.domain;
    const bool has_metric = domain.surface && domain.surface->has_metric;
    if (domain.model) return FieldSpace{{true, true, true}, false, true};
    const Stencil stencil = domain.grid.stencil();
    return FieldSpace{{stencil.x, stencil.y, stencil.z}, has_metric};
}

NodeId FieldVectors::add(const Node& node, Written written) {
    if (node.is(CellValue::distance)) return graph_.leaf(LagPart::distance);
    const auto instead = node.is<Call>() ? written_out(node) : std::nullopt;
    return instead ? *instead : graph_.add(node, written);
}

std::optional<NodeId> FieldVectors::written_out(const Node& node) {
    const NodeId a = node.operands[0];
    if (node.type == ValueType::tensor) return of_tensors(node);
    if (carries(node.function) && node.operand_count == 2) return carried(node);
    switch (node.function) {
        case Function::unit: return inverse(length(components(a)).term) * term(a);
        case Function::curl: return curl(node);
        case Function::along: return angle(a);
        case Function::diffuse: {
            if (!space_.on_model) return std::nullopt;
            const Term b = term(node.operands[1]), c = term(node.operands[2]);
            const Term spread = tensor(b, c, term(node.operands[3]));
            return div(spread * grad(term(a)));
        }
        case Function::if_:
        case Function::mix:
            if (node.type != ValueType::vector) return std::nullopt;
            return choice(node);
        default: break;
    }
    if (info(node.function).kind != FunctionKind::geometry) return std::nullopt;
    const SparseVector parts = components_of(node);
    if (node.type == ValueType::number) return parts.x.term;
    return vector(parts.x.term, parts.y.term, parts.z.term);
}

/// On a plane or in a volume, the components of ∇ × v are differences of central differences. On a
/// surface, curl is the number ∇ · (v rotated by a right angle), which is correct for any metric.
NodeId FieldVectors::curl(const Node& node) {
    const NodeId of = node.operands[0];
    if (!is_vector(of)) {
        const SparseVector slope = gradient(of);
        return vector(slope.y.term, (-slope.x).term, zero().term);
    }
    const SparseVector v = components(of);
    if (space_.has_metric) return div(vector(v.y.term, (-v.x).term));
    const auto part = [&](std::size_t i, std::size_t j) {
        return (gradient(v[j].term)[i] - gradient(v[i].term)[j]).term;
    };
    if (node.type == ValueType::number) return part(0, 1);
    const Term x = part(1, 2), y = part(2, 0);
    return vector(x, y, part(0, 1));
}

/// The angle of the vector `of`, measured from the first direction towards the second. On a plane
/// these directions are x and y. On a model each cell has its own two directions.
NodeId FieldVectors::angle(NodeId of) {
    const SparseVector v = components(of);
    if (!space_.on_model) return atan2(v.y.term, v.x.term);
    SparseTerm right = zero(), down = zero();
    for (std::size_t k = 0; k < 3; ++k) {
        right = right + v[k] * leaf(right_planes[k]);
        down = down + v[k] * leaf(down_planes[k]);
    }
    return atan2(down.term, right.term);
}

/// Rewrites if(c, v, w) or mix(v, w, t). In each cell, the result of `if` has exactly the
/// components of v or of w.
NodeId FieldVectors::choice(const Node& node) {
    const Term a = term(node.operands[0]), b = term(node.operands[1]), c = term(node.operands[2]);
    if (node.function == Function::mix) return a + c * (b - a);
    const Term one = a.number(1), none = a.number(0);
    const Term first = if_(a, one, none) * b;
    const Term chosen = first + if_(a, none, one) * c;
    const SparseVector v = components(b), w = components(c);
    SparseVector& parts = components_[chosen];
    for (std::size_t k = 0; k < 3; ++k) {
        parts[k] = v[k].term.id == w[k].term.id ? v[k] : SparseTerm{if_(a, v[k].term, w[k].term)};
    }
    return chosen;
}

/// Rewrites advect(v, e) and transport(v, e) as operators on the components of v.
NodeId FieldVectors::carried(const Node& node) {
    const SparseVector v = components(node.operands[0]);
    const Term of = term(node.operands[1]);
    if (!space_.has_axis[2] || space_.has_metric)
        return Term::call(node.function, v.x.term, v.y.term, of);
    return Term::call(node.function, v.x.term, v.y.term, v.z.term, of);
}

/// Rewrites arithmetic on tensors, entry by entry.
std::optional<NodeId> FieldVectors::of_tensors(const Node& node) {
    if (info(node.function).kind != FunctionKind::arithmetic) return std::nullopt;
    std::array<TensorMatrix, 2> operands;
    for (std::size_t n = 0; n < node.operand_count; ++n) {
        const Term operand = term(node.operands[n]);
        operands[n].fill({operand, operand, operand});
        if (operand.type() == ValueType::tensor)
            operands[n] = tensor_matrix(graph_, operand, false);
    }
    const auto entry = [&](std::size_t i, std::size_t j) {
        return SparseTerm::call(node.function, {operands[0][i][j]}, {operands[1][i][j]});
    };
    const std::array entries{entry(0, 0), entry(0, 1), entry(0, 2),
                             entry(1, 1), entry(1, 2), entry(2, 2)};
    const auto& [xx, xy, xz, yy, yz, zz] = entries;
    if (xz.is_zero() && yz.is_zero() && zz.is_zero()) return symmetric(xx.term, xy.term, yy.term);
    return symmetric(xx.term, xy.term, xz.term, yy.term, yz.term, zz.term);
}

SparseVector FieldVectors::gradient(NodeId of) {
    SparseVector parts{zero(), zero(), zero()};
    if (graph_.is_number(of)) return parts;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (space_.has_axis[axis]) parts[axis] = {Term::call(first_derivatives[axis], term(of))};
    }
    return parts;
}

/// Finds components with a stack and without recursion, because vectors may be deeply nested.
const SparseVector& FieldVectors::components(NodeId vector) {
    std::vector<NodeId> waiting{vector};
    while (!waiting.empty()) {
        const NodeId next = waiting.back();
        const Node node = graph_[next];
        const std::size_t before = waiting.size();
        if (!components_.contains(next)) {
            for (const NodeId operand : node.reads()) {
                if (is_vector(operand) && !components_.contains(operand)) {
                    waiting.push_back(operand);
                }
            }
        }
        if (waiting.size() > before) continue;
        waiting.pop_back();
        if (!components_.contains(next)) {
            const SparseVector parts = components_of(node);
            components_.emplace(next, parts);
        }
    }
    return components_.at(vector);
}

SparseVector FieldVectors::components_of(const Node& node) {
    const auto each = [&](const auto& make) {
        return SparseVector{make(std::size_t{0}), make(std::size_t{1}), make(std::size_t{2})};
    };
    if (node.is(CellValue::direction)) {
        constexpr std::array parts{LagPart::direction_x, LagPart::direction_y,
                                   LagPart::direction_z};
        return each([&](std::size_t k) { return space_.has_axis[k] ? leaf(parts[k]) : zero(); });
    }
    if (node.calls(Function::grad)) return gradient(node.operands[0]);
    std::array<SparseVector, most_operands> operands;
    for (std::size_t n = 0; n < node.operand_count; ++n) {
        const NodeId operand = node.operands[n];
        operands[n] = is_vector(operand) ? components(operand) : SparseVector{sparse(operand)};
    }
    if (graph_[node.operands[0]].type == ValueType::tensor) {
        const TensorMatrix matrix = tensor_matrix(graph_, node.operands[0], space_.on_model);
        return each([&](std::size_t i) {
            SparseTerm part = zero();
            for (std::size_t j = 0; j < 3; ++j) {
                part = part + SparseTerm{matrix[i][j]} * operands[1][j];
            }
            return part;
        });
    }
    const auto apply = [&](const auto& numbers) {
        return SparseTerm::call(node.function, numbers[0], numbers[1]);
    };
    return of_components<SparseTerm>(graph_, node, std::span(operands).first(node.operand_count),
                                     apply);
}

}  // namespace cascade

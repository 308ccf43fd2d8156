// Components by rules for each kind of vector, found when they are first needed.
#include "lang/program/field_vectors.h"

#include "core/check.h"

#include <algorithm>
#include <vector>

namespace cascade {

namespace {

constexpr std::array right_planes{ModelPlane::right_x, ModelPlane::right_y, ModelPlane::right_z};
constexpr std::array down_planes{ModelPlane::down_x, ModelPlane::down_y, ModelPlane::down_z};

}  // namespace

ModelTensor model_tensor(ExpressionGraph& graph, NodeId tensor) {
    // Enough of the mean for links to damp the shortest waves along a direction across which
    // nothing spreads.
    constexpr double least_part = 1.0 / 32;
    const auto [a1, a2, theta, d, e, f] = graph[tensor].operands;
    const auto call = [&](Function function, std::initializer_list<NodeId> operands) {
        return graph.call(function, operands);
    };
    const NodeId first = call(Function::multiply, {a1, a1});
    const NodeId second = call(Function::multiply, {a2, a2});
    const NodeId half = graph.number(0.5);
    const NodeId mean = call(Function::multiply, {half, call(Function::add, {first, second})});
    const NodeId written =
        call(Function::multiply, {half, call(Function::subtract, {first, second})});
    const NodeId most = call(Function::multiply, {graph.leaf(ModelPlane::evenness), mean});
    const NodeId apart =
        call(Function::max, {call(Function::negate, {most}), call(Function::min, {written, most})});
    const NodeId below =
        call(Function::multiply, {graph.number(1 - 2 * least_part), call(Function::abs, {apart})});
    ModelTensor result;
    result.low = call(Function::subtract, {mean, below});
    result.rest = call(Function::subtract, {below, apart});
    result.along = call(Function::multiply, {graph.number(2), apart});
    const NodeId cosine = call(Function::cos, {theta}), sine = call(Function::sin, {theta});
    for (std::size_t k = 0; k < 3; ++k) {
        result.t[k] =
            call(Function::add, {call(Function::multiply, {cosine, graph.leaf(right_planes[k])}),
                                 call(Function::multiply, {sine, graph.leaf(down_planes[k])})});
    }
    return result;
}

TensorMatrix tensor_matrix(ExpressionGraph& graph, NodeId tensor, bool on_model) {
    const Node node = graph[tensor];
    const NodeId zero = graph.number(0);
    const auto& a = node.operands;
    if (on_model) {
        const ModelTensor of = model_tensor(graph, tensor);
        const NodeId across = graph.call(Function::add, {of.low, of.rest});
        TensorMatrix matrix;
        for (std::size_t i = 0; i < 3; ++i) {
            const NodeId part = graph.call(Function::multiply, {of.along, of.t[i]});
            for (std::size_t j = 0; j < 3; ++j) {
                const NodeId entry = graph.call(Function::multiply, {part, of.t[j]});
                matrix[i][j] = i == j ? graph.call(Function::add, {across, entry}) : entry;
            }
        }
        return matrix;
    }
    if (node.calls(Function::symmetric) && node.operand_count == 6) {
        return {{{a[0], a[1], a[2]}, {a[1], a[3], a[4]}, {a[2], a[4], a[5]}}};
    }
    const TensorEntries of = node.calls(Function::symmetric)
                                 ? TensorEntries{a[0], a[1], a[2]}
                                 : tensor_entries(graph, a[0], a[1], a[2]);
    return {{{of.a11, of.a12, zero}, {of.a12, of.a22, zero}, {zero, zero, zero}}};
}

std::optional<FieldSpace> FieldSpace::of(const Program& program, const System& system) {
    if (system.cells) return std::nullopt;
    const DomainSettings& domain = program.domain;
    const bool has_metric = domain.surface && domain.surface->has_metric;
    if (domain.model) return FieldSpace{{true, true, true}, false, true};
    const Stencil stencil = domain.grid.stencil();
    return FieldSpace{{stencil.x, stencil.y, stencil.z}, has_metric};
}

NodeId FieldVectors::sum(NodeId a, NodeId b) {
    if (is_zero(a)) return b;
    return is_zero(b) ? a : call(Function::add, {a, b});
}

NodeId FieldVectors::difference(NodeId a, NodeId b) {
    if (is_zero(b)) return a;
    return is_zero(a) ? call(Function::negate, {b}) : call(Function::subtract, {a, b});
}

NodeId FieldVectors::product(NodeId a, NodeId b) {
    return is_zero(a) || is_zero(b) ? zero() : call(Function::multiply, {a, b});
}

NodeId FieldVectors::add(const Node& node, Written written) {
    if (node.is(CellValue::distance)) return graph_.leaf(LagPart::distance);
    const auto instead = node.is<Call>() ? written_out(node) : std::nullopt;
    return instead ? *instead : graph_.add(node, written);
}

std::optional<NodeId> FieldVectors::written_out(const Node& node) {
    const auto& [a, b, c, d, e, f] = node.operands;
    switch (node.function) {
        case Function::component: {
            const auto* const axis = graph_[b].as<double>();
            CHECK(axis != nullptr, "which component is known");
            const auto k = static_cast<std::size_t>(*axis);  // The graph may move.
            return components(a)[k];
        }
        case Function::dot: return dot(a, b);
        case Function::length: return length(a);
        case Function::unit: {
            const NodeId size = length(a), one = graph_.number(1);
            const NodeId inverse =
                call(Function::if_, {call(Function::less, {zero(), size}),
                                     call(Function::divide, {one, size}), zero()});
            return vector_call(Function::multiply, {inverse, a});
        }
        case Function::cross: {
            const Components v = components(a), w = components(b);
            const auto part = [&](std::size_t i, std::size_t j) {
                return difference(product(v[i], w[j]), product(v[j], w[i]));
            };
            return vector_of({part(1, 2), part(2, 0), part(0, 1)});
        }
        case Function::curl: return curl(node);
        case Function::along: return angle(a);
        case Function::diffuse: {
            if (!space_.on_model) return std::nullopt;
            const NodeId tensor = graph_.call(Function::tensor, {b, c, d}, ValueType::tensor);
            const NodeId gradient = vector_call(Function::grad, {a});
            return call(Function::div, {vector_call(Function::multiply, {tensor, gradient})});
        }
        case Function::if_:
        case Function::mix:
            if (node.type != ValueType::vector) return std::nullopt;
            return choice(node);
        case Function::advect:
        case Function::transport:
            if (node.operand_count != 2) return std::nullopt;
            return carried(node);
        default: return of_tensors(node);
    }
}

/// The product of a sum is left out where a component is known to be 0.
NodeId FieldVectors::dot(NodeId a, NodeId b) {
    const Components v = components(a), w = components(b);
    NodeId result = zero();
    for (std::size_t k = 0; k < 3; ++k) result = sum(result, product(v[k], w[k]));
    return result;
}

NodeId FieldVectors::length(NodeId vector) {
    const NodeId square = dot(vector, vector);
    return is_zero(square) ? zero() : call(Function::sqrt, {square});
}

/// Along axes of the grid the three components of ∇ × v are differences of central ones. On a
/// surface the number is ∇ · (v turned by a right angle), which is right whatever the metric.
NodeId FieldVectors::curl(const Node& node) {
    const NodeId of = node.operands[0];
    if (!is_vector(of)) {
        const Components slope = gradient(of);
        return vector_of(
            {slope[1], is_zero(slope[0]) ? zero() : call(Function::negate, {slope[0]}), zero()});
    }
    const Components v = components(of);
    if (space_.has_metric) {
        const NodeId turned =
            vector_call(Function::vector,
                        {v[1], is_zero(v[0]) ? zero() : call(Function::negate, {v[0]})});
        return call(Function::div, {turned});
    }
    const auto part = [&](std::size_t i, std::size_t j) {
        return difference(gradient(v[j])[i], gradient(v[i])[j]);
    };
    if (node.type == ValueType::number) return part(0, 1);
    return vector_of({part(1, 2), part(2, 0), part(0, 1)});
}

/// From the first direction towards the second. On a model these are two directions of each cell.
NodeId FieldVectors::angle(NodeId vector) {
    const Components v = components(vector);
    if (!space_.on_model) return call(Function::atan2, {v[1], v[0]});
    NodeId right = zero(), down = zero();
    for (std::size_t k = 0; k < 3; ++k) {
        right = sum(right, product(v[k], graph_.leaf(right_planes[k])));
        down = sum(down, product(v[k], graph_.leaf(down_planes[k])));
    }
    return call(Function::atan2, {down, right});
}

/// if(c, v, w) or mix(v, w, t). In a cell `if` takes the components of one of both, unchanged.
NodeId FieldVectors::choice(const Node& node) {
    const auto& [a, b, c, d, e, f] = node.operands;
    if (node.function == Function::mix) {
        const NodeId apart = vector_call(Function::subtract, {b, a});
        const NodeId part = vector_call(Function::multiply, {c, apart});
        return vector_call(Function::add, {a, part});
    }
    const auto times = [&](double where_true, double where_false, NodeId vector) {
        const NodeId is_chosen =
            call(Function::if_, {a, graph_.number(where_true), graph_.number(where_false)});
        return vector_call(Function::multiply, {is_chosen, vector});
    };
    const NodeId first = times(1, 0, b);
    const NodeId chosen = vector_call(Function::add, {first, times(0, 1, c)});
    const Components v = components(b), w = components(c);
    Components& parts = components_[chosen];
    for (std::size_t k = 0; k < 3; ++k) {
        parts[k] = v[k] == w[k] ? v[k] : call(Function::if_, {a, v[k], w[k]});
    }
    return chosen;
}

/// advect(v, e) and transport(v, e) by the components of v.
NodeId FieldVectors::carried(const Node& node) {
    const Components v = components(node.operands[0]);
    const NodeId of = node.operands[1];
    if (space_.has_axis[2] && !space_.has_metric)
        return call(node.function, {v[0], v[1], v[2], of});
    return call(node.function, {v[0], v[1], of});
}

/// Arithmetic of tensors, by entries.
std::optional<NodeId> FieldVectors::of_tensors(const Node& node) {
    if (node.type != ValueType::tensor || info(node.function).kind != FunctionKind::arithmetic) {
        return std::nullopt;
    }
    const auto is_tensor = [&](NodeId id) { return graph_[id].type == ValueType::tensor; };
    std::array<TensorMatrix, 2> matrices{};
    for (std::size_t n = 0; n < node.operand_count; ++n) {
        const NodeId operand = node.operands[n];
        if (is_tensor(operand)) matrices[n] = tensor_matrix(graph_, operand, false);
    }
    const auto entry = [&](std::size_t i, std::size_t j) {
        const auto of = [&](std::size_t n) {
            return is_tensor(node.operands[n]) ? matrices[n][i][j] : node.operands[n];
        };
        switch (node.function) {
            case Function::negate: return difference(zero(), of(0));
            case Function::add: return sum(of(0), of(1));
            case Function::subtract: return difference(of(0), of(1));
            case Function::divide:
                return is_zero(of(0)) ? zero() : call(Function::divide, {of(0), of(1)});
            case Function::multiply: return product(of(0), of(1));
            default: break;
        }
        CHECK(false, "arithmetic of tensors has a rule for every operator");
    };
    const std::array entries{entry(0, 0), entry(0, 1), entry(0, 2),
                             entry(1, 1), entry(1, 2), entry(2, 2)};
    const auto& [xx, xy, xz, yy, yz, zz] = entries;
    if (is_zero(xz) && is_zero(yz) && is_zero(zz)) {
        return graph_.call(Function::symmetric, {xx, xy, yy}, ValueType::tensor);
    }
    return graph_.call(Function::symmetric, {xx, xy, xz, yy, yz, zz}, ValueType::tensor);
}

FieldVectors::Components FieldVectors::gradient(NodeId of) {
    Components parts{zero(), zero(), zero()};
    if (graph_[of].is<double>()) return parts;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (space_.has_axis[axis]) parts[axis] = call(first_derivatives[axis], {of});
    }
    return parts;
}

/// Vectors may be nested deeply, so those that are not known yet wait on a stack.
const FieldVectors::Components& FieldVectors::components(NodeId vector) {
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
            const Components parts = components_of(node);
            components_.emplace(next, parts);
        }
    }
    return components_.at(vector);
}

FieldVectors::Components FieldVectors::components_of(const Node& node) {
    const NodeId a = node.operands[0], b = node.operands[1];
    const auto each = [&](const auto& make) {
        return Components{make(std::size_t{0}), make(std::size_t{1}), make(std::size_t{2})};
    };
    const auto of = [&](NodeId vector, std::size_t k) { return components_.at(vector)[k]; };
    if (node.is(CellValue::direction)) {
        constexpr std::array parts{LagPart::direction_x, LagPart::direction_y,
                                   LagPart::direction_z};
        return each(
            [&](std::size_t k) { return space_.has_axis[k] ? graph_.leaf(parts[k]) : zero(); });
    }
    switch (node.function) {
        case Function::grad: return gradient(a);
        case Function::vector:
            return each(
                [&](std::size_t k) { return k < node.operand_count ? node.operands[k] : zero(); });
        case Function::negate:
            return each([&](std::size_t k) { return difference(zero(), of(a, k)); });
        case Function::add: return each([&](std::size_t k) { return sum(of(a, k), of(b, k)); });
        case Function::subtract:
            return each([&](std::size_t k) { return difference(of(a, k), of(b, k)); });
        case Function::divide:
            return each([&](std::size_t k) {
                return is_zero(of(a, k)) ? zero() : call(Function::divide, {of(a, k), b});
            });
        case Function::multiply: break;
        default: CHECK(false, "every vector has components");
    }
    if (graph_[a].type == ValueType::tensor) {
        const TensorMatrix matrix = tensor_matrix(graph_, a, space_.on_model);
        return each([&](std::size_t i) {
            NodeId part = zero();
            for (std::size_t j = 0; j < 3; ++j) part = sum(part, product(matrix[i][j], of(b, j)));
            return part;
        });
    }
    if (is_vector(a)) return each([&](std::size_t k) { return product(of(a, k), b); });
    return each([&](std::size_t k) { return product(a, of(b, k)); });
}

}  // namespace cascade

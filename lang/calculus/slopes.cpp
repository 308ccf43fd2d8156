// Computes slopes through functions, operators and vectors.
#include "lang/calculus/slopes.h"

#include "lang/calculus/derivative_rules.h"
#include "lang/program/vector_functions.h"
#include "lang/vocabulary/function_groups.h"

#include <algorithm>
#include <span>
#include <utility>

namespace cascade {

SlopeRules::SlopeRules(Algebra& algebra, const Program& program, const ModelFacts* model)
    : algebra_(algebra), gains_(algebra, program, model), zero_{&algebra, algebra.number(0)} {}

bool SlopeRules::is_zero(const Slope& slope) const {
    return slope.own == zero_ && slope.far == zero_ && !slope.jumps;
}

void SlopeRules::add(Slope& sum_so_far, const Slope& slope) {
    sum_so_far.own = sum_so_far.own + slope.own;
    sum_so_far.far = sum_so_far.far + slope.far;
    sum_so_far.other = sum_so_far.other + slope.other;
    sum_so_far.jumps |= slope.jumps;
    if (sum_so_far.diffusion.size() < slope.diffusion.size()) {
        sum_so_far.diffusion.resize(slope.diffusion.size(), zero_);
    }
    for (std::size_t k = 0; k < slope.diffusion.size(); ++k) {
        sum_so_far.diffusion[k] = sum_so_far.diffusion[k] + slope.diffusion[k];
    }
}

Slope SlopeRules::scaled(const Slope& slope, Term factor) {
    const Term size = abs(factor);
    Slope result{slope.own * factor, slope.far * size, {}, slope.other * size, slope.jumps};
    for (const Term each : slope.diffusion) result.diffusion.push_back(each * factor);
    return result;
}

/// The slope after an operator of diffusion has been applied, or half of such an operator: a
/// gradient or a divergence.
Slope SlopeRules::through_diffusion(const Slope& slope, Term gain) {
    Slope result = zero();
    result.jumps = slope.jumps;
    result.far = gain * all_of(slope);
    result.other = gain * slope.other;
    result.diffusion.push_back(gain * slope.own);
    for (const Term each : slope.diffusion) result.diffusion.push_back(gain * each);
    return result;
}

Slope SlopeRules::through_other(const Slope& slope, Term gain) {
    const Term far = gain * all_of(slope);
    return {zero_, far, {}, far, slope.jumps};
}

/// The part of a product's slope that comes from one factor, if the product's factors are averaged
/// at faces. In such a product, diffusion cannot be separated from other changes.
Slope SlopeRules::as_other(const Slope& slope, Term factor) {
    const Term far = slope.far * abs(factor);
    return {slope.own * factor, far, {}, far, slope.jumps};
}

std::optional<Slopes> SlopeRules::slopes_of(NodeId id, ItemId species,
                                            const IdVector<NodeId, Slopes>& before) {
    const Node node = algebra_[id];
    Slopes slopes{zero(), zero(), zero()};
    if (node.is(species)) slopes[0].own = zero_.number(1);
    if (!node.is<Call>()) return slopes;
    bool depends = false;
    for (const NodeId operand : node.reads()) {
        for (const Slope& slope : before[operand]) depends |= !is_zero(slope);
    }
    if (node.type == ValueType::tensor) {
        // There is no rule for a tensor whose direction depends on a species.
        if (depends) return std::nullopt;
        return slopes;
    }
    if (!depends) return slopes;
    if (node.type == ValueType::vector) return of_vector(node, before);
    const auto slope = of_number(node, before);
    if (!slope) return std::nullopt;
    slopes[0] = *slope;
    return slopes;
}

std::optional<Slope> SlopeRules::of_number(const Node& node,
                                           const IdVector<NodeId, Slopes>& before) {
    const Slopes& first = before[node.operands[0]];
    if (carries(node.function)) return of_advection(node, before);
    switch (node.function) {
        case Function::div: return of_divergence(first);
        case Function::grad2: return of_squared_gradient(node, first[0]);
        case Function::diffuse:
            for (std::size_t n = 1; n < 4; ++n) {
                if (!is_zero(before[node.operands[n]][0])) return std::nullopt;
            }
            break;
        default: break;
    }
    if (const auto gain = gains_.of_diffusion(node)) return through_diffusion(first[0], *gain);
    if (const auto gain = gains_.of_other(node)) return through_other(first[0], *gain);
    return by_partials(node, before);
}

std::optional<Slope> SlopeRules::by_partials(const Node& node,
                                             const IdVector<NodeId, Slopes>& before) {
    Slope slope = zero();
    for (std::size_t n = 0; n < node.operand_count; ++n) {
        const Slope& inner = before[node.operands[n]][0];
        if (is_zero(inner)) continue;
        const auto partial = partial_derivative(algebra_, node, n);
        if (!partial) return std::nullopt;
        add(slope, scaled(inner, term(*partial)));
        slope.jumps |= jumps_by(node.function, n);
    }
    return slope;
}

/// Σ 2 · (derivative of e) · (derivative of the change of e), over all directions.
Slope SlopeRules::of_squared_gradient(const Node& node, const Slope& inner) {
    Slope slope = zero();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!gains_.has_axis(axis)) continue;
        const Term along = abs(gains_.derivative(node.operands[0], axis));
        const Term twice = zero_.number(2) * gains_.of_derivative(axis);
        add(slope, through_other(inner, along * twice));
    }
    return slope;
}

/// An upwind difference v (c − W) / h, with the value c of the cell and W of its western neighbour,
/// consists of diffusion with the gain −2 |v| / h and waves with the gain |v| / h. Limiters at most
/// double the difference.
Slope SlopeRules::of_advection(const Node& node, const IdVector<NodeId, Slopes>& before) {
    const std::size_t velocities = node.operand_count - 1;
    const NodeId carried = node.operands[velocities];
    Slope slope = zero();
    Node by_change = node;
    bool velocity_changes = false;
    Term speed = zero_;
    for (std::size_t axis = 0; axis < velocities; ++axis) {
        const Term velocity = term(node.operands[axis]);
        const Slope& change = before[velocity][0];
        by_change.operands[axis] = change.own;
        velocity_changes |= change.own != zero_;
        if (!gains_.has_axis(axis)) continue;
        add(slope, as_other({zero_, change.far, {}, change.other, change.jumps},
                            gains_.derivative(carried, axis)));
        speed = speed + abs(velocity) * gains_.of_gradient(axis);
    }
    if (velocity_changes) slope.own = term(algebra_.add(by_change));
    if (node.calls(Function::transport)) speed = zero_.number(2) * speed;
    const Slope& inner = before[carried][0];
    Slope carries = through_diffusion(inner, speed);
    for (Term& each : carries.diffusion) each = -each;
    carries.other = carries.other + zero_.number(0.5) * carries.far;
    add(slope, carries);
    return slope;
}

/// A value that is averaged at faces contributes half its gain to `other`, as a wave. With the
/// value c of the cell and the values E and W of its neighbours, (c + E)/2 − (c + W)/2 = (E − W)/2.
Slope SlopeRules::of_divergence(const Slopes& flux) {
    Slope slope = zero();
    Node vector;
    vector.kind = Call();
    vector.function = Function::vector;
    vector.type = ValueType::vector;
    vector.operand_count = static_cast<std::uint8_t>(gains_.has_axis(2) ? 3 : 2);
    bool changes = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Slope& along = flux[axis];
        if (axis < vector.operand_count) vector.operands[axis] = along.own;
        changes |= along.own != zero_;
        slope.jumps |= along.jumps;
        if (!gains_.has_axis(axis)) continue;
        const Term gain = gains_.of_gradient(axis);
        slope.far = slope.far + gain * all_of(along);
        slope.other = slope.other + gain * (zero_.number(0.5) * abs(along.own) + along.other);
        if (slope.diffusion.size() < along.diffusion.size()) {
            slope.diffusion.resize(along.diffusion.size(), zero_);
        }
        for (std::size_t k = 0; k < along.diffusion.size(); ++k) {
            slope.diffusion[k] = slope.diffusion[k] + gain * along.diffusion[k];
        }
    }
    // On a model, a flux has no components. There, the change of the cell's own value is part of
    // `far`, like the changes of the neighbours' values.
    if (changes && !gains_.is_on_model()) slope.own = div(term(algebra_.add(vector)));
    return slope;
}

template <typename Make>
Slopes SlopeRules::along_axes(const Make& make) {
    Slopes slopes{zero(), zero(), zero()};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (gains_.has_axis(axis)) slopes[axis] = make(axis);
    }
    return slopes;
}

/// Computes the slopes of a vector from the slopes of its operands.
struct SlopeRules::OfVectors {
    SlopeRules& own;
    const IdVector<NodeId, Slopes>& before;

    Term number(double value) const { return own.zero_.number(value); }
    Slopes gradient(NodeId of) const {
        return own.along_axes([&](std::size_t axis) {
            return own.through_diffusion(before[of][0], own.gains_.of_gradient(axis));
        });
    }
    Slopes components(std::span<const NodeId> parts) const {
        return own.along_axes([&](std::size_t axis) {
            return axis < parts.size() ? own.as_other(before[parts[axis]][0], number(1))
                                       : own.zero();
        });
    }
    Slopes scaled(NodeId vector, Term by) const {
        return own.along_axes(
            [&](std::size_t axis) { return own.scaled(before[vector][axis], by); });
    }
    Slopes negative(NodeId vector) const { return scaled(vector, number(-1)); }
    Slopes joined(NodeId a, const Slopes& b) const {
        return own.along_axes([&](std::size_t axis) {
            Slope slope = before[a][axis];
            own.add(slope, b[axis]);
            return slope;
        });
    }
    Slopes sum(NodeId a, NodeId b) const { return joined(a, before[b]); }
    Slopes difference(NodeId a, NodeId b) const { return joined(a, negative(b)); }
    Slopes quotient(NodeId vector, NodeId factor) const {
        const Term by = number(1) / own.term(factor);
        const Term change = -(by * by);
        return multiple(vector, by, factor, change);
    }
    Slopes product(NodeId a, NodeId b, bool is_vector_first) const {
        const NodeId factor = is_vector_first ? b : a;
        return multiple(is_vector_first ? a : b, own.term(factor), factor, number(1));
    }
    /// The slopes of a vector times `by`, where `change` is the derivative of `by` with respect to
    /// `factor`.
    Slopes multiple(NodeId vector, Term by, NodeId factor, Term change) const {
        return own.along_axes([&](std::size_t axis) {
            Slope slope = own.scaled(before[vector][axis], by);
            const Term value = own.gains_.components(vector)[axis].term;
            own.add(slope, own.as_other(before[factor][0], value * change));
            return slope;
        });
    }
    Slopes turned(NodeId tensor, NodeId vector) const {
        return own.times_tensor(tensor, before[vector]);
    }
};

std::optional<Slopes> SlopeRules::of_vector(const Node& node,
                                            const IdVector<NodeId, Slopes>& before) {
    if (!makes_flux(node.function)) return std::nullopt;
    return vector_by(OfVectors{*this, before}, algebra_, node);
}

/// The waves of a gradient decay at most as fast as if both a1² and a2² were the larger of the two
/// (surface/cell_frames.h).
Slopes SlopeRules::times_model_tensor(const Node& tensor, const Slopes& flux) {
    const Term a1 = term(tensor.operands[0]), a2 = term(tensor.operands[1]);
    const Term most = max(square(a1), square(a2));
    Slopes slopes{zero(), zero(), zero()};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        slopes[axis] = scaled(flux[axis], most);
        for (std::size_t other = 0; other < 3; ++other) {
            const bool is_of_gradient = flux[other].own == zero_ && flux[other].other == zero_;
            if (other == axis || is_of_gradient) continue;
            Slope across = scaled(flux[other], most);
            across.diffusion.clear();
            add(slopes[axis], across);
        }
    }
    return slopes;
}

/// For a gradient, the diagonal of the tensor A is enough to bound the gain. In units of 4/h², with
/// sines s and cosines c along the axes, the symbol of div(A grad e) is Σ a_ii s_i² + 2 Σ a_ij s_i
/// c_i s_j c_j. If A is positive semidefinite, |a_ij| ≤ √(a_ii a_jj). Then the symbol is at most
/// the trace of A times the largest eigenvalue of diag(s_i⁴) + v vᵀ with v_i = s_i c_i. This
/// eigenvalue is at most 1 in the plane and 9/8 in space, at s_i² = 3/4.
Slopes SlopeRules::times_tensor(NodeId tensor, const Slopes& flux) {
    const Node node = algebra_[tensor];
    if (gains_.is_on_model()) return times_model_tensor(node, flux);
    const bool in_space = node.calls(Function::symmetric) && node.operand_count == 6;
    const std::size_t size = in_space ? 3 : 2;
    const auto is_of_gradient = [&](const Slope& slope) {
        return slope.own == zero_ && slope.other == zero_;
    };
    const bool is_gradient =
        !gains_.has_metric() && std::all_of(flux.begin(), flux.end(), is_of_gradient);
    Slopes slopes{zero(), zero(), zero()};
    const TensorMatrix matrix = tensor_matrix(algebra_, tensor, false);
    for (std::size_t axis = 0; axis < size; ++axis) {
        Term along = matrix[axis][axis];
        if (in_space) along = zero_.number(9.0 / 8) * along;
        slopes[axis] = scaled(flux[axis], along);
        for (std::size_t other = 0; other < size && !is_gradient; ++other) {
            if (other == axis) continue;
            Slope across = scaled(flux[other], matrix[axis][other]);
            across.diffusion.clear();
            add(slopes[axis], across);
        }
    }
    return slopes;
}

}  // namespace cascade

// Operators on the cells of a model, which have links to their neighbours and no rows and columns.
//
// What reads neighbours is a sum over links (ir/operations.def). A flux is known as what flows
// through each link, so vectors are sums of gradients times numbers, and div takes each of them by
// itself: div(a * grad(e)) is the sum over the links of w (a_i + a_j) / 2 (e_j - e_i).
// Spec/models.md has the formulas, and lang/check/check_model.cpp refuses the rest.
#include "lang/lower/part_graph.h"

#include "core/check.h"

#include <algorithm>

namespace cascade::lowering {

std::optional<ModelPlane> model_plane_of(Builtin builtin) {
    switch (builtin) {
        case Builtin::x: return ModelPlane::x;
        case Builtin::y: return ModelPlane::y;
        case Builtin::z: return ModelPlane::z;
        case Builtin::sx: return ModelPlane::sx;
        case Builtin::sy: return ModelPlane::sy;
        case Builtin::sz: return ModelPlane::sz;
        case Builtin::nx: return ModelPlane::nx;
        case Builtin::ny: return ModelPlane::ny;
        case Builtin::nz: return ModelPlane::nz;
        case Builtin::curvature: return ModelPlane::curvature;
        case Builtin::curvature_mean: return ModelPlane::curvature_mean;
        case Builtin::curvature_gauss: return ModelPlane::curvature_gauss;
        case Builtin::curvature_high: return ModelPlane::curvature_high;
        case Builtin::curvature_low: return ModelPlane::curvature_low;
        case Builtin::t:
        case Builtin::step: break;
    }
    return std::nullopt;
}

PartId PartGraph::model(ModelPlane plane) {
    Part part;
    part.node.kind = NodeKind::model;
    part.node.index = static_cast<std::uint32_t>(plane);
    return intern(part);
}

PartId PartGraph::number(double value) {
    Part part;
    part.node.number = value;
    return intern(part);
}

/// What a vector is, from what its operands are. Gradients of the same are one.
PartGraph::Gradients PartGraph::sum_of_gradients(const Part& part) {
    const auto is_vector = [&](PartId id) { return parts_[id].node.type == ValueType::vector; };
    const PartId first = part.operands[0], second = part.operands[1];
    Gradients sum;
    switch (part.node.function) {
        case Function::grad: return {{first, number(1)}};
        case Function::negate:
            sum = gradients_of(first);
            for (auto& [of, factor] : sum) factor = call(Function::negate, {factor});
            return sum;
        case Function::divide:
            sum = gradients_of(first);
            for (auto& [of, factor] : sum) factor = call(Function::divide, {factor, second});
            return sum;
        case Function::multiply: {
            const PartId by = is_vector(first) ? second : first;
            sum = gradients_of(is_vector(first) ? first : second);
            for (auto& [of, factor] : sum) {
                const bool is_one =
                    parts_[factor].node.kind == NodeKind::number && parts_[factor].node.number == 1;
                factor = is_one ? by : call(Function::multiply, {by, factor});
            }
            return sum;
        }
        case Function::add:
        case Function::subtract: {
            sum = gradients_of(first);
            for (const auto& [of, factor] : gradients_of(second)) {
                const auto known = std::find_if(sum.begin(), sum.end(),
                                                [&](const auto& each) { return each.first == of; });
                if (known != sum.end()) {
                    known->second = call(part.node.function, {known->second, factor});
                } else {
                    const bool is_taken_away = part.node.function == Function::subtract;
                    sum.emplace_back(of, is_taken_away ? call(Function::negate, {factor}) : factor);
                }
            }
            return sum;
        }
        default: break;
    }
    CHECK(false, "lowering: a flux on a model is made of gradients");
    return sum;
}

PartId PartGraph::divergence_over_links(const Gradients& gradients) {
    std::optional<PartId> sum;
    for (const auto& [of, factor] : gradients) {
        PartId term{};
        if (parts_[factor].is_uniform) {
            term = call(Function::multiply, {factor, call(Function::lap, {of})});
        } else {
            term = call(Function::lap, {factor, of});
        }
        sum = sum ? call(Function::add, {*sum, term}) : term;
    }
    CHECK(sum, "lowering: a flux has a gradient");
    return *sum;
}

PartId PartGraph::on_model(const Part& part) {
    if (part.node.kind == NodeKind::builtin) {
        const auto plane = model_plane_of(static_cast<Builtin>(part.node.index));
        return plane ? model(*plane) : intern(part);
    }
    if (part.node.kind != NodeKind::call) return intern(part);
    const PartId first = part.operands[0];
    if (part.node.type == ValueType::vector) {
        const PartId id = intern(part);
        if (!gradients_.contains(id)) gradients_.emplace(id, sum_of_gradients(part));
        return id;
    }
    switch (part.node.function) {
        case Function::div: return divergence_over_links(gradients_of(first));
        case Function::domain_sum:
            return call(Function::domain_sum,
                        {call(Function::multiply, {first, model(ModelPlane::area)})});
        case Function::domain_mean: {
            const PartId area = model(ModelPlane::area);
            return call(Function::divide,
                        {call(Function::domain_sum, {call(Function::multiply, {first, area})}),
                         call(Function::domain_sum, {area})});
        }
        default: return intern(part);
    }
}

}  // namespace cascade::lowering

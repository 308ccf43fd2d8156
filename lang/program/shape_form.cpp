// Nodes are sorted by what they depend on, and computed when that has changed.
#include "lang/program/shape_form.h"

#include "core/check.h"
#include "lang/program/fold.h"

#include <algorithm>
#include <array>

namespace cascade {

namespace {

/// A number or a vector by components, of which a number has one.
double component(Vector3d v, std::size_t k) { return k == 0 ? v.x : k == 1 ? v.y : v.z; }

}  // namespace

std::optional<ItemId> ShapeForm::find(std::string_view quantity) const {
    for (const ItemId item : quantities.ids()) {
        if (item.index() >= known_count && quantities[item].name == quantity) return item;
    }
    return std::nullopt;
}

ShapeFunction::ShapeFunction(const Formula& formula, std::span<const double> values, double part)
    : nodes_(formula.nodes), values_(nodes_.size()) {
    enum class Depends : std::uint8_t { on_nothing, on_t, on_s };
    IdVector<NodeId, Depends> depends(nodes_.size());
    for (const NodeId id : nodes_.ids()) {
        const Node& node = nodes_[id];
        if (const auto* number = node.as<double>()) {
            values_[id] = {*number, 0, 0};
        } else if (const auto* item = node.as<ItemId>()) {
            switch (item->index()) {
                case ShapeForm::t:
                    depends[id] = Depends::on_t;
                    reads_t_.push_back(id);
                    break;
                case ShapeForm::s:
                    depends[id] = Depends::on_s;
                    reads_s_.push_back(id);
                    break;
                case ShapeForm::part: values_[id] = {part, 0, 0}; break;
                default: values_[id] = {values[item->index()], 0, 0};
            }
        } else {
            CHECK(node.is<Call>(), "a formula of a shape is made of functions");
            for (const NodeId operand : node.reads()) {
                depends[id] = std::max(depends[id], depends[operand]);
            }
            switch (depends[id]) {
                case Depends::on_nothing: compute(id); break;
                case Depends::on_t: of_t_.push_back(id); break;
                case Depends::on_s: of_s_.push_back(id); break;
            }
        }
    }
}

Vector3d ShapeFunction::operator()(double t, double s) {
    if (t_ != t) {
        t_ = t;
        for (const NodeId id : reads_t_) values_[id].x = t;
        for (const NodeId id : of_t_) compute(id);
    }
    for (const NodeId id : reads_s_) values_[id].x = s;
    for (const NodeId id : of_s_) compute(id);
    return values_.back();
}

void ShapeFunction::compute(NodeId id) {
    const Node& node = nodes_[id];
    const auto operand = [&](std::size_t k) { return values_[node.operands[k]]; };
    Vector3d& value = values_[id];
    switch (node.function) {
        case Function::vector:
            value = {operand(0).x, operand(1).x, node.operand_count == 3 ? operand(2).x : 0};
            return;
        case Function::dot: value = {dot(operand(0), operand(1)), 0, 0}; return;
        case Function::cross: value = cross(operand(0), operand(1)); return;
        case Function::length: value = {length(operand(0)), 0, 0}; return;
        case Function::unit: value = unit(operand(0)); return;
        case Function::component:
            value = {component(operand(0), static_cast<std::size_t>(operand(1).x)), 0, 0};
            return;
        default: break;
    }
    std::array<double, 3> parts{};
    for (std::size_t k = 0; k < (node.type == ValueType::vector ? 3 : 1); ++k) {
        std::array<double, most_operands> numbers{};
        for (std::size_t n = 0; n < node.operand_count; ++n) {
            const bool is_vector = nodes_[node.operands[n]].type == ValueType::vector;
            numbers[n] = component(operand(n), is_vector ? k : 0);
        }
        const auto folded = fold(node.function, numbers);
        CHECK(folded, "a formula of a shape is made of functions of numbers");
        parts[k] = *folded;
    }
    value = {parts[0], parts[1], parts[2]};
}

}  // namespace cascade

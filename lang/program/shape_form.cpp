// Evaluates formulas of shapes. Nodes are grouped by the variables on which they depend, and a node
// is computed again only when one of these variables changes.
#include "lang/program/shape_form.h"

#include "core/check.h"
#include "lang/program/fold.h"
#include "lang/program/vector_functions.h"

#include <algorithm>
#include <array>
#include <span>

namespace cascade {

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
    std::array<Vector3d, most_operands> operands;
    std::ranges::transform(node.reads(), operands.begin(), [&](NodeId of) { return values_[of]; });
    values_[id] = of_components<double>(
        nodes_, node, std::span(operands).first(node.operand_count), [&](const auto& numbers) {
            const auto folded = fold(node.function, numbers);
            CHECK(folded, "a formula of a shape is made of functions of numbers");
            return *folded;
        });
}

}  // namespace cascade

// Which values differ between cells, and the names of items.
#include "lang/program/program.h"

#include "core/check.h"

#include <algorithm>

namespace cascade {

Formula formula_of(const Nodes& nodes, NodeId root) {
    std::vector<bool> needed(root.index() + 1, false);
    needed[root.index()] = true;
    for (std::size_t k = needed.size(); k-- > 0;) {
        if (!needed[k]) continue;
        for (const NodeId operand : nodes[NodeId(k)].reads()) needed[operand.index()] = true;
    }
    Formula formula;
    IdVector<NodeId, NodeId> place(needed.size());
    for (const NodeId id : place.ids()) {
        if (!needed[id.index()]) continue;
        place[id] = formula.nodes.next();
        Node& node = formula.nodes.emplace_back(nodes[id]);
        for (NodeId& operand : node.reads()) operand = place[operand];
    }
    return formula;
}

std::uint32_t Literals::number_of(const std::string& text) {
    // Only the last few are compared, so that large numbers of them cost no time.
    const std::size_t count = texts_.size();
    for (std::size_t i = count; i > 0 && count - i < 64; --i) {
        if (texts_[i - 1] == text) return static_cast<std::uint32_t>(i - 1);
    }
    texts_.push_back(text);
    return static_cast<std::uint32_t>(count);
}

std::uint32_t Literals::number_of(const SurfaceValue& value) {
    const auto found = std::find(surface_values_.begin(), surface_values_.end(), value);
    const auto number = static_cast<std::uint32_t>(found - surface_values_.begin());
    if (found == surface_values_.end()) surface_values_.push_back(value);
    return number;
}

bool differs_by_cell(const Node& node, bool operand_differs, const Program& program,
                     std::uint32_t stage) {
    const auto item_differs = [&](std::uint32_t of, std::uint32_t item) {
        const std::vector<bool>& uniform = program.stages[of].uniform;
        return uniform.empty() || !uniform[item];
    };
    switch (node.kind) {
        case NodeKind::number:
        case NodeKind::text: return false;
        case NodeKind::own: return item_differs(stage, node.index);
        case NodeKind::earlier: return item_differs(node.stage, node.index);
        case NodeKind::builtin: {
            const auto builtin = static_cast<Builtin>(node.index);
            if (builtin == Builtin::step) return false;
            return builtin != Builtin::t ||
                   item_differs(stage, program.system_of(stage).speed_item());
        }
        case NodeKind::definition:
        case NodeKind::rate:
        case NodeKind::metric:
        case NodeKind::model:
        case NodeKind::surface_value:
        case NodeKind::inside: return true;
        case NodeKind::call: break;
    }
    // An aggregate over the domain is one number, whatever its operand.
    if (info(node.function).is_aggregate) return false;
    return operand_differs || (varies_by_cell(node.function) && !differentiates(node.function));
}

std::uint32_t System::species_count() const {
    const auto count = std::count_if(quantities.begin(), quantities.end(),
                                     [](const Quantity& quantity) { return quantity.is_species; });
    return static_cast<std::uint32_t>(count);
}

std::string_view System::item_name(std::uint32_t item) const {
    if (item < quantities.size()) return quantities[item].name;
    CHECK(item < item_count(), "an item is a quantity, frozen or speed");
    return item == frozen_item() ? "frozen" : "speed";
}

}  // namespace cascade

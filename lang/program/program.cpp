// Finds which values differ between cells, and the names of items.
#include "lang/program/program.h"

#include "core/check.h"
#include "core/overloaded.h"

#include <algorithm>
#include <iterator>

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

std::optional<ReductionKind> reduction_of(Function function) {
    const std::string_view spelling = info(function).spelling;
    if (!info(function).is_reduction) return std::nullopt;
    if (spelling.starts_with("sum")) return ReductionKind::sum;
    if (spelling.starts_with("mean")) return ReductionKind::mean;
    return spelling.starts_with("min") ? ReductionKind::least : ReductionKind::largest;
}

TextId Literals::id_of(const std::string& text) {
    // Only the last 64 texts are compared, so that the time does not grow with the number of texts.
    const std::size_t count = texts_.size();
    for (std::size_t i = count; i > 0 && count - i < 64; --i) {
        if (texts_[i - 1] == text) return TextId(i - 1);
    }
    texts_.push_back(text);
    return TextId(count);
}

SurfaceValueId Literals::id_of(const SurfaceValue& value) {
    const auto found = std::find(surface_values_.begin(), surface_values_.end(), value);
    const SurfaceValueId id(static_cast<std::size_t>(found - surface_values_.begin()));
    if (found == surface_values_.end()) surface_values_.push_back(value);
    return id;
}

std::uint32_t Literals::add(ConvolutionKernel kernel) {
    kernels_.push_back(std::move(kernel));
    return static_cast<std::uint32_t>(kernels_.size() - 1);
}

std::uint32_t Literals::add(Constraint constraint) {
    constraints_.push_back(std::move(constraint));
    return static_cast<std::uint32_t>(constraints_.size() - 1);
}

std::uint32_t Literals::add(FileReading reading) {
    if (reading.place.empty()) {
        const auto known =
            std::find_if(readings_.begin(), readings_.end(), [&](const FileReading& each) {
                return each.place.empty() && each.channel == reading.channel &&
                       each.is_direction == reading.is_direction;
            });
        if (known != readings_.end()) {
            return static_cast<std::uint32_t>(known - readings_.begin());
        }
    }
    readings_.push_back(std::move(reading));
    return reading_count() - 1;
}

bool differs_by_cell(const Node& node, bool operand_differs, const Program& program,
                     std::uint32_t stage) {
    const auto item_differs = [&](StageItem each) {
        const auto& uniform = program.stages[each.stage].uniform;
        return uniform.empty() || !uniform[each.item];
    };
    const Overloaded differs{
        [](double) { return false; },
        [](TextId) { return false; },
        [&](ItemId item) {
            return item_differs({stage, item});
        },
        item_differs,
        [&](SensedItem sensed) { return item_differs(sensed.item); },
        [&](Builtin builtin) {
            if (builtin == Builtin::step) return false;
            return builtin != Builtin::t ||
                   item_differs({stage, program.system_of(stage).speed_item()});
        },
        [&](Call) {
            // An aggregate over the domain is a single number, even if its operand differs between
            // cells.
            if (info(node.function).is_aggregate) return false;
            return operand_differs ||
                   (varies_by_cell(node.function) && !differentiates(node.function));
        },
        [](auto) { return true; },
    };
    return std::visit(differs, node.kind);
}

IdVector<SpeciesId, ItemId> System::species() const {
    IdVector<SpeciesId, ItemId> species;
    std::ranges::copy_if(quantities.ids(), std::back_inserter(species),
                         [&](ItemId item) { return is_species(item); });
    return species;
}

bool System::is_complete() const {
    const auto has_rate = [&](ItemId item) { return !rates[item].nodes.empty(); };
    const auto has_formula = [](const Definition& each) { return !each.formula.nodes.empty(); };
    return std::ranges::all_of(species(), has_rate) &&
           std::ranges::all_of(definitions, has_formula);
}

std::optional<SpeciesId> System::species_of(ItemId item) const {
    const auto all = species();
    const auto found = std::ranges::find(all, item);
    if (found == all.end()) return std::nullopt;
    return SpeciesId(static_cast<std::size_t>(found - all.begin()));
}

std::vector<const Formula*> rules_of(const CellRules& cells) {
    std::vector<const Formula*> rules{&cells.divide, &cells.die, &cells.along};
    for (const Formula& restart : cells.restarts) rules.push_back(&restart);
    for (const Formula& distance : cells.near) rules.push_back(&distance);
    return rules;
}

std::string_view System::draw_name(ItemId item) const {
    const bool is_of_frame = cells && cells->has_component(item) && item >= cells->frame;
    return is_of_frame ? "frame" : item_name(item);
}

std::string_view System::item_name(ItemId item) const {
    if (item < quantities.next()) return quantities[item].name;
    CHECK(item <= speed_item(), "an item is a quantity, frozen or speed");
    return item == frozen_item() ? "frozen" : "speed";
}

}  // namespace cascade

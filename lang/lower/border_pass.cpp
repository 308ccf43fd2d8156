// Gives operators the values beyond the border of a mask, if these values differ from the value in
// the cell beside the border.
//
// The rules are the same as at the sides of the grid (spec/domain.md, "Beyond the sides"). A
// species, or a definition with its own rule for the border, has the value that this rule gives. A
// function is computed from the values of its operands beyond the border. Operators, shapes, draws
// and files are mirrored. There is no halo at the border, so the values beyond it are expressions
// of values in the cell beside the border. All neighbours outside the mask get the same values.
#include "lang/calculus/side_values.h"
#include "lang/lower/graph_passes.h"

#include <array>
#include <optional>
#include <unordered_map>
#include <utility>

namespace cascade::lowering {

namespace {

class Borders : public GraphPass {
public:
    Borders(const Expressions& from, const PassContext& context)
        : GraphPass(from, context),
          system_(context.program.system_of(context.stage)),
          species_(border_settings(context.program, context.stage)),
          definitions_(from.walls.begin(), from.walls.end()),
          flattening_(graph()) {}

private:
    /// The value beyond the border, and the value beyond two borders. The second value is used for
    /// a diagonal neighbour if both cells that are adjacent to it and to the present cell are
    /// outside.
    using Beyond = std::array<NodeId, 2>;

    NodeId image_of(const Node& node) override {
        Node reader = node;
        const bool is_at_faces = node.type == ValueType::vector || node.type == ValueType::tensor;
        for (std::size_t k = 0; k < node.operand_count; ++k) {
            const bool is_last = k + 1u == node.operand_count;
            const bool is_beside =
                is_at_faces || (is_last && node.is<Call>() && is_stencil(node.function));
            if (is_beside) reader.operands[k] = with_border(node.operands[k]);
        }
        const NodeId id = keep(reader);
        if (const auto beyond = beyond_of(id, node)) beyond_.emplace(id, *beyond);
        return id;
    }

    NodeId with_border(NodeId operand) {
        const auto found = beyond_.find(operand);
        if (found == beyond_.end()) return operand;
        const auto& [once, twice] = found->second;
        return bordered(term(operand), term(once), term(twice));
    }

    /// The values of a node beyond the border. nullopt if the node is mirrored.
    std::optional<Beyond> beyond_of(NodeId id, const Node& node) {
        const SideSetting* const rule = rule_of(node);
        if (rule != nullptr) {
            if (!takes_value(rule->kind)) return std::nullopt;
            const NodeId value = flattening_.add(rule->value);
            const NodeId once = across(*rule, value, id);
            return Beyond{once, across(*rule, value, once)};
        }
        if (!node.is<Call>() || node.type != ValueType::number || varies_by_cell(node.function) ||
            info(node.function).is_aggregate) {
            return std::nullopt;
        }
        Node once = node, twice = node;
        bool is_mirrored = true;
        for (std::size_t k = 0; k < node.operand_count; ++k) {
            const auto found = beyond_.find(node.operands[k]);
            if (found == beyond_.end()) continue;
            is_mirrored = false;
            once.operands[k] = found->second[0];
            twice.operands[k] = found->second[1];
        }
        if (is_mirrored) return std::nullopt;
        return Beyond{graph().add(once), graph().add(twice)};
    }

    /// The border rule of a species, or of a definition with its own rules; null for other nodes.
    const SideSetting* rule_of(const Node& node) const {
        constexpr auto border = static_cast<std::size_t>(Side::border);
        if (const auto wall = definitions_.find(at()); wall != definitions_.end()) {
            const Stage& stage = context().program.stages[context().stage];
            return &stage.definition_sides[wall->second].sides[border];
        }
        const auto* const item = node.as<ItemId>();
        const auto species = item != nullptr ? system_.species_of(*item) : std::nullopt;
        return species && !species_.empty() ? &species_[*species][border] : nullptr;
    }

    /// The value beyond the border. For a fixed value e it is 2e − c, and for a slope e it is c + h
    /// e, where c is `cell`. The value is rounded in the same way as in halos.
    NodeId across(const SideSetting& rule, NodeId value, NodeId cell) {
        if (rule.kind == SideKind::fixed) return leaf(2.0) * term(value) - term(cell);
        const Term spacing = leaf(context().grid().spacing);
        return term(cell) + spacing * term(value);
    }

    const System& system_;
    IdVector<SpeciesId, SideSettings> species_;
    /// The index in Stage::definition_sides, for each node of the old graph that has its own rules.
    std::unordered_map<NodeId, std::size_t> definitions_;
    Flattening flattening_;
    /// The values beyond the border, for each node of the new graph that is not mirrored.
    std::unordered_map<NodeId, Beyond> beyond_;
};

}  // namespace

Expressions find_beyond_border(const Expressions& from, const PassContext& context) {
    return Borders(from, context).run();
}

}  // namespace cascade::lowering

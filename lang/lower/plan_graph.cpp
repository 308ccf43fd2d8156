// Computes the facts about a node from facts about its operands.
//
// Values beyond the sides of the grid follow spec/domain.md, "Beyond the sides". The value of a
// species beyond a side follows from the species' rule for this side. The value of a function is
// computed from its operands' values beyond the side, so lap(f(u)) + lap(g) equals lap(f(u) + g) at
// the sides, too. Values of operators, random numbers, shapes, parameters and files are mirrored.
#include "lang/lower/plan_graph.h"

#include <algorithm>
#include <utility>

namespace cascade::lowering {

namespace {

using Axes3 = std::array<Beyond, 3>;

Beyond beyond_of(Boundary boundary) {
    return boundary == Boundary::periodic ? Beyond::periodic : Beyond::mirrored;
}

Axes3 beyond_of(const Boundaries& boundary) {
    return {beyond_of(boundary.x), beyond_of(boundary.y), beyond_of(boundary.z)};
}

/// How values beyond the two sides of an axis are found. Either both sides are periodic or neither
/// is.
Beyond beyond_of(SideKind first, SideKind second) {
    if (takes_value(first) || takes_value(second)) return Beyond::itself;
    return first == SideKind::periodic ? Beyond::periodic : Beyond::mirrored;
}

/// How values of an item beyond the sides of each axis are found. The item must vary by cell.
Axes3 beyond_of_item(const Program& program, std::uint32_t stage, ItemId item) {
    const SideKinds sides = side_kinds(program, stage, item);
    Axes3 beyond{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        beyond[axis] = beyond_of(sides[2 * axis], sides[2 * axis + 1]);
    }
    return beyond;
}

/// How values of a function of two operands beyond the sides of an axis are found, given the same
/// for each operand.
Beyond together(Beyond a, Beyond b) {
    if (a == Beyond::anything || a == b) return b;
    return b == Beyond::anything ? a : Beyond::itself;
}

}  // namespace

SideKinds side_kinds(const Program& program, std::uint32_t stage, ItemId item) {
    const auto& sides = program.stages[stage].sides;
    const auto species = sides.empty() ? std::nullopt : program.system_of(stage).species_of(item);
    const SideRules boundary(program.domain.grid.boundary);
    SideKinds kinds{};
    for (std::size_t side = 0; side < side_count; ++side) {
        kinds[side] = species ? sides[*species][side].kind : boundary.at[side].kind;
    }
    return kinds;
}

PlanGraph::PlanGraph(Expressions expressions, const PassContext& context, Draws draws)
    : expressions_(std::move(expressions)), context_(context) {
    walls_.insert(expressions_.walls.begin(), expressions_.walls.end());
    const auto is_uniform = uniform_nodes(expressions_.graph, context_);
    facts_.reserve(is_uniform.size());
    for (const NodeId id : is_uniform.ids()) {
        const Node& node = (*this)[id];
        facts_.push_back({is_uniform[id],
                          sides(id) == nullptr && is_step_invariant(node, is_uniform[id], draws),
                          beyond(id, is_uniform[id])});
    }
    names_.insert(expressions_.names.begin(), expressions_.names.end());
}

/// Whether the node has the same value in all steps. The positions of crawling cells change in each
/// step, and so does their number.
bool PlanGraph::is_step_invariant(const Node& node, bool is_uniform, Draws draws) const {
    if (context_.is_tissue() && !is_uniform) return false;
    const bool is_drawn_once = is_draw(node) && draws == Draws::once;
    if (changes_by_itself(node, context_) && !is_drawn_once) return false;
    return std::ranges::all_of(node.reads(),
                               [&](NodeId operand) { return facts_[operand].is_step_invariant; });
}

std::array<Beyond, 3> PlanGraph::beyond(NodeId id, bool is_uniform) const {
    const Node& node = (*this)[id];
    const Grid& grid = this->grid();
    Axes3 beyond{};
    if (is_uniform) return beyond;
    if (const auto* item = node.as<ItemId>()) {
        beyond = beyond_of_item(program(), stage(), *item);
    } else if (const auto* earlier = node.as<StageItem>()) {
        beyond = beyond_of_item(program(), earlier->stage, earlier->item);
    } else if (!node.is<Call>()) {
        beyond = beyond_of(grid.boundary);
    } else {
        const Axes3 usual = beyond_of(grid.boundary);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const NodeId operand : node.reads()) {
                beyond[axis] = together(beyond[axis], facts_[operand].beyond[axis]);
            }
            // Operators, shapes, draws and files are periodic if all their operands are periodic.
            if (!varies_by_cell(node.function)) continue;
            if (beyond[axis] == Beyond::anything) beyond[axis] = usual[axis];
            if (beyond[axis] == Beyond::itself) beyond[axis] = Beyond::mirrored;
        }
    }
    // A definition with its own rules at sides is stored in a plane, like a species.
    if (const DefinitionSides* own = sides(id)) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            beyond[axis] = beyond_of(own->sides[2 * axis].kind, own->sides[2 * axis + 1].kind);
        }
    }
    const Stencil stencil = grid.stencil();
    if (!stencil.x) beyond[0] = Beyond::anything;
    if (!stencil.y) beyond[1] = Beyond::anything;
    if (!stencil.z) beyond[2] = Beyond::anything;
    return beyond;
}

bool PlanGraph::is_open(NodeId id) const {
    return sides(id) == nullptr && std::ranges::count(facts_[id].beyond, Beyond::itself) > 0;
}

Boundaries PlanGraph::boundary(NodeId id) const {
    const auto along = [&](std::size_t axis, Boundary usual) {
        switch (facts_[id].beyond[axis]) {
            case Beyond::periodic: return Boundary::periodic;
            case Beyond::mirrored: return Boundary::no_flux;
            default: return usual;
        }
    };
    const Boundaries& usual = grid().boundary;
    return {along(0, usual.x), along(1, usual.y), along(2, usual.z)};
}

bool PlanGraph::is_plane(NodeId id) const {
    const Node& node = (*this)[id];
    if (is_uniform(id)) return false;
    if (const auto* item = node.as<ItemId>()) {
        return *item != program().system_of(stage()).frozen_item();
    }
    if (node.is<Call>()) return reads_file(node.function);
    return node.is<StageItem>() || node.is<SensedItem>() || node.is<MetricPlane>() ||
           node.is<ModelPlane>() || node.is<SurfaceValueId>() || node.is<LagPart>() ||
           node.is<Unknown>();
}

const DefinitionSides* PlanGraph::sides(NodeId id) const {
    const auto number = wall(id);
    return number ? &program().stages[stage()].definition_sides[*number] : nullptr;
}

std::optional<std::size_t> PlanGraph::wall(NodeId id) const {
    const auto found = walls_.find(id);
    return found == walls_.end() ? std::nullopt : std::optional(found->second);
}

const std::string& PlanGraph::name(NodeId id) const {
    static const std::string none;
    const auto found = names_.find(id);
    return found == names_.end() ? none : found->second;
}

const Origin* PlanGraph::origin(NodeId id) const {
    const std::uint32_t formula = expressions_.graph.written(id).formula;
    return formula == Written::nowhere ? nullptr : &expressions_.origins[formula];
}

}  // namespace cascade::lowering

// Makes the planner's decisions in one loop over the nodes, operands first.
#include "lang/lower/pass_planner.h"

#include "lang/program/calls.h"

#include <algorithm>
#include <bit>

namespace cascade::lowering {

namespace {

bool is_number(const Node& node) { return node.type == ValueType::number; }

}  // namespace

int operations_of(const Node& node) { return node.is<Call>() ? info(node.function).cost : 4; }

Offsets stand_ins(Offsets offsets) {
    Offsets all = own_cell;
    for (std::uint32_t number = 0; number < Offset::count; ++number) {
        if ((offsets >> number & 1) == 0) continue;
        const Offset offset = Offset::of(number);
        for (const Offset between :
             {Offset{0, offset.dy, offset.dz}, Offset{offset.dx, 0, offset.dz},
              Offset{offset.dx, offset.dy, 0}}) {
            if (between != offset) all |= only(between);
        }
    }
    return all;
}

PassPlanner::PassPlanner(const PlanGraph& graph, std::span<const NodeId> roots,
                         Materialise materialise, std::span<const NodeId> step_invariants)
    : graph_(graph),
      axes_(graph.grid().stencil()),
      materialise_(materialise),
      needed_(graph.size(), false),
      written_(graph.size(), false),
      step_invariant_(graph.size(), false),
      stays_(graph.size(), false),
      pass_(graph.size(), 0),
      beside_(graph.size(), 0) {
    for (const NodeId id : step_invariants) step_invariant_[id] = true;
    mark_needed(roots);
    for (const NodeId id : graph.ids()) {
        if (needed_[id] && !step_invariant_[id]) decide(id);
    }
    for (const NodeId root : roots) pass_count_ = std::max(pass_count_, pass_[root] + 1);
}

void PassPlanner::mark_needed(std::span<const NodeId> roots) {
    for (const NodeId root : roots) needed_[root] = true;
    for (const NodeId id : graph_.ids_backwards()) {
        if (!needed_[id] || step_invariant_[id]) continue;
        for (const NodeId operand : operands_of(graph_[id])) needed_[operand] = true;
    }
}

/// Whether computing the node at `places` neighbours would cost more than writing and reading a
/// plane. Stops visiting nodes once the answer is known.
bool PassPlanner::is_expensive(NodeId id, std::uint32_t places) const {
    std::uint32_t cost = 0;
    std::vector<NodeId> seen, open{id};
    while (!open.empty()) {
        const NodeId next = open.back();
        open.pop_back();
        if (written_[next] || graph_.is_uniform(next) || is_plane(next)) continue;
        if (std::find(seen.begin(), seen.end(), next) != seen.end()) continue;
        seen.push_back(next);
        const Node& node = graph_[next];
        cost += static_cast<std::uint32_t>(operations_of(node));
        if (cost * places > std::uint32_t{operations_of_writing}) return true;
        for (const NodeId operand : node.reads()) open.push_back(operand);
    }
    return false;
}

void PassPlanner::decide(NodeId id) {
    const Node& node = graph_[id];
    const Function function = node.function;
    if (!node.is<Call>()) {
        const System& system = graph_.program().system_of(graph_.stage());
        stays_[id] = node.is(system.frozen_item()) && !graph_.is_uniform(id);
        return;
    }
    const NodeId last = node.reads().back();
    if (solved_constraint(node)) {
        written_[id] = true;  // The node is computed before the first pass.
        return;
    }
    if (is_aggregate(node) || is_nonlocal(node)) {
        write_whole(last, id);
        pass_[id] = beside_[id] = is_plane(last) ? 0 : first_reader(last);
        written_[id] = is_nonlocal(node);
        return;
    }
    const bool differs = !graph_.is_uniform(id);
    if (differs && is_stencil(function) && graph_.is_linked()) {
        for (const NodeId operand : node.reads()) provide_over_links(operand, id);
    } else if (differs && is_stencil(function)) {
        provide(last, reach(offsets_of(node, axes_)) & ~own_cell, id);
    } else if (differs && (node.type == ValueType::vector || function == Function::div) &&
               !graph_.is_linked()) {
        // The operands of a vector at a face are needed in the cells on both sides of the face.
        for (const NodeId operand : node.reads()) {
            if (is_number(graph_[operand])) {
                provide(operand, crosswise(axes_) & ~own_cell, id);
            } else if (graph_[operand].type == ValueType::tensor) {
                for (const NodeId entry : graph_[operand].reads()) {
                    provide(entry, crosswise(axes_) & ~own_cell, id);
                }
            }
        }
    }
    decide_own(id);
}

/// Plans to store an operand in a plane because `reader` needs the whole plane. Does nothing if the
/// operand is already in a plane.
void PassPlanner::write_whole(NodeId operand, NodeId reader) {
    if (is_plane(operand) || written_[operand]) return;
    choices_.push_back({operand, reader, 0, true, true, false});
    written_[operand] = true;
}

/// Finds the first pass in which the values of a node are known. The node is computed from its
/// operands.
void PassPlanner::decide_own(NodeId id) {
    const Node& node = graph_[id];
    const Function function = node.function;
    const bool is_vector = node.type == ValueType::vector;
    const bool reads_beside = !graph_.is_uniform(id) && (is_stencil(function) || is_vector);
    stays_[id] =
        !graph_.is_uniform(id) &&
        (is_stencil(function) || function == Function::div ||
         (varies_by_cell(function) && !differentiates(function) && !reads_file(function)) ||
         graph_.sides(id) != nullptr);
    for (std::uint32_t k = 0; k < node.operand_count; ++k) {
        const NodeId operand = node.operands[k];
        const bool is_moved =
            reads_beside && (is_vector || k + 1 == node.operand_count || graph_.is_linked());
        pass_[id] = std::max(pass_[id], pass_[operand]);
        // For an open node, the planes are chosen later, where the node is read, because more nodes
        // may have been written by then.
        if (!graph_.is_open(id) && !graph_.is_open(operand)) {
            beside_[id] = std::max(beside_[id], pass_beside(operand));
        }
        const bool operand_stays = stays_[operand] && !written_[operand];
        stays_[id] = stays_[id] || (operand_stays && !graph_.is_uniform(id));
        if (is_moved) pass_[id] = std::max(pass_[id], pass_beside(operand));
    }
    if (is_vector) beside_[id] = pass_[id];
}

/// Calls visit(node) for the closed nodes from which an open node is recomputed at neighbours.
/// Closed nodes are nodes that are not open.
template <typename Visit>
void PassPlanner::for_each_closed(NodeId open, const Visit& visit) const {
    IdVector<NodeId, bool> seen(graph_.size(), false);
    std::vector<NodeId> left{open};
    while (!left.empty()) {
        const NodeId next = left.back();
        left.pop_back();
        if (seen[next] || graph_.is_uniform(next) || is_plane(next)) continue;
        seen[next] = true;
        const Node& node = graph_[next];
        if (!graph_.is_open(next)) {
            visit(next);
            continue;
        }
        for (const NodeId operand : node.reads()) left.push_back(operand);
    }
}

/// The first pass in which the values of an operand at neighbours are known.
std::uint32_t PassPlanner::pass_beside(NodeId operand) const {
    const Node& node = graph_[operand];
    std::uint32_t pass = 0;
    // Looks at each entry of the tensor, because entries may have been written for another reader.
    if (node.type == ValueType::tensor) {
        for (const NodeId entry : node.reads()) {
            pass = std::max(pass, pass_beside(entry));
        }
        return pass;
    }
    if (node.calls(Function::bordered)) {
        return std::max(pass_beside(node.operands[0]), pass_beside(node.operands[1]));
    }
    if (graph_.is_open(operand) && !is_plane(operand)) {
        for_each_closed(operand, [&](NodeId id) { pass = std::max(pass, pass_beside(id)); });
        return pass;
    }
    return written_[operand] ? first_reader(operand) : beside_[operand];
}

/// Decides how an operand is provided at neighbours: in a plane, or computed at the neighbours.
void PassPlanner::provide(NodeId operand, Offsets offsets, NodeId reader) {
    const auto places = static_cast<std::uint32_t>(std::popcount(offsets));
    if (places == 0 || graph_.is_uniform(operand) || is_plane(operand)) return;
    if (const Node& node = graph_[operand]; node.calls(Function::bordered)) {
        provide(node.operands[0], offsets, reader);
        // Differences along a face are taken in the cells on both sides of the face.
        const bool is_at_faces = graph_[reader].type == ValueType::vector;
        provide(node.operands[1], is_at_faces ? offsets : stand_ins(offsets) & ~own_cell, reader);
        return;
    }
    if (graph_.is_open(operand)) return provide_open(operand, offsets, reader);
    OperandChoice choice{operand, reader, places, false, stays_[operand], false};
    const bool wants = materialise_ == Materialise::always ||
                       (materialise_ == Materialise::when_cheaper && is_expensive(operand, places));
    choice.is_written = written_[operand] || stays_[operand] || wants;
    written_[operand] = choice.is_written;
    choices_.push_back(choice);
}

/// Writes an operand of a sum over links to a plane, from which the sum reads it.
void PassPlanner::provide_over_links(NodeId operand, NodeId reader) {
    if (graph_.is_uniform(operand) || is_plane(operand)) return;
    written_[operand] = true;
    choices_.push_back({operand, reader, 0, true, true, false});
}

/// Provides an open operand at neighbours, where it is recomputed from nodes that are, or can be,
/// in planes.
void PassPlanner::provide_open(NodeId operand, Offsets offsets, NodeId reader) {
    const auto places = static_cast<std::uint32_t>(std::popcount(offsets));
    for_each_closed(operand, [&](NodeId id) { provide(id, offsets, reader); });
    choices_.push_back({operand, reader, places, false, false, true});
}

}  // namespace cascade::lowering

// The planner's decisions: one loop over the parts, operands first.
#include "lang/lower/pass_planner.h"

#include <algorithm>
#include <bit>

namespace cascade::lowering {

namespace {

bool is_number(const Part& part) { return part.node.type == ValueType::number; }

}  // namespace

int operations_of(const Part& part) {
    return part.node.kind == NodeKind::call ? info(part.node.function).cost : 4;
}

Axes::Axes(const Grid& grid) {
    const Stencil stencil = grid.stencil();
    if (stencil.x) present.push_back(0);
    if (stencil.y) present.push_back(1);
    if (stencil.z) present.push_back(2);
}

Offsets Axes::crosswise() const {
    Offsets offsets = own_cell;
    for (const int axis : present) {
        offsets |= only(Offset::along(axis, 1)) | only(Offset::along(axis, -1));
    }
    return offsets;
}

bool Axes::has(int axis) const {
    return std::find(present.begin(), present.end(), axis) != present.end();
}

Offsets Axes::diagonal(int first, int second) const {
    if (!has(first) || !has(second)) return 0;
    Offsets offsets = 0;
    for (const int a : {-1, 1}) {
        for (const int b : {-1, 1})
            offsets |= only(Offset::along(first, a) + Offset::along(second, b));
    }
    return offsets;
}

Offsets Axes::pair(int axis) const {
    if (!has(axis)) return 0;
    return only(Offset::along(axis, 1)) | only(Offset::along(axis, -1));
}

Offsets with_stand_ins(Offsets offsets) {
    Offsets all = offsets | own_cell;
    for (std::uint32_t number = 0; number < Offset::count; ++number) {
        if ((offsets >> number & 1) == 0) continue;
        const Offset offset = Offset::of(number);
        for (const Offset between :
             {Offset{0, offset.dy, offset.dz}, Offset{offset.dx, 0, offset.dz},
              Offset{offset.dx, offset.dy, 0}}) {
            all |= only(between);
        }
    }
    return all;
}

Offsets stencil_offsets(const Part& stencil, const Axes& axes) {
    const auto [order, first, second] = derivative_of(stencil.node.function);
    if (order == 1) return axes.pair(first);
    if (order == 2)
        return first == second ? own_cell | axes.pair(first) : axes.diagonal(first, second);
    if (!stencil.calls(Function::diffuse)) return axes.crosswise();
    return own_cell | axes.pair(0) | axes.pair(1) | axes.diagonal(0, 1);
}

PassPlanner::PassPlanner(const PartGraph& graph, std::span<const PartId> roots,
                         Materialise materialise, std::span<const PartId> step_invariants)
    : graph_(graph),
      axes_(graph.program().domain.grid),
      materialise_(materialise),
      needed_(graph.size(), false),
      written_(graph.size(), false),
      step_invariant_(graph.size(), false),
      stays_(graph.size(), false),
      pass_(graph.size(), 0),
      beside_(graph.size(), 0) {
    for (const PartId id : step_invariants) step_invariant_[id] = true;
    mark_needed(roots);
    for (PartId id = 0; id < graph.size(); ++id) {
        if (needed_[id] && !step_invariant_[id]) decide(id);
    }
    for (const PartId root : roots) pass_count_ = std::max(pass_count_, pass_[root] + 1);
}

void PassPlanner::mark_needed(std::span<const PartId> roots) {
    for (const PartId root : roots) needed_[root] = true;
    for (PartId id = static_cast<PartId>(graph_.size()); id-- > 0;) {
        if (!needed_[id] || step_invariant_[id]) continue;
        const Part& part = graph_[id];
        for (std::uint32_t k = 0; k < part.operand_count; ++k) needed_[part.operands[k]] = true;
    }
}

/// Would computing the part at so many places take more than it is worth? Looks at no more parts
/// than that.
bool PassPlanner::is_expensive(PartId id, std::uint32_t places) const {
    std::uint32_t cost = 0;
    std::vector<PartId> seen, open{id};
    while (!open.empty()) {
        const PartId next = open.back();
        open.pop_back();
        if (written_[next] || graph_[next].is_uniform || is_plane(next)) continue;
        if (std::find(seen.begin(), seen.end(), next) != seen.end()) continue;
        seen.push_back(next);
        const Part& part = graph_[next];
        cost += static_cast<std::uint32_t>(operations_of(part));
        if (cost * places > std::uint32_t{operations_of_writing}) return true;
        for (std::uint32_t k = 0; k < part.operand_count; ++k) open.push_back(part.operands[k]);
    }
    return false;
}

void PassPlanner::decide(PartId id) {
    const Part& part = graph_[id];
    const Function function = part.node.function;
    if (part.node.kind != NodeKind::call) {
        const System& system = graph_.program().system_of(graph_.stage());
        const bool is_frozen = part.node.kind == NodeKind::own &&
                               part.node.index == system.frozen_item() && !part.is_uniform;
        stays_[id] = is_frozen;
        return;
    }
    const PartId last = part.operands[part.operand_count - 1];
    if (info(function).is_aggregate) {
        const bool written = !is_plane(last);
        if (written && !written_[last]) {
            choices_.push_back({last, id, 0, true, true, false});
            written_[last] = true;
        }
        pass_[id] = beside_[id] = written ? pass_[last] + 1 : 0;
        return;
    }
    const bool differs = !part.is_uniform;
    if (differs && is_stencil(function) && graph_.is_linked()) {
        for (std::uint32_t k = 0; k < part.operand_count; ++k)
            provide_over_links(part.operands[k], id);
    } else if (differs && is_stencil(function)) {
        provide(last, reach(stencil_offsets(part, axes_)) & ~own_cell, id);
    } else if (differs && (part.node.type == ValueType::vector || function == Function::div) &&
               !graph_.is_linked()) {
        // Vectors are known at faces, which takes what they are made of in the cells beside.
        for (std::uint32_t k = 0; k < part.operand_count; ++k) {
            const PartId operand = part.operands[k];
            if (is_number(graph_[operand])) {
                provide(operand, axes_.crosswise() & ~own_cell, id);
            } else if (graph_[operand].node.type == ValueType::tensor) {
                for (const PartId entry : std::span(graph_[operand].operands).first(3)) {
                    provide(entry, axes_.crosswise() & ~own_cell, id);
                }
            }
        }
    }
    decide_own(id);
}

/// When the values of a part are known that is computed from its operands.
void PassPlanner::decide_own(PartId id) {
    const Part& part = graph_[id];
    const Function function = part.node.function;
    const bool is_vector = part.node.type == ValueType::vector;
    const bool reads_beside = !part.is_uniform && (is_stencil(function) || is_vector);
    stays_[id] = !part.is_uniform &&
                 (is_stencil(function) || function == Function::div ||
                  (varies_by_cell(function) && !differentiates(function) && !reads_file(function)));
    for (std::uint32_t k = 0; k < part.operand_count; ++k) {
        const PartId operand = part.operands[k];
        const bool is_moved =
            reads_beside && (is_vector || k + 1 == part.operand_count || graph_.is_linked());
        pass_[id] = std::max(pass_[id], pass_[operand]);
        // Those of open parts are looked for where they are read: more may be written until then.
        if (!part.is_open() && !graph_[operand].is_open()) {
            beside_[id] = std::max(beside_[id], pass_beside(operand));
        }
        const bool operand_stays = stays_[operand] && !written_[operand];
        stays_[id] = stays_[id] || (operand_stays && !part.is_uniform);
        if (is_moved) pass_[id] = std::max(pass_[id], pass_beside(operand));
    }
    if (is_vector) beside_[id] = pass_[id];
}

/// Calls visit(part) for the parts, not open, that an open one is made of at neighbours.
template <typename Visit>
void PassPlanner::for_each_closed(PartId open, const Visit& visit) const {
    std::vector<bool> seen(graph_.size(), false);
    std::vector<PartId> left{open};
    while (!left.empty()) {
        const PartId next = left.back();
        left.pop_back();
        if (seen[next] || graph_[next].is_uniform || is_plane(next)) continue;
        seen[next] = true;
        const Part& part = graph_[next];
        if (!part.is_open()) {
            visit(next);
            continue;
        }
        for (std::uint32_t k = 0; k < part.operand_count; ++k) left.push_back(part.operands[k]);
    }
}

/// When the values of an operand are known that neighbours have.
std::uint32_t PassPlanner::pass_beside(PartId operand) const {
    const Part& part = graph_[operand];
    std::uint32_t pass = 0;
    if (part.node.type ==
        ValueType::tensor) {  // Its entries may have been written for another reader.
        for (const PartId entry : std::span(part.operands).first(part.operand_count)) {
            pass = std::max(pass, pass_beside(entry));
        }
        return pass;
    }
    if (part.is_open() && !is_plane(operand)) {
        for_each_closed(operand, [&](PartId id) { pass = std::max(pass, pass_beside(id)); });
        return pass;
    }
    return written_[operand] ? pass_[operand] + 1 : beside_[operand];
}

/// Makes an operand known at neighbours: by a plane, or by computing it there.
void PassPlanner::provide(PartId operand, Offsets offsets, PartId reader) {
    const auto places = static_cast<std::uint32_t>(std::popcount(offsets));
    if (places == 0 || graph_[operand].is_uniform || is_plane(operand)) return;
    if (graph_[operand].is_open()) return provide_open(operand, offsets, reader);
    OperandChoice choice{operand, reader, places, false, stays_[operand], false};
    const bool wants = materialise_ == Materialise::always ||
                       (materialise_ == Materialise::when_cheaper && is_expensive(operand, places));
    choice.is_written = written_[operand] || stays_[operand] || wants;
    written_[operand] = choice.is_written;
    choices_.push_back(choice);
}

/// Sums over links read planes.
void PassPlanner::provide_over_links(PartId operand, PartId reader) {
    if (graph_[operand].is_uniform || is_plane(operand)) return;
    written_[operand] = true;
    choices_.push_back({operand, reader, 0, true, true, false});
}

/// Computes an operand at neighbours from the parts that have planes, or can have them.
void PassPlanner::provide_open(PartId operand, Offsets offsets, PartId reader) {
    const auto places = static_cast<std::uint32_t>(std::popcount(offsets));
    for_each_closed(operand, [&](PartId id) { provide(id, offsets, reader); });
    choices_.push_back({operand, reader, places, false, false, true});
}

}  // namespace cascade::lowering

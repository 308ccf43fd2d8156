// The planner's decisions: one loop over the parts, operands first.
#include "lang/pass_planner.h"

#include <algorithm>
#include <bit>

namespace cascade::lowering {

namespace {

/// An operand is recomputed at neighbours where that takes at most so many operations for a cell.
/// Writing a plane, filling its halo and reading it again moves some twelve bytes a cell through
/// memory, in which time a core computes about as many.
constexpr double most_recomputed_operations = 40;

/// About how many operations of a kernel a function takes.
double cost_of(Function function) {
    switch (function) {
        case Function::add:
        case Function::subtract:
        case Function::multiply:
        case Function::negate:
        case Function::abs:
        case Function::if_:
        case Function::less:
        case Function::less_equal:
        case Function::greater:
        case Function::greater_equal:
        case Function::equal:
        case Function::not_equal:
        case Function::logical_and:
        case Function::logical_or:
        case Function::logical_not:
        case Function::step: return 1;
        case Function::power:  // By a small whole number, most often.
        case Function::min:
        case Function::max:
        case Function::divide:
        case Function::sqrt: return 4;
        default: return 20;
    }
}

bool is_number(const Part& part) { return part.node.type == ValueType::number; }

}  // namespace

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
        for (const int b : {-1, 1}) offsets |= only(Offset::along(first, a) + Offset::along(second, b));
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
        for (const Offset between : {Offset{0, offset.dy, offset.dz}, Offset{offset.dx, 0, offset.dz},
                                     Offset{offset.dx, offset.dy, 0}}) {
            all |= only(between);
        }
    }
    return all;
}

Offsets stencil_offsets(const Part& stencil, const Axes& axes) {
    switch (stencil.node.function) {
        case Function::dx: return axes.pair(0);
        case Function::dy: return axes.pair(1);
        case Function::dz: return axes.pair(2);
        case Function::dxx: return own_cell | axes.pair(0);
        case Function::dyy: return own_cell | axes.pair(1);
        case Function::dzz: return own_cell | axes.pair(2);
        case Function::dxy: return axes.diagonal(0, 1);
        case Function::dxz: return axes.diagonal(0, 2);
        case Function::dyz: return axes.diagonal(1, 2);
        case Function::diffuse:
            return own_cell | axes.pair(0) | axes.pair(1) | axes.diagonal(0, 1);
        default: return axes.crosswise();
    }
}

PassPlanner::PassPlanner(const PartGraph& graph, std::span<const PartId> roots, Bringing bringing)
    : graph_(graph),
      axes_(graph.program().domain.grid),
      bringing_(bringing),
      needed_(graph.size(), false),
      written_(graph.size(), false),
      stays_(graph.size(), false),
      pass_(graph.size(), 0),
      beside_(graph.size(), 0) {
    // A plane's halo mirrors, and what a species is beyond a side with a value it does not know.
    const Stage& stage = graph.program().stages[graph.stage()];
    if (!stage.sides.empty()) bringing_ = Bringing::recomputing;
    mark_needed(roots);
    for (PartId id = 0; id < graph.size(); ++id) {
        if (needed_[id]) decide(id);
    }
    for (const PartId root : roots) pass_count_ = std::max(pass_count_, pass_[root] + 1);
}

void PassPlanner::mark_needed(std::span<const PartId> roots) {
    for (const PartId root : roots) needed_[root] = true;
    for (PartId id = static_cast<PartId>(graph_.size()); id-- > 0;) {
        if (!needed_[id]) continue;
        const Part& part = graph_[id];
        for (std::uint32_t k = 0; k < part.operand_count; ++k) needed_[part.operands[k]] = true;
    }
}

/// Species, parameters that vary and files lie in planes from the start.
bool PassPlanner::is_plane(PartId id) const {
    const Part& part = graph_[id];
    if (part.is_uniform) return false;
    const System& system = graph_.program().system_of(graph_.stage());
    switch (part.node.kind) {
        case NodeKind::own: return part.node.index != system.frozen_item();
        case NodeKind::earlier:
        case NodeKind::metric: return true;
        case NodeKind::call: return reads_file(part.node.function);
        default: return false;
    }
}

/// Would computing the part at so many places take more than it is worth? Looks at no more parts
/// than that.
bool PassPlanner::is_dear(PartId id, std::uint32_t places) const {
    double cost = 0;
    std::vector<PartId> seen, open{id};
    while (!open.empty()) {
        const PartId next = open.back();
        open.pop_back();
        if (written_[next] || graph_[next].is_uniform || is_plane(next)) continue;
        if (std::find(seen.begin(), seen.end(), next) != seen.end()) continue;
        seen.push_back(next);
        const Part& part = graph_[next];
        cost += part.node.kind == NodeKind::call ? cost_of(part.node.function) : 4;
        if (cost * places > most_recomputed_operations) return true;
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
            brought_.push_back({last, id, 0, true, true});
            written_[last] = true;
        }
        pass_[id] = beside_[id] = written ? pass_[last] + 1 : 0;
        return;
    }
    const bool differs = !part.is_uniform;
    if (differs && is_stencil(function)) {
        bring(last, reach(stencil_offsets(part, axes_)) & ~own_cell, id);
    } else if (differs && (part.node.type == ValueType::vector || function == Function::div)) {
        // Vectors are known at faces, which takes what they are made of in the cells beside.
        for (std::uint32_t k = 0; k < part.operand_count; ++k) {
            const PartId operand = part.operands[k];
            if (is_number(graph_[operand])) {
                bring(operand, axes_.crosswise() & ~own_cell, id);
            } else if (graph_[operand].node.type == ValueType::tensor) {
                for (const PartId entry : std::span(graph_[operand].operands).first(3)) {
                    bring(entry, axes_.crosswise() & ~own_cell, id);
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
                  (varies_by_cell(function) && !differentiates(function) &&
                   !reads_file(function)));
    for (std::uint32_t k = 0; k < part.operand_count; ++k) {
        const PartId operand = part.operands[k];
        const bool is_moved = reads_beside && (is_vector || k + 1 == part.operand_count);
        pass_[id] = std::max(pass_[id], pass_[operand]);
        beside_[id] = std::max(beside_[id], pass_beside(operand));
        const bool operand_stays = stays_[operand] && !written_[operand];
        stays_[id] = stays_[id] || (operand_stays && !part.is_uniform);
        if (is_moved) pass_[id] = std::max(pass_[id], pass_beside(operand));
    }
    if (is_vector) beside_[id] = pass_[id];
}

/// When the values of an operand are known that neighbours have.
std::uint32_t PassPlanner::pass_beside(PartId operand) const {
    if (written_[operand]) return pass_[operand] + 1;
    const Part& part = graph_[operand];
    if (part.node.type != ValueType::tensor) return beside_[operand];
    std::uint32_t pass = 0;  // Its entries may have been written for another reader.
    for (const PartId entry : std::span(part.operands).first(part.operand_count)) {
        pass = std::max(pass, written_[entry] ? pass_[entry] + 1 : beside_[entry]);
    }
    return pass;
}

/// Makes an operand known at neighbours: by a plane, or by computing it there.
void PassPlanner::bring(PartId operand, Offsets offsets, PartId reader) {
    const auto places = static_cast<std::uint32_t>(std::popcount(offsets));
    if (places == 0 || graph_[operand].is_uniform || is_plane(operand)) return;
    Brought brought{operand, reader, places, false, stays_[operand]};
    const bool wants = bringing_ == Bringing::writing ||
                       (bringing_ == Bringing::cheaper && is_dear(operand, places));
    brought.is_written = written_[operand] || stays_[operand] || wants;
    written_[operand] = brought.is_written;
    brought_.push_back(brought);
}

}  // namespace cascade::lowering

// The two walks through the parts of a pass.
#include "lang/lower/lower_pass.h"

#include "core/check.h"

#include <bit>

namespace cascade::lowering {

namespace {

bool is_vector(const Part& part) { return part.node.type == ValueType::vector; }

/// Calls visit(offset) for every offset of a set.
template <typename Visit>
void for_each_offset(Offsets offsets, const Visit& visit) {
    for (; offsets != 0; offsets &= offsets - 1) {
        visit(Offset::of(static_cast<std::uint32_t>(std::countr_zero(offsets))));
    }
}

template <typename Visit>
void for_each_face(std::uint32_t faces, const Visit& visit) {
    for (; faces != 0; faces &= faces - 1) {
        visit(Face::of(static_cast<std::uint32_t>(std::countr_zero(faces))));
    }
}

}  // namespace

int entry_of_tensor(int row, int column) {
    if (row > 1 || column > 1) return -1;
    return row + column;
}

PassLowering::PassLowering(const PartGraph& graph, const PassPlanner& planner,
                           const Storage& storage, std::uint32_t pass, KernelAssembly& assembly)
    : graph_(graph),
      planner_(planner),
      storage_(storage),
      pass_(pass),
      assembly_(assembly),
      builder_(assembly.builder()),
      grid_(graph.program().domain.grid),
      needs_(graph.size(), 0),
      first_(graph.size(), 0) {}

void PassLowering::compute(std::span<const PartId> wanted) {
    for (const PartId id : wanted) need(id, own_cell);
    for (PartId id = static_cast<PartId>(graph_.size()); id-- > 0;) {
        if (needs_[id] == 0) continue;
        // What is the same in all cells is computed once.
        if (graph_[id].is_uniform && !is_vector(graph_[id])) needs_[id] = own_cell;
        // An open part may be read from its plane in the own cell and computed beside it.
        const bool is_read = is_source(id, own_cell) && !is_vector(graph_[id]);
        const std::uint32_t computed = is_read ? needs_[id] & ~own_cell : needs_[id];
        if (computed != 0 && !is_source(id, needs_[id])) need_operands(id, computed);
    }
    make_room();
    for (PartId id = 0; id < graph_.size(); ++id) {
        if (needs_[id] != 0) compute_part(id);
    }
}

/// Has an earlier pass written the part? The planes of open parts have no halo.
bool PassLowering::is_plane_at(PartId id, Offsets where) const {
    return planner_.is_plane_in(id, pass_) && (where == own_cell || !graph_[id].is_open());
}

/// Written and step-invariant parts are read from their planes, aggregates from their numbers.
bool PassLowering::is_source(PartId id, Offsets where) const {
    const Part& part = graph_[id];
    const bool is_aggregate =
        part.node.kind == NodeKind::call && info(part.node.function).is_aggregate;
    return is_aggregate || planner_.is_step_invariant(id) || is_plane_at(id, where);
}

void PassLowering::need_operands(PartId id, std::uint32_t where) {
    const Part& part = graph_[id];
    if (part.node.kind != NodeKind::call) return;
    if (is_vector(part)) return need_of_vector(part, where);
    if (part.calls(Function::div)) {
        for (const int axis : planner_.axes().present) {
            for (const int side : {0, 1}) {
                need(part.operands[0], std::uint32_t{1} << Face{axis, axis, side}.number());
            }
        }
        return;
    }
    if (is_stencil(part.node.function)) return need_of_stencil(part);
    for (std::uint32_t k = 0; k < part.operand_count; ++k) need(part.operands[k], where);
}

void PassLowering::need_of_stencil(const Part& part) {
    const std::uint32_t last = part.operand_count - 1;
    for (std::uint32_t k = 0; k < last; ++k) need(part.operands[k], own_cell);
    const PartId operand = part.operands[last];
    if (graph_[operand].is_uniform) return;
    if (graph_.is_linked()) return need(operand, own_cell);
    const bool reads_plane =
        part.calls(Function::lap) && !graph_.has_mask() && can_read_as_plane(operand);
    need(operand, reads_plane ? own_cell : planner_.reach(stencil_offsets(part, planner_.axes())));
}

/// The two cells beside each face.
void PassLowering::need_at_faces(PartId operand, std::uint32_t faces) {
    for_each_face(faces, [&](Face face) { need(operand, only(face.cell()) | only(face.next())); });
}

void PassLowering::need_of_vector(const Part& part, std::uint32_t faces) {
    if (part.calls(Function::vector)) {
        for_each_face(faces, [&](Face face) {
            if (static_cast<std::uint32_t>(face.component) >= part.operand_count) return;
            need(part.operands[static_cast<std::size_t>(face.component)],
                 only(face.cell()) | only(face.next()));
        });
        return;
    }
    if (part.calls(Function::grad)) {
        for_each_face(faces, [&](Face face) {
            if (!planner_.axes().has(face.component)) return;
            Offsets offsets = only(face.cell()) | only(face.next());
            if (face.component != face.axis) {
                offsets = 0;
                for (const int by : {-1, 1}) {
                    const Offset beside = Offset::along(face.component, by);
                    offsets |= only(face.cell() + beside) | only(face.next() + beside);
                }
            }
            need(part.operands[0], planner_.reach(offsets));
        });
        return;
    }
    for (std::uint32_t k = 0; k < part.operand_count; ++k) {
        const PartId operand = part.operands[k];
        if (!is_vector(graph_[operand])) {
            need_at_faces(operand, faces);
            continue;
        }
        std::uint32_t needed = faces;
        if (part.calls(Function::multiply) &&
            graph_[part.operands[0]].node.type == ValueType::tensor) {
            needed = 0;
            for_each_face(faces, [&](Face face) {
                for (int component = 0; component < 2; ++component) {
                    if (face.component > 1) return;
                    needed |= std::uint32_t{1} << Face{face.axis, component, face.side}.number();
                }
            });
        }
        need(operand, needed);
    }
}

void PassLowering::make_room() {
    std::size_t count = 0;
    for (PartId id = 0; id < graph_.size(); ++id) {
        first_[id] = static_cast<std::uint32_t>(count);
        count += static_cast<std::size_t>(std::popcount(needs_[id]));
    }
    values_.resize(count);
}

Value& PassLowering::slot(PartId id, std::uint32_t where) {
    CHECK((needs_[id] >> where & 1) != 0, "lowering: what is read was needed");
    const std::uint32_t before = needs_[id] & ((std::uint32_t{1} << where) - 1);
    return values_[first_[id] + static_cast<std::size_t>(std::popcount(before))];
}

const Value& PassLowering::at(PartId id, Offset offset) const {
    const std::uint32_t where = graph_[id].is_uniform ? Offset{}.number() : offset.number();
    return const_cast<PassLowering*>(this)->slot(id, where);
}

ValueId PassLowering::face(PartId id, Face face) const {
    return const_cast<PassLowering*>(this)->slot(id, face.number())[0];
}

void PassLowering::compute_part(PartId id) {
    const Part& part = graph_[id];
    const auto first = static_cast<ValueId>(builder_.size());
    if (is_vector(part)) {
        for_each_face(needs_[id],
                      [&](Face face) { slot(id, face.number()) = {vector_at(id, face)}; });
        if (part.is_step_invariant) builder_.keep_from(first);
        return;
    }
    for_each_offset(needs_[id], [&](Offset offset) {
        assembly_.look_at(offset);
        Value value{};
        if (is_source(id, only(offset))) {
            value = {source(id)};
        } else if (part.calls(Function::div)) {
            value = {divergence(part)};
        } else if (part.node.kind == NodeKind::call && is_stencil(part.node.function)) {
            value = {stencil(id)};
        } else {
            value = plain(id, offset);
        }
        slot(id, offset.number()) = value;
        assembly_.look_at({});
        // It may lie in a plane, or be computed again by whoever reads it.
        builder_.keep(value[0]);
    });
    // What no step changes may be computed once, without contraction.
    if (part.is_step_invariant) builder_.keep_from(first);
}

ValueId PassLowering::source(PartId id) {
    const bool is_step_invariant = planner_.is_step_invariant(id);
    if (is_step_invariant && graph_[id].is_uniform)
        return assembly_.step_invariant_number(storage_.step_invariants[id]);
    const bool is_written = planner_.is_plane_in(id, pass_);
    if (is_step_invariant || is_written) return assembly_.beside(slot_of_own_plane(id));
    return assembly_.aggregate(storage_.aggregate[id]);
}

Value PassLowering::plain(PartId id, Offset offset) {
    static const Noise no_noise;
    const Part& part = graph_[id];
    KernelAssembly::Cursor cursor{graph_, part, part.noise ? *part.noise : no_noise, {}, part.draw};
    for (std::uint32_t k = 0; k < part.operand_count; ++k) {
        cursor.values[k] = at(part.operands[k], offset);
    }
    // A tensor is its three entries.
    if (part.calls(Function::tensor)) {
        return {cursor.values[0][0], cursor.values[1][0], cursor.values[2][0]};
    }
    return assembly_.part(cursor);
}

}  // namespace cascade::lowering

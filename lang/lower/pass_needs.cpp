// Finds, readers first, where a pass needs the operands of its nodes.
#include "lang/lower/lower_pass.h"

namespace cascade::lowering {

namespace {

bool is_vector(const Node& node) { return node.type == ValueType::vector; }

class NeedFinder {
public:
    explicit NeedFinder(const PassView& pass)
        : pass_(pass), graph_(pass.graph), planner_(pass.planner), needs_(graph_.size(), 0) {}

    Needs run(std::span<const NodeId> wanted) && {
        for (const NodeId id : wanted) need(id, own_cell);
        for (const NodeId id : needs_.ids_backwards()) {
            if (needs_[id] == 0) continue;
            // A uniform value is computed once.
            if (graph_.is_uniform(id) && !is_vector(graph_[id])) needs_[id] = own_cell;
            // An open node may be read from its plane in the cell itself and recomputed at
            // neighbours.
            const bool is_read = pass_.is_source(id, own_cell) && !is_vector(graph_[id]);
            const std::uint32_t computed = is_read ? needs_[id] & ~own_cell : needs_[id];
            if (computed != 0 && !pass_.is_source(id, needs_[id])) need_operands(id, computed);
        }
        return std::move(needs_);
    }

private:
    void need(NodeId id, std::uint32_t where) { needs_[id] |= where; }

    /// The value at neighbours, with what replaces it outside of the domain.
    void need_beside(NodeId id, Offsets offsets) {
        need(id, planner_.reach(offsets));
        const Node& node = graph_[id];
        if (!node.calls(Function::bordered)) return;
        need(node.operands[1], stand_ins(offsets));
        need(node.operands[2], own_cell);
    }

    void need_operands(NodeId id, std::uint32_t where) {
        const Node& node = graph_[id];
        if (is_vector(node)) return need_of_vector(node, where);
        if (node.calls(Function::div)) {
            for (const int axis : planner_.axes().present) {
                for (const int side : {0, 1}) {
                    need(node.operands[0], std::uint32_t{1} << Face{axis, axis, side}.number());
                }
            }
            return;
        }
        if (node.is<Call>() && is_stencil(node.function)) return need_of_stencil(node);
        if (node.calls(Function::bordered)) return need(node.operands[0], where);
        for (const NodeId operand : node.reads()) need(operand, where);
    }

    void need_of_stencil(const Node& node) {
        const NodeId last = node.reads().back();
        for (const NodeId operand : node.reads().first(node.operand_count - 1u)) {
            need(operand, own_cell);
        }
        if (node.calls(Function::theirs)) {
            if (graph_.is_uniform(last)) need(last, own_cell);
            return;
        }
        if (graph_.is_uniform(last)) return;
        const bool reads_plane =
            graph_.is_linked() ||
            (node.calls(Function::lap) && !graph_.has_mask() && pass_.can_read_as_plane(last));
        if (reads_plane) return need(last, own_cell);
        need_beside(last, stencil_offsets(node, planner_.axes()));
    }

    /// The two cells beside each face.
    void need_at_faces(NodeId operand, std::uint32_t faces) {
        if (graph_[operand].type == ValueType::tensor) {
            for (const NodeId entry : graph_[operand].reads()) need_at_faces(entry, faces);
            return;
        }
        for_each_face(faces, [&](Face face) {
            need_beside(operand, only(face.cell()) | only(face.next()));
        });
    }

    void need_of_gradient(NodeId operand, Face face) {
        if (!planner_.axes().has(face.component)) return;
        Offsets offsets = only(face.cell()) | only(face.next());
        if (face.component != face.axis) {
            offsets = 0;
            for (const int by : {-1, 1}) {
                const Offset beside = Offset::along(face.component, by);
                offsets |= only(face.cell() + beside) | only(face.next() + beside);
            }
        }
        need_beside(operand, offsets);
    }

    void need_of_vector(const Node& node, std::uint32_t faces) {
        if (node.calls(Function::vector)) {
            for_each_face(faces, [&](Face face) {
                const auto component = static_cast<std::size_t>(face.component);
                if (component >= node.operand_count) return;
                need_beside(node.operands[component], only(face.cell()) | only(face.next()));
            });
            return;
        }
        if (node.calls(Function::grad)) {
            for_each_face(faces, [&](Face face) { need_of_gradient(node.operands[0], face); });
            return;
        }
        const bool by_tensor =
            node.calls(Function::multiply) && graph_[node.operands[0]].type == ValueType::tensor;
        for (const NodeId operand : node.reads()) {
            if (!is_vector(graph_[operand])) {
                need_at_faces(operand, faces);
            } else if (!by_tensor) {
                need(operand, faces);
            } else {
                const int size = tensor_size(graph_[node.operands[0]]);
                for_each_face(faces, [&](Face face) {
                    if (face.component >= size) return;
                    for (int component = 0; component < size; ++component) {
                        const Face at{face.axis, component, face.side};
                        need(operand, std::uint32_t{1} << at.number());
                    }
                });
            }
        }
    }

    const PassView& pass_;
    const PlanGraph& graph_;
    const PassPlanner& planner_;
    Needs needs_;
};

}  // namespace

Needs needs_of(const PassView& pass, std::span<const NodeId> wanted) {
    return NeedFinder(pass).run(wanted);
}

}  // namespace cascade::lowering

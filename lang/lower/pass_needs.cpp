// Finds the cells and faces in which a pass needs the operands of its nodes. Each node is visited
// before its operands.
#include "lang/lower/lower_pass.h"
#include "lang/program/vector_functions.h"

#include <span>

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
            // A uniform value is computed once, and only for the cell itself.
            if (graph_.is_uniform(id) && !is_vector(graph_[id])) needs_[id] = own_cell;
            // An open node may be read from its plane in the cell itself, and be recomputed at
            // neighbours.
            const bool is_read = pass_.is_source(id, own_cell) && !is_vector(graph_[id]);
            const std::uint32_t computed = is_read ? needs_[id] & ~own_cell : needs_[id];
            if (computed != 0 && !pass_.is_source(id, needs_[id])) need_operands(id, computed);
        }
        return std::move(needs_);
    }

private:
    void need(NodeId id, std::uint32_t where) { needs_[id] |= where; }

    /// Marks a node as needed at neighbours, and at the cells that stand in for neighbours outside
    /// the domain.
    void need_beside(NodeId id, Offsets offsets) {
        need(id, planner_.reach(offsets));
        const Node& node = graph_[id];
        if (!node.calls(Function::bordered)) return;
        need(node.operands[1], stand_ins(offsets));
        need(node.operands[2], own_cell);
    }

    void need_operands(NodeId id, std::uint32_t where) {
        const Node& node = graph_[id];
        if (is_vector(node)) {
            return for_each_face(where, [&](Face face) {
                vector_by(AtFace{*this, face}, graph_, node);
            });
        }
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
            if (!graph_[operand].calls(Function::tensor_weights)) need(operand, own_cell);
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
        need_beside(last, offsets_of(node, planner_.axes()));
    }

    /// Marks what a component of a vector needs at a face: numbers in the two cells beside the
    /// face, and vectors at the face itself.
    struct AtFace {
        NeedFinder& own;
        Face where;

        void number(NodeId id) const {
            own.need_beside(id, only(where.cell()) | only(where.next()));
        }
        void flow(NodeId vector, int component) const {
            const Face at{where.axis, component, where.side};
            own.need(vector, std::uint32_t{1} << at.number());
        }
        void flow(NodeId vector) const { flow(vector, where.component); }

        void gradient(NodeId of) const {
            if (where.component == where.axis) return number(of);
            Offsets offsets = 0;
            const Taps taps = taps_of(Difference::central, own.planner_.axes(), where.component);
            for (const Tap& tap : taps.taps) {
                offsets |= only(where.cell() + tap.at) | only(where.next() + tap.at);
            }
            if (offsets != 0) own.need_beside(of, offsets);
        }
        void components(std::span<const NodeId> parts) const {
            const auto component = static_cast<std::size_t>(where.component);
            if (component < parts.size()) number(parts[component]);
        }
        void negative(NodeId vector) const { flow(vector); }
        void sum(NodeId a, NodeId b) const { flow(a), flow(b); }
        void difference(NodeId a, NodeId b) const { sum(a, b); }
        void quotient(NodeId vector, NodeId by) const { flow(vector), number(by); }
        void product(NodeId a, NodeId b, bool is_vector_first) const {
            quotient(is_vector_first ? a : b, is_vector_first ? b : a);
        }
        void turned(NodeId tensor, NodeId vector) const {
            for (const NodeId entry : own.graph_[tensor].reads()) number(entry);
            const int size = tensor_size(own.graph_[tensor]);
            for (int k = 0; k < size && where.component < size; ++k) flow(vector, k);
        }
    };

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

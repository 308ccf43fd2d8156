// Checks sums over neighbours in systems of crawling cells.
//
// Inside sum(e over touching), names mean the neighbour's values, own(e) means the cell's value,
// and values of the link between the two cells can be read. So the meaning of a name depends on
// where the name is read. A function may read its argument both inside and outside such a sum, so
// all nodes are checked after the whole expression has been read.
#include "lang/check/expressions/expression_checker.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade::checking {

namespace {

/// In which ways other nodes read a node.
struct ReadBy {
    bool by_cell = false;  ///< Whether the node is read as the value of the cell.
    /// Whether the node is read as the value of a neighbour, in a sum over neighbours.
    bool by_link = false;
    bool as_distance = false;  ///< Whether the node is read as the distance in near(d).
};

bool may_differ_by_cell(const Node& node, const System& system) {
    if (const auto* item = node.as<ItemId>()) return system.is_species(*item);
    if (node.is<Builtin>()) return !node.is(Builtin::t) && !node.is(Builtin::step);
    return node.is<CellValue>() || node.is<Rate>();
}

}  // namespace

/// Checks own(e) and sums over neighbours.
void ExpressionChecker::check_link(Node& node) {
    const Node& operand = formula_.nodes[node.operands[0]];
    if (node.operand_count == 2) need(node.operands[1], ValueType::number);
    const bool takes_vectors = info(node.function).result == ResultKind::like;
    if (operand.type != ValueType::vector || !takes_vectors) {
        return need(node.operands[0], ValueType::number);
    }
    node.type = ValueType::vector;
}

/// Whether every node has a value where the formula reads it: in a cell, on a link or as a
/// distance. Reports an error if not.
bool ExpressionChecker::has_places(NodeId root) {
    IdVector<NodeId, ReadBy> readers(root.index() + 1);
    readers[root].by_cell = true;
    bool has_places = true;
    const auto refuse = [&](NodeId id, std::string message, std::string hint) {
        if (expanded_ != nullptr) work_.call = expanded_->calls[id.index()];
        error(formula_.nodes[id].span, std::move(message), std::move(hint));
        has_places = false;
    };
    const System& system = work_.program.systems[scope_.system];
    for (const NodeId id : readers.ids_backwards()) {
        const ReadBy read = readers[id];
        if (!read.by_cell && !read.by_link && !read.as_distance) continue;
        const Node& node = formula_.nodes[id];
        if (read.as_distance && may_differ_by_cell(node, system)) {
            refuse(id, "the distance of 'near' must be one number for all cells",
                   "only a number or a parameter can be used here");
        } else if (const auto* value = node.as<CellValue>();
                   value != nullptr && is_of_link(*value) && read.by_cell) {
            const std::string_view name = cell_value_names[static_cast<std::size_t>(*value)];
            refuse(id,
                   fmt::format("'{}' belongs to a pair of cells, so it can be used only in "
                               "sums over neighbours",
                               name),
                   fmt::format("for example, sum({} over touching)", name));
        }
        const bool is_own = node.calls(Function::own);
        if (is_own && read.by_cell) {
            refuse(id, "own(e) can be used only in sums over neighbours",
                   "leave own(…) out: outside of such sums, names already belong to the cell "
                   "itself");
        }
        for (std::size_t k = 0; k < node.operand_count; ++k) {
            ReadBy& operand = readers[node.operands[k]];
            if (is_over_neighbours(node.function)) {
                (k == 0 ? operand.by_link : operand.as_distance) = true;
            } else if (is_aggregate(node) || (is_own && read.by_link)) {
                operand.by_cell = true;
            } else {
                operand.by_cell |= read.by_cell;
                operand.by_link |= read.by_link;
                operand.as_distance |= read.as_distance;
            }
        }
    }
    return has_places;
}

}  // namespace cascade::checking

// What cells that crawl read of their neighbours.
//
// Inside of sum(e over touching) names are the neighbour's, own(e) is the cell's, and there are
// values of the link between both. What a name means depends on where it is read: the argument of a
// function may be read in both ways. So all nodes are checked when the whole expression is known.
#include "lang/check/expressions/expression_checker.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade::checking {

namespace {

/// How a node is read.
struct ReadBy {
    bool by_cell = false;      ///< As the cell's value.
    bool by_link = false;      ///< As a neighbour's, inside of a sum over neighbours.
    bool as_distance = false;  ///< For near(d).
};

bool may_differ_by_cell(const Node& node, const System& system) {
    if (const auto* item = node.as<ItemId>()) return system.is_species(*item);
    if (node.is<Builtin>()) return !node.is(Builtin::t) && !node.is(Builtin::step);
    return node.is<CellValue>() || node.is<Rate>();
}

}  // namespace

/// own(e) and sums over neighbours.
void ExpressionChecker::check_link(Node& node) {
    const Node& operand = formula_.nodes[node.operands[0]];
    if (node.operand_count == 2) need(node.operands[1], ValueType::number);
    const bool takes_vectors = info(node.function).result == ResultKind::like;
    if (operand.type != ValueType::vector || !takes_vectors) {
        return need(node.operands[0], ValueType::number);
    }
    node.type = ValueType::vector;
}

/// Is everything read where it has a value? Reports errors.
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
            refuse(id, "the distance of 'near' is the same for all cells",
                   "a number or a parameter can stand here");
        } else if (const auto* value = node.as<CellValue>();
                   value != nullptr && is_of_link(*value) && read.by_cell) {
            const std::string_view name = cell_value_names[static_cast<std::size_t>(*value)];
            refuse(id, fmt::format("'{}' is of two cells and known inside of sums only", name),
                   fmt::format("sum({} over touching)", name));
        }
        const bool is_own = node.calls(Function::own);
        if (is_own && read.by_cell) {
            refuse(id, "own(e) has a meaning inside of sums over neighbours only",
                   "names outside are the cell's own");
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

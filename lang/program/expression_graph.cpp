// Finds equal nodes by a hash. The hash depends only on members that are equal in equal nodes.
#include "lang/program/expression_graph.h"

#include "core/overloaded.h"

#include <algorithm>
#include <bit>

namespace cascade {

namespace {

std::uint64_t mix(std::uint64_t hash, std::uint64_t word) {
    return (hash ^ word) * 0x100000001b3ULL ^ (hash >> 29);
}

/// A word that distinguishes nodes of the same kind. Two numbers are equal if they have the same
/// bits, so −0 differs from 0.
std::uint64_t word_of(const NodeKind& kind) {
    const auto of_item = [](StageItem each) {
        return std::uint64_t{each.stage} << 32 | each.item.index();
    };
    const Overloaded word{
        [](double number) { return std::bit_cast<std::uint64_t>(number); },
        of_item,
        [&](SensedItem each) { return of_item(each.item); },
        [](Rate rate) { return std::uint64_t{rate.species.index()}; },
        [](Call call) { return std::uint64_t{call.detail}; },
        [](InsideMask) { return std::uint64_t{0}; },
        [](Unknown unknown) { return std::uint64_t{unknown.number}; },
        []<typename Tag>(Id<Tag> id) { return std::uint64_t{id.index()}; },
        [](auto of_enumeration) { return static_cast<std::uint64_t>(of_enumeration); },
    };
    return std::visit(word, kind);
}

std::uint64_t hash_of(const Node& node) {
    std::uint64_t hash = 0xcbf29ce484222325ULL;
    hash = mix(hash, node.kind.index() << 8 | static_cast<std::uint64_t>(node.function));
    hash = mix(hash, word_of(node.kind));
    for (const NodeId operand : node.reads()) hash = mix(hash, operand.index());
    return hash;
}

bool is_same(const Node& a, const Node& b) {
    return a.kind.index() == b.kind.index() && word_of(a.kind) == word_of(b.kind) &&
           a.function == b.function && a.type == b.type && std::ranges::equal(a.reads(), b.reads());
}

}  // namespace

void ExpressionGraph::make_room() {
    known_.assign(std::max<std::size_t>(64, 2 * known_.size()), std::nullopt);
    for (const NodeId id : nodes_.ids()) {
        std::size_t place = hash_of(nodes_[id]) & (known_.size() - 1);
        while (known_[place]) place = (place + 1) & (known_.size() - 1);
        known_[place] = id;
    }
}

NodeId ExpressionGraph::add(const Node& node, Written written) {
    if (2 * nodes_.size() >= known_.size()) make_room();
    std::size_t place = hash_of(node) & (known_.size() - 1);
    for (; known_[place]; place = (place + 1) & (known_.size() - 1)) {
        const NodeId id = *known_[place];
        if (is_same(nodes_[id], node) && (!is_draw(node) || written_[id] == written)) return id;
    }
    known_[place] = nodes_.next();
    nodes_.push_back(Node(node));  // Copies `node`, because it may refer to an element of `nodes_`.
    written_.push_back(written);
    return *known_[place];
}

NodeId ExpressionGraph::leaf(const NodeKind& kind) { return add({kind}); }

NodeId ExpressionGraph::call(Function function, std::initializer_list<NodeId> operands,
                             ValueType type) {
    Node node;
    node.kind = Call();
    node.function = function;
    node.type = type;
    std::copy(operands.begin(), operands.end(), node.operands.begin());
    node.operand_count = static_cast<std::uint8_t>(operands.size());
    return add(node);
}

std::optional<NodeId> ExpressionGraph::without_zeros(Function function, NodeId a, NodeId b) {
    const bool is_zero = is_number(a, 0), adds_zero = is_number(b, 0);
    switch (function) {
        case Function::add:
            if (is_zero) return b;
            return adds_zero ? std::optional(a) : std::nullopt;
        case Function::subtract:
            if (adds_zero) return a;
            return is_zero ? std::optional(call(Function::negate, {b}, nodes_[b].type))
                           : std::nullopt;
        case Function::multiply:
            return is_zero || adds_zero ? std::optional(number(0)) : std::nullopt;
        case Function::divide: return is_zero ? std::optional(a) : std::nullopt;
        default: return std::nullopt;
    }
}

IdVector<NodeId, bool> needed_by(const ExpressionGraph& graph, std::span<const NodeId> roots) {
    IdVector<NodeId, bool> needed(graph.size(), false);
    for (const NodeId root : roots) needed[root] = true;
    for (const NodeId id : needed.ids_backwards()) {
        if (!needed[id]) continue;
        for (const NodeId operand : graph[id].reads()) needed[operand] = true;
    }
    return needed;
}

}  // namespace cascade

// Makes formulas.
#include "lang/program/formula_builder.h"

#include "lang/program/fold.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace cascade {

namespace {

std::size_t operands_of(const Node& node) {
    return node.kind == NodeKind::call ? operand_count(node) : 0;
}

Node call_node(Function function, std::initializer_list<PartId> operands) {
    Node node;
    node.kind = NodeKind::call;
    node.function = function;
    std::copy(operands.begin(), operands.end(), node.operands.begin());
    node.operand_count = static_cast<std::uint8_t>(operands.size());
    return node;
}

}  // namespace

PartId FormulaBuilder::part(Node node) {
    // Two equal draws of random numbers are two draws.
    const Key key{node.kind,          node.function,
                  node.type,          std::bit_cast<std::uint64_t>(node.number),
                  node.index,         node.stage,
                  node.operand_count, node.operands};
    const auto next = static_cast<PartId>(nodes_.size());
    if (!is_draw(node)) {
        const auto [known, is_new] = known_.try_emplace(key, next);
        if (!is_new) return known->second;
    }
    nodes_.push_back(node);
    return next;
}

PartId FormulaBuilder::number(double value) {
    Node node;
    node.number = value;
    return part(node);
}

PartId FormulaBuilder::call(Function function, std::initializer_list<PartId> operands) {
    std::vector<double> values;
    for (const PartId operand : operands) {
        if (!is_number(operand)) return part(call_node(function, operands));
        values.push_back(nodes_[operand].number);
    }
    values.resize(std::max<std::size_t>(values.size(), 3));
    const auto value = fold(function, values);
    if (value && std::isfinite(*value)) return number(*value);
    return part(call_node(function, operands));
}

PartId FormulaBuilder::add(PartId a, PartId b) {
    if (is_number(a, 0)) return b;
    if (is_number(b, 0)) return a;
    return call(Function::add, {a, b});
}

PartId FormulaBuilder::subtract(PartId a, PartId b) {
    if (is_number(b, 0)) return a;
    if (is_number(a, 0)) return negate(b);
    if (a == b) return number(0);
    return call(Function::subtract, {a, b});
}

PartId FormulaBuilder::multiply(PartId a, PartId b) {
    if (is_number(a, 0) || is_number(b, 0)) return number(0);
    if (is_number(a, 1)) return b;
    if (is_number(b, 1)) return a;
    return call(Function::multiply, {a, b});
}

PartId FormulaBuilder::divide(PartId a, PartId b) {
    if (is_number(a, 0)) return a;
    if (is_number(b, 1)) return a;
    return call(Function::divide, {a, b});
}

PartId FormulaBuilder::negate(PartId a) {
    const Node& node = nodes_[a];
    if (node.kind == NodeKind::call && node.function == Function::negate) return node.operands[0];
    return call(Function::negate, {a});
}

PartId FormulaBuilder::absolute(PartId a) {
    const Node& node = nodes_[a];
    if (node.kind == NodeKind::call && node.function == Function::abs) return a;
    if (node.kind == NodeKind::call && node.function == Function::negate) {
        return absolute(node.operands[0]);
    }
    return call(Function::abs, {a});
}

PartId FormulaBuilder::power(PartId a, PartId b) {
    if (is_number(b, 0)) return number(1);
    if (is_number(b, 1)) return a;
    return call(Function::power, {a, b});
}

PartId FormulaBuilder::maximum(PartId a, PartId b) {
    return a == b ? a : call(Function::max, {a, b});
}

PartId FormulaBuilder::choose(PartId condition, PartId then, PartId otherwise) {
    if (then == otherwise) return then;
    return part(call_node(Function::if_, {condition, then, otherwise}));
}

Formula FormulaBuilder::formula(PartId root) const {
    std::vector<bool> needed(nodes_.size(), false);
    needed[root] = true;
    for (std::size_t id = root + std::size_t{1}; id-- > 0;) {
        if (!needed[id]) continue;
        for (std::size_t n = 0; n < operands_of(nodes_[id]); ++n) {
            needed[nodes_[id].operands[n]] = true;
        }
    }
    Formula result;
    std::vector<PartId> place(nodes_.size(), 0);
    for (std::size_t id = 0; id <= root; ++id) {
        if (!needed[id]) continue;
        Node node = nodes_[id];
        for (std::size_t n = 0; n < operands_of(node); ++n) {
            node.operands[n] = place[node.operands[n]];
        }
        place[id] = static_cast<PartId>(result.nodes.size());
        result.nodes.push_back(node);
    }
    return result;
}

}  // namespace cascade

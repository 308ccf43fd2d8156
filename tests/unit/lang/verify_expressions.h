// Properties of all expression graphs, and properties after each graph pass.
#pragma once

#include "lang/lower/lower_expressions.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade::lowering {

/// True if the pass `now` is `pass` or a later one.
inline bool is_past(std::string_view pass, std::string_view now) {
    const auto passes = graph_passes();
    const auto at = [&](std::string_view name) {
        return std::ranges::find(passes, name, &PassInfo::name);
    };
    return now != "flatten" && at(pass) <= at(now);
}

class Verifier {
public:
    Verifier(const Expressions& expressions, const PassContext& context, std::string_view pass)
        : graph_(expressions.graph), context_(context), pass_(pass) {}

    /// The fault of a node, or empty if there is none.
    std::string fault(NodeId id) const {
        const Node& node = graph_[id];
        for (const NodeId operand : node.reads()) {
            if (operand >= id) return "an operand does not come before its reader";
        }
        if (!may_exist(node)) return "nodes of this kind do not exist here";
        if (!node.is<Call>()) {
            return node.operand_count == 0 ? "" : "only calls have operands";
        }
        if (!has_arity(node)) return "it has the wrong number of operands";
        if (node.type != type_of(node)) return "its type is not that of its operands";
        if (!takes_types(node)) return "an operand has the wrong type";
        return is_aggregate(node) && !is_masked(node) ? "it takes cells outside of the mask" : "";
    }

private:
    bool is_past(std::string_view pass) const { return lowering::is_past(pass, pass_); }
    ValueType type(const Node& node, std::size_t k) const { return graph_[node.operands[k]].type; }

    bool may_exist(const Node& node) const {
        if (node.is<DefinitionId>() || node.is<Rate>()) return false;
        if (node.is<MetricPlane>()) return context_.has_metric();
        if (node.is<ModelPlane>()) return context_.has_links();
        if (node.is<InsideMask>()) return is_past("mask");
        if (node.is<CellValue>() || (node.is<Call>() && is_of_cells(node.function))) {
            return context_.is_tissue() && !is_past("tissue");
        }
        if (node.is<Builtin>()) {
            const bool is_place = !node.is(Builtin::t) && !node.is(Builtin::step);
            return !is_place || !context_.has_links() || !is_laid_out();
        }
        if (!node.is<Call>()) return true;
        if (node.calls(Function::symmetric)) return !is_past("tensors");
        if (node.calls(Function::transport)) return !is_past("limiters");
        if (node.calls(Function::shifted)) return !is_past("shifts");
        if (node.calls(Function::beside)) return is_past("shifts");
        if (node.calls(Function::limited) || node.calls(Function::upwind)) {
            return is_past("limiters");
        }
        if (node.calls(Function::domain_mean) && is_past("areas")) {
            return !context_.has_metric() && !context_.has_links();
        }
        const bool is_flux = node.type == ValueType::vector || node.calls(Function::div);
        return !is_flux || !context_.has_links() || !is_laid_out();
    }

    /// Whether everything that depends on the positions of cells has been expanded.
    bool is_laid_out() const { return is_past(context_.is_tissue() ? "tissue" : "links"); }
    /// Whether lowering must replace this function of vectors in space or of neighbours.
    static bool is_of_cells(Function function) {
        const FunctionKind kind = info(function).kind;
        return kind == FunctionKind::geometry || is_over_neighbours(function) ||
               function == Function::own;
    }

    bool has_arity(const Node& node) const {
        if (node.calls(Function::diffuse) && is_past("tensors")) return node.operand_count == 2;
        if (node.calls(Function::tensor) && is_past("tensors")) {
            return node.operand_count == 3 || node.operand_count == 6;
        }
        if (is_nonlocal(node)) return node.operand_count == 1;
        const bool is_weighted = node.calls(Function::lap) && node.operand_count == 2;
        if (is_weighted) return context_.has_links() && is_past("links");
        return info(node.function).arity.takes(node.operand_count);
    }

    ValueType type_of(const Node& node) const {
        switch (node.function) {
            case Function::grad:
            case Function::vector: return ValueType::vector;
            case Function::tensor:
            case Function::symmetric: return ValueType::tensor;
            case Function::cross:
            case Function::unit: return ValueType::vector;
            case Function::rgb:
            case Function::palette: return ValueType::colour;
            default: break;
        }
        const FunctionKind kind = info(node.function).kind;
        const bool passes_on = kind == FunctionKind::arithmetic || kind == FunctionKind::choice ||
                               kind == FunctionKind::link;
        for (std::size_t k = 0; passes_on && k < node.operand_count; ++k) {
            const bool is_colour = type(node, k) == ValueType::colour;
            if (is_colour || type(node, k) == ValueType::vector) return type(node, k);
        }
        return ValueType::number;
    }

    bool takes_types(const Node& node) const {
        const FunctionKind kind = info(node.function).kind;
        for (std::size_t k = 0; k < node.operand_count; ++k) {
            const ValueType type = this->type(node, k);
            bool fits = type == ValueType::number;
            const bool is_component = node.calls(Function::component);
            if (node.calls(Function::div) || (kind == FunctionKind::geometry && !is_component)) {
                fits = type == ValueType::vector;
            }
            if (is_component && k == 0) fits = type == ValueType::vector;
            if (kind == FunctionKind::link && k == 0) fits |= type == ValueType::vector;
            if (kind == FunctionKind::text) fits = type == ValueType::text;
            if (node.calls(Function::palette) && k == 3) fits = type == ValueType::text;
            if (node.calls(Function::diffuse) && k == 0 && is_past("tensors")) {
                fits = type == ValueType::tensor;
            }
            if (node.calls(Function::multiply) && k == 0) fits |= type == ValueType::tensor;
            if (node.type == ValueType::vector && kind == FunctionKind::arithmetic) {
                fits |= type == ValueType::vector;
            }
            if (kind == FunctionKind::choice) fits |= type == node.type;
            if (!fits) return false;
        }
        return true;
    }

    bool is_masked(const Node& node) const {
        if (!context_.has_mask() || !is_past("mask")) return true;
        const Node& of = graph_[node.operands[0]];
        const bool is_item = of.is<ItemId>() || of.is<StageItem>();
        return is_item || (of.calls(Function::if_) && graph_[of.operands[0]].is<InsideMask>());
    }

    const ExpressionGraph& graph_;
    PassContext context_;
    std::string_view pass_;
};

/// The first fault of a graph after a pass, or empty if there is none. Operands must come before
/// their readers, no two nodes may be equal, types and numbers of operands must fit, and there must
/// be no node that earlier passes replace.
inline std::string verify(const Expressions& expressions, const PassContext& context,
                          std::string_view pass) {
    const ExpressionGraph& graph = expressions.graph;
    const auto needed = needed_by(graph, expressions.roots);
    const Verifier verifier(expressions, context, pass);
    for (const NodeId id : needed.ids()) {
        const std::string fault = needed[id] ? verifier.fault(id) : "";
        if (!fault.empty()) return fmt::format("%{}: {}", id.index(), fault);
    }
    ExpressionGraph again;
    for (const NodeId id : needed.ids()) {
        if (again.add(graph[id], graph.written(id)) != id) {
            return fmt::format("%{}: another node is the same", id.index());
        }
    }
    return "";
}

}  // namespace cascade::lowering

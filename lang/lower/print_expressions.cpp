// Prints expression graphs in the format of kernels (print() in ir/cell_kernel.h): one line for
// each node that is needed.
#include "lang/lower/lower_expressions.h"
#include "lang/print/print_formula.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace cascade::lowering {

namespace {

constexpr std::array<std::string_view, 5> type_names{"", "colour", "text", "vector", "tensor"};

std::string print_call(const Node& node) {
    std::vector<std::string> operands;
    for (const NodeId operand : node.reads())
        operands.push_back(fmt::format("%{}", operand.index()));
    const std::string_view spelling = info(node.function).spelling;
    if (info(node.function).is_operator && operands.size() == 2) {
        return fmt::format("{} {} {}", operands[0], spelling, operands[1]);
    }
    return fmt::format("{}({})", spelling, fmt::join(operands, ", "));
}

}  // namespace

std::string print(const Expressions& expressions, const PassContext& context) {
    const ExpressionGraph& graph = expressions.graph;
    const System& system = context.program.system_of(context.stage);
    const auto needed = needed_by(graph, expressions.roots);
    std::string text;
    for (const NodeId id : needed.ids()) {
        if (!needed[id]) continue;
        const Node& node = graph[id];
        const auto name =
            std::ranges::find(expressions.names, id, [](const auto& each) { return each.first; });
        std::vector<std::string_view> remarks;
        if (node.type != ValueType::number) {
            remarks.push_back(type_names[static_cast<std::size_t>(node.type)]);
        }
        if (name != expressions.names.end()) remarks.push_back(name->second);
        text += fmt::format("%{} = {}{}{}\n", id.index(),
                            node.is<Call>() ? print_call(node)
                                            : print_formula(context.program, system, {{node}}),
                            remarks.empty() ? "" : "  # ", fmt::join(remarks, ", "));
    }
    for (const NodeId root : expressions.roots) text += fmt::format("result %{}\n", root.index());
    return text;
}

}  // namespace cascade::lowering

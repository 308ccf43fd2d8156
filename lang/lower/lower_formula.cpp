// Parts of formulas to instructions, each from the values of its operands.
#include "lang/lower/lower_formula.h"

#include "core/check.h"

namespace cascade::lowering {

Value KernelAssembly::part(const Cursor& cursor) {
    const Node& node = cursor.part.node;
    switch (node.kind) {
        case NodeKind::number: return {builder_.number(node.number)};
        case NodeKind::text: return {};  // Its reader looks at the node itself.
        case NodeKind::own: return {own_item(node.index)};
        case NodeKind::earlier: return {item(node.stage, node.index)};
        case NodeKind::builtin: return {builtin(static_cast<Builtin>(node.index))};
        case NodeKind::metric: return {beside(metric_slot(node.index))};
        case NodeKind::model: return {of_model(static_cast<ModelPlane>(node.index))};
        case NodeKind::surface_value: return {beside(surface_value_slot(node.index))};
        case NodeKind::inside: return {inside(at_)};
        case NodeKind::call: return call(node, cursor);
        case NodeKind::definition:
        case NodeKind::rate: break;
    }
    CHECK(false, "lowering: a graph has no definitions and rates");
}

Value KernelAssembly::call(const Node& node, const Cursor& cursor) {
    switch (info(node.function).kind) {
        case FunctionKind::draw:
        case FunctionKind::pattern: return {random(node, cursor)};
        case FunctionKind::shape: return {shape(node, cursor)};
        case FunctionKind::text: return {beside(file_slot(node.function, cursor.operand(0).index))};
        case FunctionKind::colour:
            if (node.function == Function::palette) return palette(node, cursor);
            return {cursor.number(node, 0), cursor.number(node, 1), cursor.number(node, 2)};
        default: break;
    }
    // Numbers choose between colours and mix them channel by channel.
    const std::size_t channels = node.type == ValueType::colour ? 3 : 1;
    Value value{};
    for (std::size_t channel = 0; channel < channels; ++channel) {
        const auto operand = [&](std::size_t k) {
            const bool is_colour = cursor.operand(k).type == ValueType::colour;
            return cursor.values[k][is_colour ? channel : 0];
        };
        value[channel] = elementary(node.function, operand(0), operand(1), operand(2));
    }
    return value;
}

ValueId KernelAssembly::elementary(Function function, ValueId a, ValueId b, ValueId c) {
    KernelBuilder& k = builder_;
    switch (function) {
        // clang-format off
#define CASCADE_ELEMENTARY(id, value, kernel, slope) case Function::id: return kernel;
#include "lang/vocabulary/elementary.def"
        // clang-format on
        default: break;
    }
    CHECK(false, "lowering: every function of numbers has a row");
}

}  // namespace cascade::lowering

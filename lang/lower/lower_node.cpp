// Lowers each kind of node.
#include "lang/lower/lower_node.h"

#include "core/check.h"

namespace cascade::lowering {

namespace {

ValueId elementary(KernelBuilder& k, Function function, ValueId a, ValueId b, ValueId c) {
    switch (function) {
        // clang-format off
#define CASCADE_ELEMENTARY(id, value, kernel, slope) case Function::id: return kernel;
#include "lang/vocabulary/elementary.def"
        // clang-format on
        default: break;
    }
    CHECK(false, "lowering: every function of numbers has a row");
}

Value lower_call(KernelAssembly& assembly, const NodeInCell& in) {
    const Node& node = in.node();
    switch (info(node.function).kind) {
        case FunctionKind::draw:
        case FunctionKind::pattern: return {lower_draw(assembly, in)};
        case FunctionKind::shape: return {lower_shape(assembly, in)};
        case FunctionKind::text: return {assembly.field(plane_source(in.graph, in.id), in.at)};
        case FunctionKind::colour:
            if (node.function == Function::palette) return lower_palette(assembly, in);
            return {in.number(0), in.number(1), in.number(2)};
        default: break;
    }
    // A tensor is its three entries.
    if (node.function == Function::tensor) return {in.number(0), in.number(1), in.number(2)};
    // `if` and `mix` of colours work channel by channel.
    const std::size_t channels = node.type == ValueType::colour ? 3 : 1;
    Value value{};
    for (std::size_t channel = 0; channel < channels; ++channel) {
        const auto operand = [&](std::size_t k) {
            const bool is_colour = in.operand(k).type == ValueType::colour;
            return in.values[k][is_colour ? channel : 0];
        };
        value[channel] =
            elementary(assembly.builder(), node.function, operand(0), operand(1), operand(2));
    }
    return value;
}

}  // namespace

Value lower_node(KernelAssembly& assembly, const NodeInCell& in) {
    const Node& node = in.node();
    switch (node.kind) {
        case NodeKind::number: return {assembly.builder().number(node.number)};
        case NodeKind::text: return {};  // Its reader uses the node itself.
        case NodeKind::own: return {assembly.item({in.graph.stage(), node.index}, in.at)};
        case NodeKind::earlier: return {assembly.item({node.stage, node.index}, in.at)};
        case NodeKind::builtin:
            return {CellPlace(assembly, in.at).builtin(static_cast<Builtin>(node.index))};
        case NodeKind::metric:
        case NodeKind::model:
        case NodeKind::surface_value: return {assembly.field(plane_source(in.graph, in.id), in.at)};
        case NodeKind::inside: return {assembly.inside(in.at)};
        case NodeKind::call: return lower_call(assembly, in);
        case NodeKind::definition:
        case NodeKind::rate: break;
    }
    CHECK(false, "lowering: a graph has no definitions and rates");
}

PlaneSource plane_source(const PlanGraph& graph, NodeId id) {
    const Node& node = graph[id];
    switch (node.kind) {
        case NodeKind::own: return StageItem{graph.stage(), node.index};
        case NodeKind::earlier: return StageItem{node.stage, node.index};
        case NodeKind::metric: return static_cast<MetricPlane>(node.index);
        case NodeKind::model: return static_cast<ModelPlane>(node.index);
        case NodeKind::surface_value: return SurfaceValueId(node.index);
        default: break;
    }
    CHECK(node.kind == NodeKind::call && reads_file(node.function),
          "lowering: a plane is an item or a file");
    return NamedPlane{node.function, graph[node.operands[0]].index};
}

}  // namespace cascade::lowering

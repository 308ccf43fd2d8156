// Lowers each kind of node.
#include "lang/lower/lower_node.h"

#include "core/check.h"
#include "core/overloaded.h"

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

ValueId over_links(KernelBuilder& builder, Function function, ValueId value) {
    switch (function) {
        case Function::link_sum: return builder.link_sum(value);
        case Function::link_least: return builder.link_least(value);
        case Function::link_greatest: return builder.link_greatest(value);
        default: break;
    }
    CHECK(false, "lowering: sums over neighbours are sums over links");
}

Value lower_call(KernelAssembly& assembly, const NodeInCell& in) {
    const Node& node = in.node();
    switch (info(node.function).kind) {
        case FunctionKind::draw:
        case FunctionKind::pattern: return {lower_draw(assembly, in)};
        case FunctionKind::shape: return {lower_shape(assembly, in)};
        case FunctionKind::link:
            return {over_links(assembly.builder(), node.function, in.number(0))};
        case FunctionKind::text: return {assembly.field(plane_source(in.graph, in.id), in.at)};
        case FunctionKind::colour:
            if (node.function == Function::palette) return lower_palette(assembly, in);
            return {in.number(0), in.number(1), in.number(2)};
        default: break;
    }
    if (node.function == Function::tensor) {  // The operands of a tensor are its entries.
        Value entries{};
        for (std::size_t k = 0; k < node.operand_count; ++k) entries[k] = in.number(k);
        return entries;
    }
    // The functions `if` and `mix` are applied to each channel of a colour.
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
    const Overloaded value{
        [&](double number) -> Value { return {assembly.builder().number(number)}; },
        // The node that reads the text uses only its id, so a text needs no value.
        [](TextId) -> Value { return {}; },
        [&](ItemId item) -> Value {
            return {assembly.item({in.graph.stage(), item}, in.at)};
        },
        [&](StageItem item) -> Value { return {assembly.item(item, in.at)}; },
        [&](SensedItem sensed) -> Value {
            // If the item of an earlier stage is uniform, it has the same value at the positions of
            // all cells.
            const bool is_number = in.graph.is_uniform(in.id);
            return {is_number ? assembly.item(sensed.item, in.at) : assembly.field(sensed, in.at)};
        },
        [&](Builtin builtin) -> Value { return {CellPlace(assembly, in.at).builtin(builtin)}; },
        [&](InsideMask) -> Value { return {assembly.inside(in.at)}; },
        [&](Call) { return lower_call(assembly, in); },
        [&](SurfaceValueId id) -> Value { return {assembly.field(id, in.at)}; },
        [&](MetricPlane plane) -> Value { return {assembly.field(plane, in.at)}; },
        [&](ModelPlane plane) -> Value { return {assembly.field(plane, in.at)}; },
        [&](LagPart part) -> Value { return {assembly.field(part, in.at)}; },
        [&](Unknown unknown) -> Value { return {assembly.field(unknown, in.at)}; },
        [](auto) -> Value { CHECK(false, "lowering: a graph has no definitions and rates"); },
    };
    return std::visit(value, in.node().kind);
}

PlaneSource plane_source(const PlanGraph& graph, NodeId id) {
    const Node& node = graph[id];
    const Overloaded source{
        [&](ItemId item) -> PlaneSource {
            return StageItem{graph.stage(), item};
        },
        [](StageItem item) -> PlaneSource { return item; },
        [](SensedItem sensed) -> PlaneSource { return sensed; },
        [](MetricPlane plane) -> PlaneSource { return plane; },
        [](ModelPlane plane) -> PlaneSource { return plane; },
        [](SurfaceValueId id_of_value) -> PlaneSource { return id_of_value; },
        [](LagPart part) -> PlaneSource { return part; },
        [](Unknown unknown) -> PlaneSource { return unknown; },
        [&](Call call) -> PlaneSource {
            return NamedPlane{node.function, std::get<TextId>(graph[node.operands[0]].kind),
                              call.detail};
        },
        [](auto) -> PlaneSource { CHECK(false, "lowering: a plane is an item or a file"); },
    };
    return std::visit(source, node.kind);
}

}  // namespace cascade::lowering

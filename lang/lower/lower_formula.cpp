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
    switch (node.function) {
        case Function::if_:
        case Function::mix:
        case Function::rgb: return colour_call(node, cursor);
        case Function::palette: return palette(node, cursor);
        case Function::random:
        case Function::normal:
        case Function::white:
        case Function::noise:
        case Function::lattice:
        case Function::diamond: return {random(node, cursor)};
        case Function::disc:
        case Function::ring:
        case Function::box:
        case Function::gauss:
        case Function::stripe: return {shape(node, cursor)};
        case Function::field:
        case Function::image:
        case Function::attr:
        case Function::uvimage:
            return {beside(file_slot(node.function, cursor.operand(0).index))};
        case Function::clamp:
            return {builder_.minimum(
                builder_.maximum(cursor.number(node, 0), cursor.number(node, 1)),
                cursor.number(node, 2))};
        case Function::smoothstep:
            return {builder_.smooth_step(cursor.number(node, 0), cursor.number(node, 1),
                                         cursor.number(node, 2))};
        default: break;
    }
    const ValueId a = cursor.number(node, 0);
    if (operand_count(node) == 1) return {elementary(node.function, a)};
    return {operation(node.function, a, cursor.number(node, 1))};
}

Value KernelAssembly::colour_call(const Node& node, const Cursor& cursor) {
    const auto& values = cursor.values;
    if (node.function == Function::rgb) {
        return {cursor.number(node, 0), cursor.number(node, 1), cursor.number(node, 2)};
    }
    const std::size_t channels = node.type == ValueType::colour ? 3 : 1;
    Value value{};
    for (std::size_t channel = 0; channel < channels; ++channel) {
        if (node.function == Function::if_) {
            value[channel] = builder_.select(values[0][0], values[1][channel], values[2][channel]);
            continue;
        }
        const ValueId from = values[0][channel];
        const ValueId span = builder_.subtract(values[1][channel], from);
        value[channel] = builder_.add(from, builder_.multiply(span, values[2][0]));
    }
    return value;
}

ValueId KernelAssembly::elementary(Function function, ValueId a) {
    switch (function) {
        case Function::logical_not: return builder_.apply(Op::logical_not, a);
        case Function::negate: return builder_.apply(Op::negate, a);
        case Function::abs: return builder_.apply(Op::absolute, a);
        case Function::sqrt: return builder_.apply(Op::square_root, a);
        case Function::exp: return builder_.exponential(a);
        case Function::log: return builder_.logarithm(a);
        case Function::sin: return builder_.sine(a);
        case Function::cos: return builder_.cosine(a);
        case Function::tan: return builder_.tangent(a);
        case Function::asin: return builder_.arc_sine(a);
        case Function::acos: return builder_.arc_cosine(a);
        case Function::atan: return builder_.arc_tangent(a, builder_.number(1));
        case Function::sinh: return builder_.hyperbolic_sine(a);
        case Function::cosh: return builder_.hyperbolic_cosine(a);
        case Function::tanh: return builder_.hyperbolic_tangent(a);
        case Function::cbrt: return builder_.cube_root(a);
        case Function::sign: return builder_.sign_of(a);
        case Function::floor: return builder_.round_down(a);
        case Function::ceil: return builder_.round_up(a);
        case Function::round: return builder_.round_to_even(a);
        default: break;
    }
    CHECK(false, "lowering: every function of one number has a meaning");
}

ValueId KernelAssembly::operation(Function function, ValueId a, ValueId b) {
    switch (function) {
        case Function::logical_or: return builder_.apply(Op::logical_or, a, b);
        case Function::logical_and: return builder_.apply(Op::logical_and, a, b);
        case Function::less: return builder_.apply(Op::less, a, b);
        case Function::less_equal: return builder_.apply(Op::less_equal, a, b);
        case Function::greater: return builder_.apply(Op::less, b, a);
        case Function::greater_equal: return builder_.apply(Op::less_equal, b, a);
        case Function::equal: return builder_.apply(Op::equal, a, b);
        case Function::not_equal: return builder_.apply(Op::not_equal, a, b);
        case Function::add: return builder_.add(a, b);
        case Function::subtract: return builder_.subtract(a, b);
        case Function::multiply: return builder_.multiply(a, b);
        case Function::divide: return builder_.divide(a, b);
        case Function::pow:
        case Function::power: return builder_.power(a, b);
        case Function::atan2: return builder_.arc_tangent(a, b);
        case Function::hypot: return builder_.hypotenuse(a, b);
        case Function::mod: return builder_.modulus(a, b);
        case Function::step: return builder_.apply(Op::less_equal, a, b);
        case Function::min: return builder_.minimum(a, b);
        case Function::max: return builder_.maximum(a, b);
        default: break;
    }
    CHECK(false, "lowering: every function of two numbers has a meaning");
}

}  // namespace cascade::lowering

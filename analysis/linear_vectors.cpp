// Vectors have slopes at the faces across each axis, where factors are averaged, by the rules of
// lang/lower/lower_vectors.cpp.
#include "analysis/lineariser.h"

namespace cascade::analysis {

/// Calls `act` with each axis and component that the grid has.
template <typename Act>
void Lineariser::at_each_face(const Act& act) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t component = 0; component < 3; ++component) {
            if (axes_[axis] && axes_[component]) act(axis, component);
        }
    }
}

Result<void> Lineariser::add_tensor(const Node& node, Part& part) {
    if (model_.program->domain.model) {
        return failure(
            "on a model it spreads in a direction, so that waves of one length decay "
            "at different rates");
    }
    for (std::size_t n = 0; n < node.operand_count; ++n) {
        if (!is_flat(this->part(node, n).slopes)) {
            return failure("a tensor in its rates changes with a species");
        }
    }
    part.matrix = tensor_matrix(algebra_, algebra_.add(of_values(node)), false);
    return {};
}

Result<void> Lineariser::add_vector(const Node& node, Part& part) {
    const Part& a = this->part(node, 0);
    const Part& b = parts_[node.reads().back()];
    const auto type = [&](std::size_t n) { return types_[node.operands[n]]; };
    switch (node.function) {
        case Function::grad:
            at_each_face([&](std::size_t axis, std::size_t component) {
                part.at_faces[axis][component] =
                    axis == component
                        ? through(a.slopes, Kind::across, axis)
                        : through(through(a.slopes, Kind::average, axis), Kind::central, component);
            });
            return {};
        case Function::vector:
            for (std::size_t n = 0; n < node.operand_count; ++n) {
                part.value[n] = this->part(node, n).value[0];
            }
            at_each_face([&](std::size_t axis, std::size_t component) {
                if (component >= node.operand_count) return;
                part.at_faces[axis][component] =
                    through(this->part(node, component).slopes, Kind::average, axis);
            });
            return {};
        case Function::negate: combine(part, a, algebra_.number(-1)); return {};
        case Function::add:
            combine(part, a, one_);
            combine(part, b, one_);
            return {};
        case Function::subtract:
            combine(part, a, one_);
            combine(part, b, algebra_.number(-1));
            return {};
        case Function::divide: {
            const NodeId factor = algebra_.quotient(one_, b.value[0]);
            scale(part, a, factor, b.slopes, algebra_.negative(algebra_.product(factor, factor)));
            return {};
        }
        case Function::multiply:
            if (type(0) == ValueType::tensor) {
                turn(part, a, b);
            } else if (type(0) == ValueType::vector) {
                scale(part, a, b.value[0], b.slopes, one_);
            } else {
                scale(part, b, a.value[0], a.slopes, one_);
            }
            return {};
        default: break;
    }
    return without_rule(node);
}

void Lineariser::combine(Part& sum, const Part& vector, NodeId factor) {
    for (std::size_t n = 0; n < 3; ++n) {
        sum.value[n] = algebra_.sum(sum.value[n], algebra_.product(factor, vector.value[n]));
    }
    at_each_face([&](std::size_t axis, std::size_t component) {
        add(sum.at_faces[axis][component], vector.at_faces[axis][component], factor);
    });
}

/// A vector times a number at faces, where the number is `factor` and changes by `by` times
/// `slopes`.
void Lineariser::scale(Part& product, const Part& vector, NodeId factor, const Slopes& slopes,
                       NodeId by) {
    combine(product, vector, factor);
    at_each_face([&](std::size_t axis, std::size_t component) {
        add(product.at_faces[axis][component], through(slopes, Kind::average, axis),
            algebra_.product(by, vector.value[component]));
    });
}

void Lineariser::turn(Part& product, const Part& tensor, const Part& vector) {
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t column = 0; column < 3; ++column) {
            const NodeId entry = tensor.matrix[row][column];
            product.value[row] =
                algebra_.sum(product.value[row], algebra_.product(entry, vector.value[column]));
            at_each_face([&](std::size_t axis, std::size_t component) {
                if (component == row && axes_[column]) {
                    add(product.at_faces[axis][row], vector.at_faces[axis][column], entry);
                }
            });
        }
    }
}

}  // namespace cascade::analysis

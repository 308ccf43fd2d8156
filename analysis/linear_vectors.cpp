// A vector has slopes at the faces across each axis. A factor that is needed at a face is averaged
// by the rules of lang/lower/lower_vectors.cpp.
#include "analysis/lineariser.h"
#include "lang/program/vector_functions.h"

#include <span>

namespace cascade::analysis {

/// Calls `act` with each axis and each component that the grid has.
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

/// Computes the LinearPart of a vector from the LinearParts of its operands.
struct Lineariser::OfVectors {
    Lineariser& own;
    Part& part;

    const Part& of(NodeId id) const { return own.parts_[id]; }
    void gradient(NodeId id) const {
        own.at_each_face([&](std::size_t axis, std::size_t component) {
            const Slopes& slopes = of(id).slopes;
            part.at_faces[axis][component] =
                axis == component ? own.through(slopes, Difference::across, axis)
                                  : own.through(own.through(slopes, Difference::average, axis),
                                                Difference::central, component);
        });
    }
    void components(std::span<const NodeId> parts) const {
        for (std::size_t n = 0; n < parts.size(); ++n) part.value[n] = of(parts[n]).value[0];
        own.at_each_face([&](std::size_t axis, std::size_t component) {
            if (component >= parts.size()) return;
            part.at_faces[axis][component] =
                own.through(of(parts[component]).slopes, Difference::average, axis);
        });
    }
    void negative(NodeId vector) const { own.combine(part, of(vector), own.algebra_.number(-1)); }
    void sum(NodeId a, NodeId b) const {
        own.combine(part, of(a), own.one_);
        own.combine(part, of(b), own.one_);
    }
    void difference(NodeId a, NodeId b) const {
        own.combine(part, of(a), own.one_);
        negative(b);
    }
    void quotient(NodeId vector, NodeId by) const {
        Algebra& algebra = own.algebra_;
        const NodeId factor = algebra.quotient(own.one_, of(by).value[0]);
        own.scale(part, of(vector), factor, of(by).slopes,
                  algebra.negative(algebra.product(factor, factor)));
    }
    void product(NodeId a, NodeId b, bool is_vector_first) const {
        const Part& number = of(is_vector_first ? b : a);
        own.scale(part, of(is_vector_first ? a : b), number.value[0], number.slopes, own.one_);
    }
    void turned(NodeId tensor, NodeId vector) const { own.turn(part, of(tensor), of(vector)); }
};

Result<void> Lineariser::add_vector(const Node& node, Part& part) {
    if (!makes_flux(node.function)) return without_rule(node);
    vector_by(OfVectors{*this, part}, nodes_, node);
    return {};
}

void Lineariser::combine(Part& sum, const Part& vector, NodeId factor) {
    for (std::size_t n = 0; n < 3; ++n) {
        sum.value[n] = algebra_.sum(sum.value[n], algebra_.product(factor, vector.value[n]));
    }
    at_each_face([&](std::size_t axis, std::size_t component) {
        add(sum.at_faces[axis][component], vector.at_faces[axis][component], factor);
    });
}

/// Multiplies a vector by a number at faces. The number's flat value is `factor`. Its response to a
/// wave is `by` times `slopes`.
void Lineariser::scale(Part& product, const Part& vector, NodeId factor, const Slopes& slopes,
                       NodeId by) {
    combine(product, vector, factor);
    at_each_face([&](std::size_t axis, std::size_t component) {
        add(product.at_faces[axis][component], through(slopes, Difference::average, axis),
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

// Rewrites formulas for a domain that grows (internal to grown_lengths.cpp).
#pragma once

#include "lang/program/program.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>
#include <vector>

namespace cascade {

/// Rewrites one formula. Only one public function may be called, and only once.
class GrowingFormula {
public:
    GrowingFormula(const Growth& growth, const DomainSettings& domain)
        : growth_(growth),
          is_surface_(domain.model || domain.surface),
          stencil_(is_surface_ ? Stencil{true, true, false} : domain.grid.stencil()) {}

    /// The formula in which lengths grow.
    Formula rewritten(const Formula& formula);
    /// rate − dilution · species
    Formula diluted(const Formula& rate, ItemId species);
    /// The value of a rule at a side perpendicular to an axis, multiplied or divided (`by`) by the
    /// scale of lengths along this axis.
    Formula at_side(const Formula& value, std::size_t axis, Function by);

private:
    NodeId append(const Node& node) {
        const NodeId id = result_.nodes.next();
        result_.nodes.push_back(node);
        return id;
    }
    NodeId number(double value) { return append({value, span_}); }
    NodeId call(Function function, std::initializer_list<NodeId> operands,
                ValueType type = ValueType::number) {
        Node node{Call{}, span_, type, function, static_cast<std::uint8_t>(operands.size()), {}};
        std::ranges::copy(operands, node.operands.begin());
        return append(node);
    }
    /// The product of a and b. It has the type of b.
    NodeId product(NodeId a, NodeId b) {
        return call(Function::multiply, {a, b}, result_.nodes[b].type);
    }
    NodeId square(NodeId a) { return product(a, a); }
    NodeId quotient(NodeId a, NodeId b) { return call(Function::divide, {a, b}); }
    NodeId difference(NodeId a, NodeId b) { return call(Function::subtract, {a, b}); }
    NodeId copied(const Formula& formula);

    bool has_axis(std::size_t axis) const {
        return std::array{stencil_.x, stencil_.y, stencil_.z}[axis];
    }
    bool changes(std::size_t axis) const {
        return !growth_.scale[axis].nodes.back().is(NodeKind(1.0));
    }
    /// The first axis with more than one cell. In uniform growth, all axes have the scale of this
    /// axis.
    std::size_t main_axis() const { return has_axis(0) ? 0 : has_axis(1) ? 1 : 2; }

    NodeId scale(std::size_t axis);
    NodeId sound(NodeId value, std::size_t axis);
    NodeId inverse(std::size_t axis);
    NodeId inverse_square(std::size_t axis);
    NodeId shrunk(NodeId value, std::size_t axis);
    NodeId twice_shrunk(NodeId value, std::size_t axis);

    NodeId image_of(const Node& node);
    NodeId image_of_leaf(const Node& node);
    std::optional<NodeId> turned_gradient(const Node& node);
    NodeId by_axes(const Node& node);
    NodeId times_scale(const Node& node);
    NodeId white(NodeId value);
    NodeId scaled_vector(NodeId vector, const std::array<std::size_t, 3>& axes);
    NodeId curl(const Node& node);
    NodeId carried(Node node);
    NodeId component(NodeId vector, std::size_t axis);
    NodeId sum(const std::vector<NodeId>& terms);

    const Growth& growth_;
    bool is_surface_;  ///< Whether cells are on a surface or a model.
    Stencil stencil_;
    Formula result_;
    Span span_;
    std::array<std::optional<NodeId>, 3> scales_, inverses_, squares_;
};

}  // namespace cascade

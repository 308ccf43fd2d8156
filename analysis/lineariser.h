// Visits the formulas of rates once. Finds the value of each subexpression in the flat state, and
// its response to waves (internal to the linear model).
#pragma once

#include "analysis/linear_model.h"

#include <algorithm>
#include <array>
#include <map>
#include <vector>

namespace cascade::analysis {

/// A sum over products of operators, with the coefficient of each product.
using Slope = std::map<OperatorProduct, NodeId>;
using Slopes = std::vector<Slope>;  ///< One per variable.

/// A subexpression of a rate, linearised around a flat state.
struct LinearPart {
    /// The value of a number, or the components of a vector. A number uses only the first element.
    std::array<NodeId, 3> value{};
    TensorMatrix matrix{};  ///< The value of a tensor.
    Slopes slopes;          ///< The slopes of a number.
    /// For vectors: slopes, indexed first by the axis across the faces, then by the component.
    std::array<std::array<Slopes, 3>, 3> at_faces;
};

/// Completes a model whose species, unknowns and starting values are set: adds formulas, kernels
/// and facts for users.
class Lineariser {
public:
    explicit Lineariser(LinearModel& model);

    /// Adds a node after its operands. Fails with a message for the user.
    Result<void> add(const Node& node);
    const LinearPart& operator[](NodeId id) const { return parts_[id]; }

private:
    using Part = LinearPart;
    using Kind = WaveOperator::Kind;

    Part nothing() const;
    const Part& part(const Node& node, std::size_t n) const { return parts_[node.operands[n]]; }
    Node of_values(const Node& node) const;
    void add(Slopes& sum, const Slopes& slopes, NodeId factor);
    Slopes through(const Slopes& slopes, WaveOperator each) const;
    Slopes through(const Slopes& slopes, Difference difference, std::size_t axis = 0) const {
        return through(slopes, {Kind::difference, difference, static_cast<std::uint8_t>(axis)});
    }

    Result<void> add_item(ItemId item, Part& part);
    Result<NodeId> parameter(ItemId item);
    void add_unknown(Unknown unknown, Part& part);
    Result<void> add_builtin(Builtin builtin);
    Result<void> add_call(const Node& node, Part& part);
    Result<void> add_aggregate(const Node& node, Part& part);
    Result<void> add_convolution(const Node& node, Part& part);
    Result<std::size_t> kernel_of(const Node& node);
    void add_advection(const Node& node, Part& part);
    void add_transport(const Node& node, Part& part);
    void add_shift(const Node& node, Part& part);
    void add_diffusion(const Node& node, Part& part);
    Result<void> add_function(const Node& node, Part& part);
    Result<void> without_rule(const Node& node) const;

    // Linearises vectors and tensors (linear_vectors.cpp).
    struct OfVectors;
    template <typename Act>
    void at_each_face(const Act& act) const;
    Result<void> add_tensor(const Node& node, Part& part);
    Result<void> add_vector(const Node& node, Part& part);
    void combine(Part& sum, const Part& vector, NodeId factor);
    void scale(Part& product, const Part& vector, NodeId factor, const Slopes& slopes, NodeId by);
    void turn(Part& product, const Part& tensor, const Part& vector);

    LinearModel& model_;
    Algebra& algebra_;
    NodeId zero_, one_;
    Slopes flat_;  ///< The slopes of constants.
    std::array<bool, 3> axes_;
    IdVector<NodeId, Part> parts_;
    Nodes nodes_;
};

inline bool is_flat(const Slopes& slopes) {
    return std::all_of(slopes.begin(), slopes.end(),
                       [](const Slope& slope) { return slope.empty(); });
}

}  // namespace cascade::analysis

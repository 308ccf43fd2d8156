// Rewrites vectors in systems of fields as operators that lowering and calculus support.
//
// A vector has two kinds of values. In a cell it is three numbers: grad(e) is (dx(e), dy(e),
// dz(e)), and arithmetic works component by component. Inside div a vector has a value at each face
// between cells (lang/lower/lower_vectors.cpp). Only these nodes have a value at faces: grad,
// vector, sums, differences and negatives of vectors, vectors multiplied or divided by numbers, and
// vectors multiplied by a tensor. All other functions of vectors are rewritten:
//
//   v.x, dot, length, curl of a vector in the plane    become numbers, made of components;
//   cross, curl                                        become vector(…) of such numbers;
//   unit(v)                                            becomes (1 / length(v)) * v;
//   if(c, v, w)                                        becomes if(c, 1, 0) * v + if(c, 0, 1) * w;
//   mix(v, w, t)                                       becomes v + t * (w - v);
//   along(v)                                           becomes an arc tangent of components.
//
// On a model diffuse(e, a1, a2, theta) becomes div(tensor(a1, a2, theta) * grad(e)). Sums,
// differences and multiples of tensors become symmetric(…) of their entries. In the kernel of a
// convolution, `distance` and the components of `direction` become LagParts.
#pragma once

#include "lang/program/terms.h"

#include <array>
#include <optional>
#include <unordered_map>

namespace cascade {

/// The entries a11, a12 and a22 of A = R(θ) diag(a1², a2²) Rᵀ(θ), with y pointing down (Witkin &
/// Kass, equation 6). The direction [cos θ, sin θ] and the sign of a12 agree with that equation if
/// y points down.
struct TensorEntries {
    Term a11, a12, a22;
};
TensorEntries tensor_entries(ExpressionGraph& graph, NodeId a1, NodeId a2, NodeId theta);

/// The entries of a symmetric tensor, by row and column.
using TensorMatrix = std::array<TermVector, 3>;
/// The matrix of a node tensor(a1, a2, theta) or symmetric(…). On a plane, all entries in the row
/// and the column of z are 0. On a model the matrix is the tensor in space that ModelTensor
/// describes.
TensorMatrix tensor_matrix(ExpressionGraph& graph, NodeId tensor, bool on_model);

/// The tensor of a node tensor(a1, a2, theta) in a cell of a model. For a vector v in the plane of
/// the cell, T v = low v + (rest v + along (t · v) t), where t is the direction theta. The
/// divergence of low v is computed over links, and it damps waves of all directions. The divergence
/// of the second term is computed in cells. If the neighbours of a cell are spread so unevenly that
/// the second term could make waves grow (surface/cell_frames.h), a1² and a2² are brought nearer to
/// their mean.
struct ModelTensor {
    Term low, rest, along;
    TermVector t;
};
ModelTensor model_tensor(ExpressionGraph& graph, NodeId tensor);

/// The directions in which the cells of a system of fields have neighbours.
struct FieldSpace {
    std::array<bool, 3> has_axis{};
    /// Whether the grid is on a surface given by a formula. If so, x and y are directions along the
    /// surface.
    bool has_metric = false;
    bool on_model = false;

    /// The space of a system. nullopt for a system of crawling cells, because lowering rewrites the
    /// vectors of these.
    static std::optional<FieldSpace> of(const Program& program, const System& system);
};

class FieldVectors {
public:
    FieldVectors(ExpressionGraph& graph, const FieldSpace& space) : graph_(graph), space_(space) {}

    /// Adds a node, or adds the nodes that replace it. The operands of `node` must be results of
    /// this function.
    NodeId add(const Node& node, Written written);

    /// The three components of a vector in a cell.
    const SparseVector& components(NodeId vector);
    /// The three components of a vector if they have already been computed; else null.
    const SparseVector* known_components(NodeId vector) const {
        const auto found = components_.find(vector);
        return found == components_.end() ? nullptr : &found->second;
    }

private:
    std::optional<NodeId> written_out(const Node& node);
    SparseVector components_of(const Node& node);
    SparseVector gradient(NodeId of);
    NodeId curl(const Node& node);
    NodeId angle(NodeId vector);
    NodeId choice(const Node& node);
    std::optional<NodeId> of_tensors(const Node& node);
    NodeId carried(const Node& node);

    bool is_vector(NodeId id) const { return graph_[id].type == ValueType::vector; }
    Term term(NodeId id) const { return {&graph_, id}; }
    SparseTerm sparse(NodeId id) const { return {term(id)}; }
    SparseTerm leaf(const NodeKind& kind) { return sparse(graph_.leaf(kind)); }
    SparseTerm zero() { return leaf(0.0); }

    ExpressionGraph& graph_;
    FieldSpace space_;
    /// Maps each vector to its three components in a cell.
    std::unordered_map<NodeId, SparseVector> components_;
};

}  // namespace cascade

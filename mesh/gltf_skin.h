// Skins of glTF files. A skin has joints, which are nodes and position the points of a mesh.
#pragma once

#include "core/result.h"
#include "mesh/gltf_matrix.h"
#include "mesh/gltf_model.h"
#include "mesh/gltf_numbers.h"

#include <memory>
#include <optional>
#include <vector>

namespace cascade {

/// The matrices of nodes in the scene, computed on demand.
class GltfNodePlaces {
public:
    explicit GltfNodePlaces(const tinygltf::Model& model);

    /// The matrix of a node. Fails if there is no such node, or if the node is its own descendant.
    Result<GltfMatrix> of(int node);

private:
    const tinygltf::Model& model_;
    /// The parent of each node; −1 for nodes without a parent.
    std::vector<int> parents_;
    std::vector<std::optional<GltfMatrix>> places_;  ///< The matrices computed so far.
};

/// The matrix of a node, given directly or by its translation, rotation and scale.
GltfMatrix matrix_of_node(const tinygltf::Node& node);

/// The matrices by which the joints of a skin move points of its mesh. Fails if joints or matrices
/// are missing.
Result<std::vector<GltfMatrix>> joints_of_skin(const tinygltf::Model& model, int skin,
                                               GltfNodePlaces& places);

/// The weights by which joints move the points of a primitive, in sets of four.
class GltfWeights {
public:
    /// `is_there` is false if the primitive has no weights. Fails if the weights cover fewer than
    /// `count` points or lie beyond the data.
    static Result<GltfWeights> of(const tinygltf::Model& model,
                                  const tinygltf::Primitive& primitive, std::size_t count);

    bool is_there() const { return !sets_.empty(); }
    std::size_t sets() const { return sets_.size(); }
    /// The mean of the joints' matrices, weighted for a point. The sum of weights need not be 1. If
    /// all weights are 0, returns the matrix of the first joint. Fails if a joint is missing.
    Result<GltfMatrix> matrix_at(std::size_t point, const std::vector<GltfMatrix>& joints) const;

private:
    struct Set {
        GltfNumbers joints, weights;
    };
    std::vector<Set> sets_;
};

}  // namespace cascade

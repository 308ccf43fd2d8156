// Skins of glTF files: joints, which are nodes, place the points of a mesh.
#pragma once

#include "core/result.h"
#include "mesh/gltf_matrix.h"
#include "mesh/gltf_model.h"
#include "mesh/gltf_numbers.h"

#include <memory>
#include <optional>
#include <vector>

namespace cascade {

/// Where nodes are in the scene, wherever it begins.
class GltfNodePlaces {
public:
    explicit GltfNodePlaces(const tinygltf::Model& model);

    /// Fails if there is no such node, or if it is below itself.
    Result<GltfMatrix> of(int node);

private:
    const tinygltf::Model& model_;
    std::vector<int> parents_;                       ///< −1: none.
    std::vector<std::optional<GltfMatrix>> places_;  ///< As far as they were asked for.
};

/// The matrix of a node, or that of its translation, rotation and scale.
GltfMatrix matrix_of_node(const tinygltf::Node& node);

/// What each joint of a skin does to points of its mesh. Fails if joints or their matrices are not
/// there.
Result<std::vector<GltfMatrix>> joints_of_skin(const tinygltf::Model& model, int skin,
                                               GltfNodePlaces& places);

/// How the points of a primitive hang from joints, in sets of four.
class GltfWeights {
public:
    /// `is_there` is false if the primitive has no weights. Fails on weights for fewer points than
    /// `count`, and if they lie beyond the data.
    static Result<GltfWeights> of(const tinygltf::Model& model,
                                  const tinygltf::Primitive& primitive, std::size_t count);

    bool is_there() const { return !sets_.empty(); }
    std::size_t sets() const { return sets_.size(); }
    /// The mean of the joints' matrices by the weights of a point, which need not have the sum 1.
    /// Without any weight the first joint has all. Fails if a joint is not there.
    Result<GltfMatrix> matrix_at(std::size_t point, const std::vector<GltfMatrix>& joints) const;

private:
    struct Set {
        GltfNumbers joints, weights;
    };
    std::vector<Set> sets_;
};

}  // namespace cascade

// Copies of a glTF node's mesh, by the extension EXT_mesh_gpu_instancing.
#pragma once

#include "core/result.h"
#include "mesh/gltf_matrix.h"
#include "mesh/gltf_model.h"
#include "mesh/gltf_numbers.h"

#include <array>
#include <optional>

namespace cascade {

class GltfInstances {
public:
    /// `is_there` is false if the node has no copies. Fails if attributes have
    /// different lengths, if their data lie beyond the file, or if no attribute has data.
    static Result<GltfInstances> of(const tinygltf::Model& model, const tinygltf::Node& node);

    bool is_there() const { return count_.has_value(); }
    std::size_t count() const { return count_.value_or(0); }
    /// The position of a copy in the coordinates of the node.
    GltfMatrix matrix(std::size_t copy) const;
    /// The light by which a copy's colour is multiplied, from the attribute `_COLOR_0`. three.js
    /// and Babylon.js use this attribute in the same way. nullopt if the copies lack the attribute.
    std::optional<std::array<double, 3>> light(std::size_t copy) const;

private:
    std::optional<std::size_t> count_;
    std::optional<GltfNumbers> translation_, rotation_, scale_, colour_;
};

}  // namespace cascade

// Which texture coordinates of a glTF file are read, and how they are transformed.
#pragma once

#include "mesh/gltf_model.h"
#include "mesh/polygon_soup.h"

#include <array>
#include <string>

namespace cascade {

struct GltfTexture {
    std::string attribute = "TEXCOORD_0";  ///< Its name in a primitive.
    /// The first two rows of the matrix by which places become those of the picture, as in the
    /// extension KHR_texture_transform.
    std::array<double, 6> rows = {1, 0, 0, 0, 1, 0};

    /// From glTF's coordinates, whose origin is at the upper left.
    TexturePlace place(double u, double v) const;
};

/// As the material's texture of base colours has them, or, without one, the first of its textures
/// of normals, roughness, light and occlusion. If the primitive has no such set, the first set as
/// it is.
GltfTexture texture_of(const tinygltf::Model& model, const tinygltf::Primitive& primitive);

}  // namespace cascade

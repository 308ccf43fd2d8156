// The choice of texture coordinates in a glTF file, and their transformation.
#pragma once

#include "mesh/gltf_model.h"
#include "mesh/polygon_soup.h"

#include <array>
#include <string>

namespace cascade {

struct GltfTexture {
    std::string attribute = "TEXCOORD_0";  ///< The attribute's name in a primitive.
    /// The first two rows of the matrix that maps texture coordinates to those of the picture, as
    /// in the extension KHR_texture_transform.
    std::array<double, 6> rows = {1, 0, 0, 0, 1, 0};

    /// Converts glTF's coordinates, whose origin is at the upper left.
    TexturePlace place(double u, double v) const;
};

/// The texture coordinates of the material's base colour, or, without one, of the first of its
/// textures of normals, roughness, light and occlusion. If the primitive has no such set, its first
/// set without a transformation.
GltfTexture texture_of(const tinygltf::Model& model, const tinygltf::Primitive& primitive);

}  // namespace cascade

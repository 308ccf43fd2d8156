// Finds which texture coordinates of a glTF file to use, and their transformation.
#pragma once

#include "mesh/gltf_model.h"
#include "mesh/polygon_soup.h"

#include <array>
#include <string>

namespace cascade {

struct GltfTexture {
    std::string attribute = "TEXCOORD_0";  ///< The attribute's name in a primitive.
    /// The first two rows of the matrix that maps texture coordinates to coordinates of the
    /// picture, as in the extension KHR_texture_transform.
    std::array<double, 6> rows = {1, 0, 0, 0, 1, 0};

    /// Converts coordinates of glTF, whose origin is the upper left corner of the picture, to a
    /// TexturePlace, whose origin is the lower left corner.
    TexturePlace place(double u, double v) const;
};

/// Selects the texture coordinates of the material's base colour. If there is no such texture,
/// selects the texture coordinates of the first texture that exists among normals, roughness, light
/// and occlusion. If the primitive lacks the selected set, selects the primitive's first set
/// without a transformation.
GltfTexture texture_of(const tinygltf::Model& model, const tinygltf::Primitive& primitive);

}  // namespace cascade

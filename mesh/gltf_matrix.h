// Transformations in the form of glTF.
#pragma once

#include "core/vector3.h"

#include <array>
#include <vector>

namespace cascade {

/// A 4 × 4 matrix, column by column.
using GltfMatrix = std::array<double, 16>;
inline constexpr GltfMatrix gltf_identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/// The transformation that first applies b and then a.
GltfMatrix product(const GltfMatrix& a, const GltfMatrix& b);

Vector3d moved_by(const GltfMatrix& matrix, Vector3d p);

/// A scale, then a rotation (a quaternion with its real part last), then a translation. Each vector
/// may be empty.
GltfMatrix matrix_of_parts(const std::vector<double>& translation,
                           const std::vector<double>& rotation, const std::vector<double>& scale);

}  // namespace cascade

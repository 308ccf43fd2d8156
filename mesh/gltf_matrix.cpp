// A matrix has the images of the axes and of the origin as its columns.
#include "mesh/gltf_matrix.h"

namespace cascade {

GltfMatrix product(const GltfMatrix& a, const GltfMatrix& b) {
    GltfMatrix result{};
    for (std::size_t column = 0; column < 4; ++column) {
        for (std::size_t row = 0; row < 4; ++row) {
            for (std::size_t k = 0; k < 4; ++k) {
                result[4 * column + row] += a[4 * k + row] * b[4 * column + k];
            }
        }
    }
    return result;
}

Vector3d moved_by(const GltfMatrix& m, Vector3d p) {
    const auto row = [&](std::size_t k) {
        return m[k] * p.x + m[4 + k] * p.y + m[8 + k] * p.z + m[12 + k];
    };
    return {row(0), row(1), row(2)};
}

GltfMatrix matrix_of_parts(const std::vector<double>& translation,
                           const std::vector<double>& rotation, const std::vector<double>& scale) {
    GltfMatrix matrix = gltf_identity;
    if (rotation.size() == 4) {
        const double x = rotation[0], y = rotation[1], z = rotation[2], w = rotation[3];
        // clang-format off
        matrix = {1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 0,
                  2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w), 0,
                  2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y), 0,
                  0, 0, 0, 1};
        // clang-format on
    }
    if (scale.size() == 3) {
        for (std::size_t k = 0; k < 12; ++k) matrix[k] *= scale[k / 4];
    }
    if (translation.size() == 3) {
        for (std::size_t k = 0; k < 3; ++k) matrix[12 + k] = translation[k];
    }
    return matrix;
}

}  // namespace cascade

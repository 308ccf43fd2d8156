// A table of tapered bones whose distances are blended by the logarithm of a sum of exponentials.
#include "mesh/creature.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace cascade {

namespace {

constexpr double soft = 0.035, firm = 0.018;

// from, to, radii, softness, paired, continues.
constexpr std::array bones = {
    // Trunk: hips, belly, chest.
    Bone{{0, 0.70, -0.36}, {0, 0.66, -0.04}, 0.205, 0.222, soft, false, false},
    Bone{{0, 0.66, -0.04}, {0, 0.71, 0.28}, 0.222, 0.205, soft, false, true},
    // Neck; skull, muzzle, eyes.
    Bone{{0, 0.80, 0.36}, {0, 1.06, 0.53}, 0.135, 0.115, soft, false, false},
    Bone{{0, 1.17, 0.53}, {0, 1.15, 0.60}, 0.190, 0.175, soft, false, false},
    Bone{{0, 1.09, 0.70}, {0, 1.07, 0.80}, 0.110, 0.095, soft, false, false},
    Bone{{0.090, 1.225, 0.702}, {0.094, 1.220, 0.716}, 0.036, 0.032, 0.006, true, false},
    // Ears.
    Bone{{0.135, 1.295, 0.50}, {0.200, 1.385, 0.480}, 0.068, 0.082, firm, true, false},
    // Front legs: shoulder, leg, foot.
    Bone{{0.10, 0.64, 0.26}, {0.132, 0.36, 0.28}, 0.132, 0.092, soft, true, false},
    Bone{{0.132, 0.36, 0.28}, {0.135, 0.08, 0.28}, 0.092, 0.078, soft, true, true},
    Bone{{0.135, 0.065, 0.29}, {0.137, 0.060, 0.34}, 0.080, 0.068, firm, true, false},
    // Hind legs: thigh, shank, shin, foot.
    Bone{{0.10, 0.66, -0.37}, {0.135, 0.42, -0.33}, 0.160, 0.108, soft, true, false},
    Bone{{0.135, 0.42, -0.33}, {0.138, 0.26, -0.41}, 0.108, 0.084, soft, true, true},
    Bone{{0.138, 0.26, -0.41}, {0.138, 0.08, -0.40}, 0.084, 0.076, soft, true, true},
    Bone{{0.138, 0.065, -0.39}, {0.140, 0.060, -0.34}, 0.080, 0.068, firm, true, false},
    // Tail, with a tuft.
    Bone{{0, 0.80, -0.52}, {0, 0.825, -0.64}, 0.056, 0.050, firm, false, false},
    Bone{{0, 0.825, -0.64}, {0, 0.885, -0.735}, 0.050, 0.046, firm, false, true},
    Bone{{0, 0.885, -0.735}, {0, 0.985, -0.790}, 0.046, 0.044, firm, false, true},
    Bone{{0, 0.985, -0.790}, {0, 1.100, -0.795}, 0.044, 0.044, firm, false, true},
    Bone{{0, 1.100, -0.795}, {0, 1.205, -0.755}, 0.044, 0.046, firm, false, true},
    Bone{{0, 1.225, -0.742}, {0, 1.285, -0.700}, 0.060, 0.052, firm, false, false},
};

/// The signed distance from a bone's flesh in units of its softness; negative inside.
double distance_from(const Bone& bone, Vector3d p) {
    const double part = nearest_fraction(bone.from, bone.to, p);
    const double radius = bone.from_radius + (bone.to_radius - bone.from_radius) * part;
    return (length(p - bone.from - (bone.to - bone.from) * part) - radius) / bone.softness;
}

}  // namespace

std::span<const Bone> creature_bones() { return bones; }

double creature_function(Vector3d p) {
    // The largest term is factored out, so that far away nothing underflows.
    std::array<double, 2 * bones.size()> terms{};
    std::size_t count = 0;
    for (const Bone& bone : bones) {
        const std::size_t sides = bone.is_paired ? 2 : 1;
        if (bone.continues) count -= sides;
        for (std::size_t side = 0; side < sides; ++side) {
            const double term = -distance_from(bone, {side == 0 ? p.x : -p.x, p.y, p.z});
            terms[count] = bone.continues ? std::max(terms[count], term) : term;
            ++count;
        }
    }
    const double largest = *std::max_element(terms.begin(), terms.begin() + count);
    double sum = 0;
    for (std::size_t k = 0; k < count; ++k) sum += std::exp(terms[k] - largest);
    return largest + std::log(sum);
}

Result<SurfaceMesh> creature_mesh(double edge, const std::atomic<bool>& cancel) {
    const auto function = [](std::span<const Vector3d> points, std::span<double> values) {
        std::transform(points.begin(), points.end(), values.begin(), creature_function);
    };
    const ImplicitRequest request{{-0.45, -0.2, -1}, {0.45, 1.7, 1.1}, edge};
    Result<SurfaceMesh> mesh = implicit_surface(function, request, cancel);
    if (!mesh) return mesh;
    const double ground = facts_of(*mesh).low.y;
    for (Vector3d& p : mesh->points) p.y -= ground;
    return mesh;
}

}  // namespace cascade

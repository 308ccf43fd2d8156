// Rejection sampling: points that are uniform in a ball have directions that are uniform, and so
// have their projections to a plane. This needs no sine, whose last bits would depend on the
// machine.
#include "tissue/random_direction.h"

#include "core/hash.h"

namespace cascade {

Vector3d random_direction(const DirectionKey& key, Vector3d normal) {
    const auto symmetric = [](std::uint32_t word) { return (word + 0.5) * 0x1p-31 - 1; };
    // Half of the attempts succeed, so the last attempt is practically never reached.
    for (std::uint32_t attempt = 0; attempt < 64; ++attempt) {
        const auto words = pcg4d({key.mother, key.child, key.seed, key.stage * 64 + attempt});
        const Vector3d point{symmetric(words[0]), symmetric(words[1]), symmetric(words[2])};
        if (dot(point, point) > 1) continue;
        const Vector3d shadow = point - normal * dot(point, normal);
        if (dot(shadow, shadow) > 1e-4) return unit(shadow);
    }
    return unit(cross(normal, std::abs(normal.x) < 0.5 ? Vector3d{1, 0, 0} : Vector3d{0, 1, 0}));
}

}  // namespace cascade

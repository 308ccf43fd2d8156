// Computes random positions by hashing. Each position takes four random words. The fourth word
// decides whether the position is accepted.
#include "tissue/founders.h"

#include "core/hash.h"
#include "surface/scatter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cascade {
namespace {

constexpr std::size_t most_tries = 10'000;  ///< The largest number of positions tried per founder.

double fraction(std::uint32_t word) { return (word + 0.5) * 0x1p-32; }

/// Random positions of the surroundings. Each is determined by its index.
class FounderPlaces {
public:
    FounderPlaces(const Surroundings& surroundings, std::uint32_t seed, std::uint32_t stage)
        : surroundings_(surroundings), mesh_(surroundings.mesh()), seed_(seed), stage_(stage) {
        for (std::size_t t = 0; mesh_ != nullptr && t < mesh_->triangles.size(); ++t) {
            areas_.push_back((t == 0 ? 0 : areas_.back()) + mesh_->area(t));
        }
    }

    struct Candidate {
        NearPlace place;
        /// The position is accepted if its chance is larger than this number.
        double threshold = 0;
    };
    Candidate at(std::uint64_t number) const {
        const auto low = static_cast<std::uint32_t>(number);
        const auto high = static_cast<std::uint32_t>(number >> 32);
        const auto words = pcg4d({low, high ^ 0x66e6, seed_, stage_});
        const auto [a, b, c] =
            std::array{fraction(words[0]), fraction(words[1]), fraction(words[2])};
        Candidate candidate;
        candidate.threshold = fraction(words[3]);
        if (mesh_ == nullptr) {
            const Vector3d extent = surroundings_.extent();
            candidate.place = surroundings_.near({a * extent.x, b * extent.y, c * extent.z},
                                                 NearPlace::no_triangle);
            return candidate;
        }
        const auto found = std::upper_bound(areas_.begin(), areas_.end() - 1, a * areas_.back());
        const SurfacePlace place{static_cast<std::uint32_t>(found - areas_.begin()),
                                 place_in_triangle(b, c)};
        candidate.place = surroundings_.near(position_of(*mesh_, place), place.triangle);
        return candidate;
    }

private:
    const Surroundings& surroundings_;
    const SurfaceMesh* mesh_;
    std::uint32_t seed_, stage_;
    std::vector<double> areas_;  ///< Running sums of the triangles' areas.
};

}  // namespace

Result<std::vector<NearPlace>> random_founders(const Surroundings& surroundings, std::size_t count,
                                               std::uint32_t seed, std::uint32_t stage,
                                               const FounderChance& chance) {
    const FounderPlaces places(surroundings, seed, stage);
    std::vector<NearPlace> founders;
    std::uint64_t tried = 0;
    while (founders.size() < count) {
        if (tried / most_tries >= count) {
            return failure(
                fmt::format("of {} random positions only {} {} accepted as founders of {}", tried,
                            founders.size(), founders.size() == 1 ? "is" : "are", count),
                "make the chance, from 0 to 1, larger somewhere");
        }
        const std::size_t batch = std::max<std::size_t>(count - founders.size(), 1024);
        std::vector<NearPlace> candidates;
        std::vector<double> thresholds;
        for (std::size_t k = 0; k < batch; ++k) {
            const FounderPlaces::Candidate candidate = places.at(tried++);
            candidates.push_back(candidate.place);
            thresholds.push_back(candidate.threshold);
        }
        const std::vector<double> chances =
            chance ? chance(candidates) : std::vector<double>(batch, 1);
        for (std::size_t k = 0; k < batch && founders.size() < count; ++k) {
            if (chances[k] > thresholds[k]) founders.push_back(candidates[k]);
        }
    }
    return founders;
}

std::vector<NearPlace> founders_at(const Surroundings& surroundings,
                                   std::span<const Vector3d> points) {
    std::vector<NearPlace> places;
    for (const Vector3d& point : points) {
        const NearPlace first = surroundings.near(point, NearPlace::no_triangle);
        const Vector3d inside = surroundings.held_inside(first.position, first);
        places.push_back(surroundings.near(inside, first.place.triangle));
    }
    return places;
}

std::array<double, 4> rotation_to(Vector3d ey, Vector3d ez) {
    const auto usable = [](Vector3d v) { return is_finite(v) && length(v) > 1e-12; };
    const auto across = [](Vector3d v) {
        return cross(v, std::abs(v.x) < 0.5 ? Vector3d{1, 0, 0} : Vector3d{0, 1, 0});
    };
    const Vector3d y = usable(ey) ? unit(ey) : Vector3d{0, 1, 0};
    Vector3d z = usable(ez) ? unit(ez) : Vector3d{};
    z = z - y * dot(y, z);
    z = unit(length(z) > 1e-6 ? z : across(y));
    const Vector3d x = cross(y, z);
    // Divides by the largest component (S. Shepperd, "Quaternion from rotation matrix", Journal of
    // Guidance and Control 1, 1978).
    const std::array<double, 4> squares{x.x + y.y + z.z, x.x - y.y - z.z, y.y - x.x - z.z,
                                        z.z - x.x - y.y};
    const auto largest = static_cast<std::size_t>(std::max_element(squares.begin(), squares.end()) -
                                                  squares.begin());
    const double root = std::sqrt(1 + squares[largest]), half = 0.5 / root;
    const Vector3d turn{(y.z - z.y) * half, (z.x - x.z) * half, (x.y - y.x) * half};
    switch (largest) {
        case 0: return {root / 2, turn.x, turn.y, turn.z};
        case 1: return {turn.x, root / 2, (x.y + y.x) * half, (z.x + x.z) * half};
        case 2: return {turn.y, (x.y + y.x) * half, root / 2, (y.z + z.y) * half};
        default: return {turn.z, (z.x + x.z) * half, (y.z + z.y) * half, root / 2};
    }
}

}  // namespace cascade

// Random surfaces that are tiled anew with random places as their points.
#include "core/hash.h"
#include "unit/surface/retiling.h"

#include <gtest/gtest.h>

#include <string>

namespace cascade {
namespace {

using test::never;

/// A sequence of random numbers, computed by hashing.
class Numbers {
public:
    explicit Numbers(std::uint32_t seed) : seed_(seed) {}
    std::uint32_t below(std::uint32_t end) { return pcg4d({seed_, count_++, 0, 7})[0] % end; }
    double uniform() { return pcg4d({seed_, count_++, 0, 7})[0] / 4294967296.0; }

private:
    std::uint32_t seed_, count_ = 0;
};

PolygonSoup soup_from(const SurfaceMesh& mesh) {
    PolygonSoup soup;
    soup.points = mesh.points;
    for (const auto& triangle : mesh.triangles) {
        soup.corners.insert(soup.corners.end(), triangle.begin(), triangle.end());
        soup.ends.push_back(soup.corners.size());
    }
    return soup;
}

/// Triangles between random points, or a crumpled sphere or ring, with or without holes. Files may
/// contain all of these.
Result<MadeMesh> random_mesh(Numbers& numbers) {
    PolygonSoup soup;
    const std::uint32_t kind = numbers.below(4);
    if (kind == 0) {
        const std::uint32_t points = 4 + numbers.below(9), triangles = 1 + numbers.below(30);
        for (std::uint32_t k = 0; k < points; ++k) {
            soup.points.push_back({numbers.uniform(), numbers.uniform(), numbers.uniform()});
        }
        for (std::uint32_t t = 0; t < triangles; ++t) {
            for (int k = 0; k < 3; ++k) soup.corners.push_back(numbers.below(points));
            soup.ends.push_back(soup.corners.size());
        }
        return make_mesh(std::move(soup));
    }
    soup = kind == 1 ? test::torus_soup(3 + numbers.below(8), 3 + numbers.below(6))
                     : soup_from(test::sphere(static_cast<int>(1 + numbers.below(4))));
    const double noise = numbers.below(3) * 0.2;
    for (Vector3d& p : soup.points) {
        p = p + Vector3d{numbers.uniform(), numbers.uniform(), numbers.uniform()} * noise;
    }
    if (numbers.below(2) == 0) return make_mesh(std::move(soup));
    PolygonSoup some;
    some.points = soup.points;
    for (std::size_t k = 0; k < soup.polygon_count(); ++k) {
        if (numbers.below(5) == 0) continue;
        const auto corners = soup.polygon(k);
        some.corners.insert(some.corners.end(), corners.begin(), corners.end());
        some.ends.push_back(some.corners.size());
    }
    return make_mesh(std::move(some));
}

SurfacePlace random_place(Numbers& numbers, const SurfaceMesh& mesh) {
    SurfacePlace place{numbers.below(static_cast<std::uint32_t>(mesh.triangles.size())), {}};
    const std::uint32_t kind = numbers.below(6), k = numbers.below(3);
    const double part = kind == 1 ? 0.5 : numbers.uniform();
    const double height = kind < 3 ? 0 : kind == 3 ? 1e-9 : numbers.uniform();
    place.weights[k] = height;
    place.weights[(k + 1) % 3] = kind == 0 ? 1 : part * (1 - height);
    place.weights[(k + 2) % 3] = 1 - place.weights[k] - place.weights[(k + 1) % 3];
    return place;
}

TEST(Retile, AnyPlacesOnAnySurface) {
    std::size_t tried = 0, kept = 0;
    for (std::uint32_t seed = 0; seed < 3000 && !HasFailure(); ++seed) {
        Numbers numbers(seed);
        const Result<MadeMesh> made = random_mesh(numbers);
        if (!made) continue;
        ++tried;
        SCOPED_TRACE("seed " + std::to_string(seed));
        std::vector<SurfacePlace> places;
        const std::uint32_t count = numbers.below(3) == 0 ? numbers.below(8) : numbers.below(80);
        for (std::uint32_t k = 0; k < count; ++k) {
            const bool is_again = k > 0 && numbers.below(6) == 0;
            places.push_back(is_again ? places[numbers.below(k)]
                                      : random_place(numbers, made->mesh));
        }
        const Result<Retiled> retiled = retile(made->mesh, places, never);
        ASSERT_TRUE(retiled) << retiled.error().message;
        test::expect_same_topology(made->mesh, *retiled, count);
        EXPECT_LT(test::farthest_moved(made->mesh, places, *retiled), 1e-3);
        kept += retiled->kept.size();
    }
    EXPECT_GT(tried, 2900u);
    EXPECT_GT(kept, 0u);
}

}  // namespace
}  // namespace cascade

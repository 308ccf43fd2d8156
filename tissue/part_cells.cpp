// Sorts cells by position. Cells at the same position then follow each other.
#include "tissue/part_cells.h"

#include "tissue/random_direction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace cascade {

namespace {

constexpr double part_of_radius = 0.01;

struct CellAt {
    std::array<double, 3> key{};  ///< The position, moved by whole periods into the first period.
    std::uint32_t number = 0, cell = 0;
};

CellAt at_of(const Tissue& tissue, const TissueSpecies& species,
             const std::array<double, 3>& period, std::uint32_t cell) {
    CellAt result{{}, tissue.numbers()[cell], cell};
    for (std::size_t k = 0; k < 3; ++k) {
        const double at = tissue.value(species.place + k, cell);
        result.key[k] = period[k] > 0 ? at - std::floor(at / period[k]) * period[k] : at;
    }
    return result;
}

bool stays(const Tissue& tissue, const TissueSpecies& species, std::uint32_t cell) {
    return tissue.is_frozen(cell) || !(tissue.value(species.radius, cell) > 0);
}

}  // namespace

bool part_cells(Tissue& tissue, const TissueSpecies& species, const Surroundings& surroundings,
                std::uint32_t seed, std::uint32_t stage, std::span<const std::uint32_t> cells) {
    if (!species.crawls) return false;
    std::vector<CellAt> sorted;
    sorted.reserve(cells.size());
    const std::array<double, 3> period = surroundings.period();
    for (const std::uint32_t cell : cells) {
        sorted.push_back(at_of(tissue, species, period, cell));
    }
    std::ranges::sort(sorted, [](const CellAt& a, const CellAt& b) {
        return a.key != b.key ? a.key < b.key : a.number < b.number;
    });
    bool has_moved = false;
    for (std::size_t k = 1; k < sorted.size(); ++k) {
        const auto [key, number, cell] = sorted[k];
        if (key != sorted[k - 1].key || stays(tissue, species, cell)) continue;
        const Vector3d place = place_of(tissue, species, cell);
        const Vector3d normal = surroundings.has_normal()
                                    ? surroundings.near(place, tissue.triangles[cell]).normal
                                    : Vector3d{};
        const Vector3d way = random_direction({seed, stage, number, number}, normal) *
                             (part_of_radius * tissue.value(species.radius, cell));
        const auto held = [&](Vector3d at) {
            return surroundings.held_inside(at, surroundings.near(at, tissue.triangles[cell]));
        };
        // In a corner of the domain, the cell may be able to move only in one of the two opposite
        // directions.
        Vector3d moved = held(place + way);
        if (moved == place) moved = held(place - way);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            tissue.set(species.place + axis, cell, std::array{moved.x, moved.y, moved.z}[axis]);
        }
        has_moved = true;
    }
    return has_moved;
}

}  // namespace cascade

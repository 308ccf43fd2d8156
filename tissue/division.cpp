// Rearranges the tissue once for all simultaneous events, then sets the new positions.
#include "tissue/division.h"

#include "tissue/part_cells.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace cascade {
namespace {

void put(Tissue& tissue, const DivisionPlaces& places, std::size_t cell, Vector3d at) {
    const Surroundings& around = places.surroundings;
    const Vector3d held = around.held_inside(at, around.near(at, tissue.triangles[cell]));
    tissue.set(places.species.place, cell, held.x);
    tissue.set(places.species.place + 1, cell, held.y);
    tissue.set(places.species.place + 2, cell, held.z);
}

/// The order of cells in memory after some have divided and others have died. New cells and the
/// last cells in memory fill the gaps, so that few cells move.
struct NewPlaces {
    NewPlaces(std::size_t count, std::span<const CellEvent> events) : places(count) {
        std::iota(places.begin(), places.end(), std::uint32_t{0});
        sources = places;
        std::vector<std::uint32_t> free;
        for (const CellEvent& event : events) {
            (event.dies ? free : dividing).push_back(event.cell);
        }
        std::sort(free.rbegin(), free.rend());
        for (const std::uint32_t mother : dividing) {
            if (free.empty()) {
                children.push_back(static_cast<std::uint32_t>(sources.size()));
                sources.push_back(mother);
            } else {
                children.push_back(free.back());
                sources[free.back()] = mother;
                free.pop_back();
            }
        }
        // `free` is sorted in descending order.
        for (std::size_t largest = 0; largest < free.size();) {
            const auto last = static_cast<std::uint32_t>(sources.size() - 1);
            if (free[largest] == last) {
                ++largest;
            } else {
                places[last] = free.back();
                sources[free.back()] = last;
                moved.push_back(free.back());
                free.pop_back();
            }
            sources.pop_back();
        }
    }

    std::vector<std::uint32_t> places;  ///< The new index of each surviving cell, by its old index.
    /// By new index: the old index of the cell or, if the cell is new, of its mother.
    std::vector<std::uint32_t> sources;
    /// Old indices of the dividing cells, in the order of the events.
    std::vector<std::uint32_t> dividing;
    /// New indices of the new cells, in the order of `dividing`.
    std::vector<std::uint32_t> children;
    std::vector<std::uint32_t> moved;  ///< New indices of the other cells that have moved.
};

}  // namespace

Divided divide(Tissue& tissue, std::span<const CellEvent> events,
               std::span<const Vector3d> directions, const DivisionPlaces& places) {
    NewPlaces cells(tissue.count(), events);
    const std::vector<std::uint32_t>& dividing = cells.dividing;
    Divided result;
    result.has_moved = tissue.rearrange(cells.sources, cells.children);
    result.moved = std::move(cells.moved);
    tissue.births += static_cast<std::int64_t>(dividing.size());
    tissue.deaths += static_cast<std::int64_t>(events.size() - dividing.size());
    for (std::size_t n = 0; n < dividing.size(); ++n) {
        const std::uint32_t mother = cells.places[dividing[n]], child = cells.children[n];
        const Vector3d place = place_of(tissue, places.species, mother);
        Vector3d along = n < directions.size() ? unit(directions[n]) : Vector3d{};
        if (!is_finite(along) || length(along) < 0.5) {
            const Surroundings& around = places.surroundings;
            const Vector3d normal = around.has_normal()
                                        ? around.near(place, tissue.triangles[mother]).normal
                                        : Vector3d{};
            along = random_direction({places.seed, places.stage, tissue.numbers()[mother],
                                      tissue.numbers()[child]},
                                     normal);
        }
        const Vector3d half = along * (tissue.value(places.species.radius, mother) / 2);
        put(tissue, places, mother, place - half);
        put(tissue, places, child, place + half);
        // The two cells overlap, so they will push each other.
        tissue.restlessness[mother] = tissue.restlessness[child] = 1;
        result.mothers.push_back(mother);
        result.children.push_back(child);
    }
    std::vector<std::uint32_t> born = result.mothers;
    born.insert(born.end(), result.children.begin(), result.children.end());
    part_cells(tissue, places.species, places.surroundings, places.seed, places.stage, born);
    tissue.pad();
    return result;
}

}  // namespace cascade

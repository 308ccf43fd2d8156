// Rearranges the tissue once for all events of a moment, then sets the new places.
#include "tissue/division.h"

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

}  // namespace

Divided divide(Tissue& tissue, std::span<const CellEvent> events,
               std::span<const Vector3d> directions, const DivisionPlaces& places) {
    std::vector<bool> dies(tissue.count(), false);
    std::vector<std::uint32_t> dividing;
    for (const CellEvent& event : events) {
        if (event.dies) {
            dies[event.cell] = true;
        } else {
            dividing.push_back(event.cell);
        }
    }
    std::vector<std::uint32_t> sources, new_place(tissue.count());
    for (std::uint32_t cell = 0; cell < tissue.count(); ++cell) {
        new_place[cell] = static_cast<std::uint32_t>(sources.size());
        if (!dies[cell]) sources.push_back(cell);
    }
    const std::size_t survivors = sources.size();
    sources.insert(sources.end(), dividing.begin(), dividing.end());

    Divided result;
    result.has_moved = tissue.rearrange(sources, survivors);
    tissue.births += static_cast<std::int64_t>(dividing.size());
    tissue.deaths += static_cast<std::int64_t>(events.size() - dividing.size());
    for (std::size_t n = 0; n < dividing.size(); ++n) {
        const std::uint32_t mother = new_place[dividing[n]];
        const auto child = static_cast<std::uint32_t>(survivors + n);
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
        // They overlap, and will push each other.
        tissue.restlessness[mother] = tissue.restlessness[child] = 1;
        result.mothers.push_back(mother);
        result.children.push_back(child);
    }
    tissue.pad();
    return result;
}

}  // namespace cascade

// Sorts cells by octaves of their radii. Each octave has its own boxes.
#include "tissue/neighbour_search.h"

#include "core/check.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cascade {
namespace {

constexpr std::size_t most_levels = 32;

}  // namespace

NeighbourSearch::NeighbourSearch(const CellPlaces& cells, const NeighbourRule& rule, double skin)
    : rule_(rule) {
    CHECK(cells.places.size() == cells.radii.size() && cells.places.size() == cells.ranks.size(),
          "each cell has a radius and a rank");
    for (std::uint32_t cell = 0; cell < cells.places.size(); ++cell) {
        const double own = cells.skins.empty() ? skin : double{cells.skins[cell]};
        entries_.push_back(boxed(cells, cell, rule, own));
        widest_ = std::max(widest_, width_of(entries_.back(), rule));
    }
    if (widest_ == 0) return;
    std::vector<std::vector<BoxedCell>> octaves(most_levels);
    levels_.resize(entries_.size());
    for (const BoxedCell& entry : entries_) {
        const double width = width_of(entry, rule);
        const int octave = width > 0 ? std::ilogb(widest_ / width) : most_levels;
        const auto level = std::min(static_cast<std::size_t>(octave), most_levels - 1);
        levels_[entry.cell] = static_cast<std::uint8_t>(level);
        octaves[level].push_back(entry);
    }
    for (std::size_t level = 0; level < most_levels; ++level) {
        if (octaves[level].empty()) continue;
        boxes_.emplace_back(std::move(octaves[level]), rule);
        level_of_boxes_.push_back(static_cast<std::uint8_t>(level));
    }
}

std::size_t NeighbourSearch::find(std::uint32_t cell, NeighbourKeys& found) const {
    found.clear();
    std::size_t larger = 0;
    for (std::size_t k = 0; k < boxes_.size() && level_of_boxes_[k] <= levels_[cell]; ++k) {
        if (level_of_boxes_[k] == levels_[cell]) larger = found.count();
        boxes_[k].find(entries_[cell], found);
    }
    return larger;
}

double NeighbourSearch::estimated_links() const {
    const std::size_t stride = (count() + 63) / 64;
    std::size_t links = 0, looked_at = 0;
    NeighbourKeys found;
    for (std::size_t cell = 0; cell < count(); cell += stride, ++looked_at) {
        const std::size_t larger = find(static_cast<std::uint32_t>(cell), found);
        links += found.count() + larger;
    }
    return static_cast<double>(links) * static_cast<double>(count()) /
           static_cast<double>(std::max<std::size_t>(looked_at, 1));
}

}  // namespace cascade

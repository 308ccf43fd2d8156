// What cells look like at any place of the surface.
#pragma once

#include "core/palette.h"
#include "core/parallel.h"
#include "surface/cell_filter.h"

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace cascade {

/// A colour (sRGB) out of the values of all channels at a place. Called from several threads at
/// once; must not throw.
using PlaceColour = std::function<Colour(std::span<const float> values, const SurfacePlace& place)>;

/// What is seen on the cells. Everything it refers to must stay while it is used.
struct PaintedCells {
    std::size_t channels = 1;
    std::span<const float> values;  ///< `channels` a cell, cell after cell.
    /// Where a channel of a colour is NaN the colour is that of NaN.
    PlaceColour colour;
    /// One a cell: how far it stands out, in the unit of the mesh. Empty: nothing does.
    std::span<const float> heights;
};

/// Looks at places, one thread at a time.
class PlacePainter {
public:
    PlacePainter(const CellFilter& filter, const PaintedCells& cells)
        : filter_(filter), cells_(cells), values_(cells.channels) {}

    struct Look {
        Colour colour;
        float height = 0;
    };
    /// The colour of the filtered values, and the filtered height.
    Look at(const SurfacePlace& place);

    /// How fast the height grows, as a vector in the plane of the triangle. Exactly 0 where heights
    /// are the same all around.
    Vector3d rise_at(const SurfacePlace& place);

private:
    const CellFilter& filter_;
    const PaintedCells& cells_;
    std::vector<float> values_;
    std::vector<CellShare> shares_;
    std::vector<SlopedShare> slopes_;
};

/// The colours of places. The same on any number of threads. Throws std::bad_alloc.
std::vector<Colour> colours_at(std::span<const SurfacePlace> places, const CellFilter& filter,
                               const PaintedCells& cells, Team& team);

}  // namespace cascade

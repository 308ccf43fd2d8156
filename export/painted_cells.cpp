// Filters the values of nearby cells (surface/cell_filter), then computes a colour from the
// filtered values. So values are blended, not colours.
#include "export/painted_cells.h"

#include "export/channels.h"
#include "picture/srgb.h"

#include <algorithm>

namespace cascade {

PlacePainter::PlacePainter(const CellFilter& filter, const PaintedCells& cells)
    : filter_(filter), cells_(cells) {
    for (std::size_t k = 0; k < material_parts; ++k) {
        if (!cells.material[k].empty()) parts_.push_back(static_cast<MaterialPart>(k));
    }
    values_.resize(number_of_values());
}

PlacePainter::Look PlacePainter::at(const SurfacePlace& place) {
    filter_at(place, values_);
    return look_of(values_, place);
}

void PlacePainter::filter_at(const SurfacePlace& place, std::span<float> values) {
    filter_.shares(place, shares_);
    std::fill(values.begin(), values.end(), 0.0F);
    for (const CellShare& share : shares_) {
        const std::size_t first = share.cell * cells_.channels;
        for (std::size_t c = 0; c < cells_.channels; ++c) {
            values[c] += share.weight * cells_.values[first + c];
        }
        for (std::size_t k = 0; k < parts_.size(); ++k) {
            values[cells_.channels + k] += share.weight * cells_.material[parts_[k]][share.cell];
        }
        if (!cells_.heights.empty()) values.back() += share.weight * cells_.heights[share.cell];
    }
}

PlacePainter::Look PlacePainter::look_of(std::span<const float> values,
                                         const SurfacePlace& place) const {
    Look look{shown(cells_.colour(values.first(cells_.channels), place)), values.back()};
    for (std::size_t k = 0; k < parts_.size(); ++k) {
        look.material[parts_[k]] = values[cells_.channels + k];
    }
    return look;
}

Vector3d PlacePainter::rise_at(const SurfacePlace& place) {
    filter_.sloped_shares(place, slopes_);
    const auto height = [&](const SlopedShare& share) {
        return static_cast<double>(cells_.heights[share.cell]);
    };
    Vector3d rise;
    for (const SlopedShare& share : slopes_) {
        const Vector3d slope = {static_cast<double>(share.slope.x),
                                static_cast<double>(share.slope.y),
                                static_cast<double>(share.slope.z)};
        rise = rise + slope * ((height(share) - height(slopes_[0])) / filter_.radius());
    }
    return rise;
}

OfParts<float> in_light(OfParts<float> material) {
    for (const auto part : {MaterialPart::red, MaterialPart::green, MaterialPart::blue}) {
        material[part] = light_of(material[part]);
    }
    return material;
}

std::vector<Colour> colours_at(std::span<const SurfacePlace> places, const CellFilter& filter,
                               const PaintedCells& cells, Team& team) {
    std::vector<Colour> colours(places.size());
    team.run([&](int index) {
        const RowRange mine =
            split_rows(static_cast<std::int64_t>(places.size()), index, team.size());
        PlacePainter painter(filter, cells);
        for (auto p = static_cast<std::size_t>(mine.begin); p < static_cast<std::size_t>(mine.end);
             ++p) {
            colours[p] = painter.at(places[p]).colour;
        }
    });
    return colours;
}

}  // namespace cascade

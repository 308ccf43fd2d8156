// Copies cells row by row.
#include "run/pictures/plane_look.h"

#include "run/domain/metric_planes.h"

#include <utility>

namespace cascade {

namespace {

std::vector<double> in_rows_of_picture(const Field& field) {
    const PlaneLayout& layout = field.layout();
    std::vector<double> values;
    values.reserve(static_cast<std::size_t>(layout.width * layout.height));
    for (std::int64_t j = 0; j < layout.height; ++j) {
        for (std::int64_t i = 0; i < layout.width; ++i) values.push_back(field.number_at(i, j));
    }
    return values;
}

}  // namespace

PlaneLook::PlaneLook(const Canvas& canvas, ValueRange range, const Palette& palette,
                     FlatCells plane)
    : CellLook(canvas, range, palette, in_rows_of_picture), cells(std::move(plane)) {
    material = Material(canvas.material, in_rows_of_picture, cells.inside);
    heights = std::move(material.heights);
    if (cells.inside.empty()) return;
    std::vector<float>& opacity = material.parts[MaterialPart::opacity];
    if (opacity.empty()) opacity.assign(cells.count(), 1.0F);
    for (std::size_t k = 0; k < opacity.size(); ++k) {
        if (cells.inside[k] == 0) opacity[k] = 0;
    }
}

GridMaterial grid_material(const Canvas& canvas, const DomainSettings& domain) {
    const PlaneLayout& layout = canvas.fields[0].layout();
    GridMaterial result{Material(canvas.material, in_rows_of_picture), layout.width, layout.height};
    result.is_periodic_x = domain.grid.boundary.x == Boundary::periodic;
    result.is_periodic_y = domain.grid.boundary.y == Boundary::periodic;
    // In a domain that grows, the unit becomes shorter in coordinates of the surface.
    if (const auto unit = unit_of(*domain.surface, domain.grid)) {
        result.unit = *unit / canvas.scales[0];
    }
    result.detail = domain.detail;
    return result;
}

}  // namespace cascade

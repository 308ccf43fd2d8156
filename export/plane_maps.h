// Maps of a plane of cells: textures of any size, which repeat along the axes along which the plane
// is periodic.
#pragma once

#include "export/flat_cells.h"
#include "export/material_maps.h"
#include "export/painted_cells.h"
#include "mesh/surface_mesh.h"

namespace cascade {

/// The size of a plane's texture, in texels across and down. The longer side has `texels` texels,
/// and the other side is in proportion, but at least 1.
std::array<std::int64_t, 2> texture_size(const FlatCells& cells, std::int64_t texels);

/// The maps of a plane. Values between cells lie on cubic curves that stay in range at edges
/// (core/between_cells.h). Colours are computed from these values. A texel is the mean of its
/// samples, with colours in linear light. There are four samples per texel or, in small textures,
/// at least one per cell. Normals belong to the surface that is raised by the texels' heights.
/// Cells outside the domain get the values of their surroundings. A height that is not finite is
/// replaced in the same way. The function `painted.colour` is called without a meaningful position.
/// `size` is in texels across and down. The result is the same with any number of threads. Throws
/// std::bad_alloc.
MaterialMaps bake_plane(const FlatCells& cells, const PaintedCells& painted,
                        std::array<std::int64_t, 2> size, Team& team);

/// A rectangle around the origin that has the plane's size and faces z, with y upwards and texture
/// coordinates from 0 to 1.
SurfaceMesh plane_mesh(const FlatCells& cells);

}  // namespace cascade

// Maps of a plane of cells: textures of any size, which repeat where its sides do.
#pragma once

#include "export/flat_cells.h"
#include "export/material_maps.h"
#include "export/painted_cells.h"
#include "mesh/surface_mesh.h"

namespace cascade {

/// The size of a plane's texture whose longer side has this many texels. The other side is in
/// proportion, and at least 1.
std::array<std::int64_t, 2> texture_size(const FlatCells& cells, std::int64_t texels);

/// The maps of a plane. Values between cells lie on cubic curves that stay in range at edges
/// (core/between_cells.h). Colours are computed from the values there. A texel is the mean of its
/// samples, with colours in linear light. There are four samples or, in small textures, one or more
/// for each cell. Normals belong to the surface raised by the texels' heights. Cells outside take
/// values from their surroundings, as do non-finite heights. `colour` gets no position. `size` is
/// in texels across and down. The same on any number of threads. Throws std::bad_alloc.
MaterialMaps bake_plane(const FlatCells& cells, const PaintedCells& painted,
                        std::array<std::int64_t, 2> size, Team& team);

/// A rectangle of the plane's size around the origin that faces z, y upwards, with texture
/// coordinates from 0 to 1.
SurfaceMesh plane_mesh(const FlatCells& cells);

}  // namespace cascade

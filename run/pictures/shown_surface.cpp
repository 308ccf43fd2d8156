// Refines models in the same way as for files with colours of vertices. The values at vertices are
// computed by the cell filter.
#include "run/pictures/shown_surface.h"

#include "export/refine.h"
#include "mesh/coarse_copy.h"
#include "mesh/normals.h"
#include "mesh/triangle_mesh.h"
#include "run/domain/metric_planes.h"
#include "run/pictures/surface_lattice.h"
#include "run/pictures/tissue_picture.h"
#include "surface/blur_cells.h"
#include "surface/nearest_place.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace cascade {

namespace {

constexpr std::size_t most_shown_triangles = std::size_t{1} << 20;

/// The longest edge, as a multiple of the distance between cells. Along such an edge the filter is
/// nearly linear, because the radius of the filter is two distances between cells.
constexpr double longest_edge = 0.75;

/// The smallest number of quadrilaterals along a side of a function's surface. With fewer, the
/// outline would not be smooth.
constexpr double least_facets = 160;

/// Returns a copy of the mesh in which a point has been divided so that it has a single normal. So
/// creases become boundaries.
SurfaceMesh cut_at_creases(const SurfaceMesh& mesh, const CornerNormals& corners) {
    SurfaceMesh cut;
    for (const std::uint32_t point : corners.points) cut.points.push_back(mesh.points[point]);
    cut.triangles = corners.numbers;
    cut.across = mesh.across;
    for (std::size_t t = 0; t < cut.across.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const TriangleEdge other = mesh.across[t][k];
            if (!other.exists()) continue;
            const auto& mine = corners.numbers[t];
            const auto& theirs = corners.numbers[other.triangle];
            if (mine[k] != theirs[corner_after(other.edge)] ||
                mine[corner_after(k)] != theirs[other.edge]) {
                cut.across[t][k] = {};
            }
        }
    }
    return cut;
}

/// Returns a copy with fewer triangles. Returns an empty optional if the mesh is already small or
/// cannot be copied.
std::optional<SurfaceMesh> reduced(const SurfaceMesh& mesh) {
    if (mesh.triangles.size() <= most_shown_triangles) return std::nullopt;
    // The largest area that triangles may have in the copy, whose edges have been collapsed.
    const double area = mesh.total_area() / static_cast<double>(most_shown_triangles / 2);
    auto copy = coarse_copy(mesh, std::sqrt(area * 4 / std::sqrt(3.0)));
    if (!copy) return std::nullopt;
    return std::move(copy->mesh);
}

ShownSurface shown_model(const ModelCells& model, Team& team) {
    const std::optional<SurfaceMesh> copy = reduced(model.mesh);
    const SurfaceMesh& mesh = copy ? *copy : model.mesh;
    const CornerNormals corners = corner_normals(mesh);
    const RefinedMesh fine =
        refined(cut_at_creases(mesh, corners), longest_edge * cell_spacing(model.spread().cells),
                most_shown_triangles);
    const CellFilter filter(model.mesh, model.spread().cells, team);
    std::optional<NearestPlace> nearest;
    if (copy) nearest.emplace(model.mesh);
    std::vector<std::uint32_t> position_of(model.count());
    for (std::uint32_t k = 0; k < model.count(); ++k) position_of[model.cell_at(k)] = k;
    const ModelBox box(model.mesh);

    ShownSurface shown;
    shown.spacing = cell_spacing(model.spread().cells) / box.longest;
    shown.triangles = fine.mesh.triangles;
    std::vector<CellShare> shares;
    for (std::size_t v = 0; v < fine.places.size(); ++v) {
        const Vector3d point = fine.mesh.points[v];
        shown.positions.push_back(single(box.in_script(point)));
        shown.normals.push_back(single(corners.at(mesh, fine.places[v])));
        filter.shares(nearest ? nearest->find(point).value() : fine.places[v], shares);
        for (const CellShare& share : shares) {
            shown.shares.push_back({position_of[share.cell], share.weight});
        }
        shown.ends.push_back(static_cast<std::uint32_t>(shown.shares.size()));
    }
    return shown;
}

/// Returns a lattice with an even number of quadrilaterals for each cell along both axes, so that
/// there is a vertex at the centre of each cell and half-way between any two neighbours. If there
/// would be too many triangles, the lattice is coarser.
SurfaceLattice lattice_of(const Grid& grid) {
    const auto along = [](std::int64_t cells) {
        const auto side = static_cast<double>(cells);
        return side * std::max(2.0, 2 * std::ceil(least_facets / side / 2));
    };
    double columns = along(grid.width), rows = along(grid.height);
    const double excess = 2 * columns * rows / static_cast<double>(most_shown_triangles);
    if (excess > 1) {
        columns = std::max(1.0, columns / std::sqrt(excess));
        rows = std::max(1.0, rows / std::sqrt(excess));
    }
    return {static_cast<std::uint32_t>(columns), static_cast<std::uint32_t>(rows),
            grid.boundary.x == Boundary::periodic, grid.boundary.y == Boundary::periodic};
}

ShownSurface shown_function(const SurfaceSettings& settings, const Grid& grid) {
    const SurfaceLattice lattice = lattice_of(grid);
    TriangleMesh mesh = surface_lattice(function_of(settings), lattice);
    ShownSurface shown;
    shown.up = Axis::z;
    shown.positions = std::move(mesh.positions);
    shown.normals = std::move(mesh.normals);
    shown.triangles = std::move(mesh.triangles);
    const auto longest = static_cast<double>(grid.longest_side());
    for (std::uint32_t j = 0; j <= lattice.rows; ++j) {
        const double sy = static_cast<double>(j) / lattice.rows;
        const BetweenCells row(sy, grid.height, lattice.is_periodic_y);
        for (std::uint32_t i = 0; i <= lattice.columns; ++i) {
            const double sx = static_cast<double>(i) / lattice.columns;
            const BetweenCells column(sx, grid.width, lattice.is_periodic_x);
            shown.places.push_back(
                {static_cast<float>(sx * static_cast<double>(grid.width) / longest),
                 static_cast<float>(sy * static_cast<double>(grid.height) / longest)});
            const auto add = [&](std::int64_t y, std::int64_t x, float weight) {
                if (weight == 0) return;
                shown.shares.push_back({static_cast<std::uint32_t>(y * grid.width + x), weight});
            };
            add(row.first, column.first, (1 - row.part) * (1 - column.part));
            add(row.first, column.second, (1 - row.part) * column.part);
            add(row.second, column.first, row.part * (1 - column.part));
            add(row.second, column.second, row.part * column.part);
            shown.ends.push_back(static_cast<std::uint32_t>(shown.shares.size()));
        }
    }
    return shown;
}

ShownSurface shown_body(const SurfaceMesh& body) {
    const std::optional<SurfaceMesh> copy = reduced(body);
    const SurfaceMesh& mesh = copy ? *copy : body;
    const CornerNormals corners = corner_normals(mesh);
    TriangleMesh flat;
    for (std::size_t k = 0; k < corners.points.size(); ++k) {
        flat.positions.push_back(single(mesh.points[corners.points[k]]));
        flat.normals.push_back(single(corners.normals[k]));
    }
    flat.triangles = corners.numbers;
    lay_flat(flat);
    ShownSurface shown;
    shown.positions = std::move(flat.positions);
    shown.normals = std::move(flat.normals);
    shown.triangles = std::move(flat.triangles);
    shown.ends.resize(shown.positions.size());
    return shown;
}

}  // namespace

std::optional<SurfaceSource> SurfaceSource::of(const Program& program,
                                               std::shared_ptr<const ModelCells> model,
                                               std::shared_ptr<const SurfaceMesh> body) {
    const DomainSettings& domain = program.domain;
    if (!model && !body && !domain.surface) return std::nullopt;
    SurfaceSource source;
    if (!model && !body) source.function = domain.surface;
    source.model = std::move(model);
    source.body = std::move(body);
    source.grid = domain.grid;
    return source;
}

bool SurfaceSource::is_same_as(const SurfaceSource& other) const {
    if (model || other.model) return model == other.model;
    if (body || other.body) return body == other.body;
    const auto sides = [](const Grid& g) {
        return std::tuple(g.width, g.height, g.boundary.x, g.boundary.y);
    };
    if (sides(grid) != sides(other.grid)) return false;
    const SurfaceFunction mine = function_of(*function), theirs = function_of(*other.function);
    constexpr int places = 19;
    for (int k = 0; k < places * places; ++k) {
        const double sx = (k % places + 0.37) / places, sy = (k / places + 0.61) / places;
        if (mine(sx, sy) != theirs(sx, sy)) return false;
    }
    return true;
}

ShownSurface shown_surface(const SurfaceSource& source, Team& team) {
    if (source.model) return shown_model(*source.model, team);
    return source.body ? shown_body(*source.body) : shown_function(*source.function, source.grid);
}

}  // namespace cascade

// Computes the sizes of cells, the weights of links, and the planes that formulas read, in the
// domain's unit of length.
#include "run/domain/spread_cells.h"

#include "core/check.h"
#include "core/file.h"
#include "core/quantities.h"
#include "core/with_commas.h"
#include "mesh/normals.h"
#include "run/domain/cell_planes.h"
#include "run/domain/free_memory.h"
#include "run/domain/model_directions.h"
#include "surface/cell_file.h"
#include "surface/cell_order.h"
#include "surface/conduction.h"
#include "surface/curvature.h"
#include "surface/make_cells.h"
#include "surface/place_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace cascade {

namespace {

/// Computes the weights of a Laplacian, one for each edge of the Voronoi diagram, in the domain's
/// unit of length.
std::vector<double> weights_of(const SurfaceCells& cells, ModelLaplacian laplacian,
                               const Conduction& conduction, double unit, double mean_area) {
    std::vector<double> weights;
    weights.reserve(cells.edges.size());
    for (std::size_t cell = 0; cell < cells.places.size(); ++cell) {
        double lengths = 0;
        for (const VoronoiEdge& edge : cells.edges_of(cell)) lengths += edge.length;
        for (const VoronoiEdge& edge : cells.edges_of(cell)) {
            if (laplacian == ModelLaplacian::turk) {
                weights.push_back(lengths > 0 ? 4 * edge.length / lengths * unit * unit / mean_area
                                              : 0);
            } else {
                const double area = conduction.areas[cell];
                weights.push_back(area > 0 ? conduction.flows[weights.size()] / area : 0);
            }
        }
    }
    return weights;
}

CellKind kind_of(ModelCellKind kind) {
    switch (kind) {
        case ModelCellKind::spread: return CellKind::places;
        case ModelCellKind::faces: return CellKind::faces;
        case ModelCellKind::vertices: return CellKind::vertices;
    }
    CHECK(false, "a kind of cells");
}

CellOptions options_of(const CellRequest& request) {
    CellOptions options;
    options.kind = kind_of(request.settings.cells);
    options.count = static_cast<std::uint64_t>(request.settings.count);
    options.seed = request.seed;
    return options;
}

constexpr std::int64_t percent = 100;

/// `part` is the fraction of the work that is complete, 0 … 1.
void report(const RunControl& control, std::string what, double part) {
    if (!control.report) return;
    Progress progress;
    progress.doing = std::move(what);
    progress.step = static_cast<std::int64_t>(part * percent);
    progress.steps = percent;
    control.report(progress);
}

/// Reads the cells from a file in the folder `cache`, or makes them and writes the file. An error
/// while writing is ignored, because the cells do not depend on the file.
Result<SurfaceCells> cells_kept_in(const std::filesystem::path& cache, const SurfaceMesh& mesh,
                                   const CellOptions& options, Team& team,
                                   const RunControl& control) {
    const auto path = cache / (key_of(mesh, options).text() + ".cells");
    const auto folder = make_folder(cache);
    auto kept = kept_cells(path, mesh, options, team, control.cancel);
    if (!kept) return tl::unexpected(kept.error());
    if (control.cancel) return std::move(kept->cells);
    const std::string why = folder ? kept->not_kept : folder.error().message;
    if (kept->were_kept) {
        if (control.note) control.note("took the cells from " + path.string());
    } else if (why.empty()) {
        if (control.note) control.note("kept the cells in " + path.string());
    } else if (control.warn) {
        control.warn("the cells are not kept: " + why);
    }
    return std::move(kept->cells);
}

class CellLinker {
public:
    CellLinker(const CellRequest& request, const SurfaceMesh& mesh, SurfaceCells cells)
        : settings_(request.settings),
          precision_(request.precision),
          detail_(static_cast<double>(request.detail)),
          mesh_(mesh) {
        made_.cells = std::move(cells);
        made_.grid = rows_of_cells(static_cast<std::int64_t>(count()));
    }

    SpreadCells link() {
        const SurfaceCells& cells = made_.cells;
        const double total = std::accumulate(cells.areas.begin(), cells.areas.end(), 0.0);
        const double mean = total / static_cast<double>(count());
        made_.unit = settings_.extent ? ModelBox(mesh_).longest / *settings_.extent
                                      : settings_.unit.value_or(std::sqrt(mean) * detail_);
        made_.are_spread = settings_.cells == ModelCellKind::spread;
        const Conduction conduction = conduction_of(cells, made_.are_spread, made_.unit);
        link_cells(weights_of(cells, settings_.laplacian, conduction, made_.unit, mean));
        make_planes(conduction.areas);
        return std::move(made_);
    }

private:
    std::size_t count() const { return made_.cells.places.size(); }

    void link_cells(std::vector<double> weights) {
        const SurfaceCells& cells = made_.cells;
        LinkList list;
        list.ends = cells.ends;
        list.neighbours.reserve(cells.edges.size());
        std::size_t edge = 0;
        for (std::size_t cell = 0; cell < count(); ++cell) {
            double sum = 0;
            for (; edge < cells.ends[cell]; ++edge) {
                list.neighbours.push_back(cells.edges[edge].neighbour);
                sum += weights[edge];
            }
            made_.largest_weight = std::max(made_.largest_weight, sum);
        }
        list.weights = std::move(weights);
        made_.order = order_for_steps(list);
        made_.links = Links(list, PlaneLayout(made_.grid), precision_, made_.order);
    }

    /// Makes a plane with the value `value(k)` in cell k. The values are numbers, or unsigned
    /// integers for a plane of words.
    template <typename Value>
    void put(ModelPlane plane, const Value& value) {
        made_.planes[static_cast<std::size_t>(plane)] =
            plane_of_cells(made_.grid, made_.order, precision_,
                           [&](std::size_t cell, bool) { return value(cell); });
    }

    void make_planes(const std::vector<double>& areas) {
        made_.inside = Mask(PlaneLayout(made_.grid));
        for_each_place(made_.grid, made_.order,
                       [&](std::int64_t row, std::int64_t i, std::size_t, bool is_cell) {
                           made_.inside.row(row)[i] = is_cell ? 1 : 0;
                       });
        made_.planes.resize(model_plane_count);
        const SurfaceCells& cells = made_.cells;
        put(ModelPlane::number, [](std::size_t k) { return static_cast<std::uint32_t>(k); });
        // The area is 0 in the unused positions of the last row, so that these positions do not
        // count in sums.
        made_.planes[static_cast<std::size_t>(ModelPlane::area)] = plane_of_cells(
            made_.grid, made_.order, precision_,
            [&](std::size_t cell, bool is_cell) { return is_cell ? areas[cell] : 0.0; });
        const MeshFacts facts = facts_of(mesh_);
        const Vector3d size = facts.high - facts.low;
        const double longest = std::max({size.x, size.y, size.z});
        std::vector<Vector3d> places;
        for (const SurfacePlace& place : cells.places)
            places.push_back(position_of(mesh_, place) - facts.low);
        const auto part = [](double of, double side) { return side > 0 ? of / side : 0.5; };
        put(ModelPlane::x, [&](std::size_t k) { return part(places[k].x, longest); });
        put(ModelPlane::y, [&](std::size_t k) { return part(places[k].y, longest); });
        put(ModelPlane::z, [&](std::size_t k) { return part(places[k].z, longest); });
        put(ModelPlane::sx, [&](std::size_t k) { return part(places[k].x, size.x); });
        put(ModelPlane::sy, [&](std::size_t k) { return part(places[k].y, size.y); });
        put(ModelPlane::sz, [&](std::size_t k) { return part(places[k].z, size.z); });
        const std::vector<Vector3d> of_points = sphere_normals(mesh_);
        std::vector<Vector3d> normals;
        for (const SurfacePlace& place : cells.places) {
            normals.push_back(normal_at(mesh_, of_points, place));
        }
        put(ModelPlane::nx, [&](std::size_t k) { return normals[k].x; });
        put(ModelPlane::ny, [&](std::size_t k) { return normals[k].y; });
        put(ModelPlane::nz, [&](std::size_t k) { return normals[k].z; });
        // The radii of curvature at the points, by Turk's estimate.
        std::vector<double> bends = turk_radii(mesh_);
        for (double& radius : bends) radius = radius > 0 ? made_.unit / radius : 0;
        put(ModelPlane::curvature,
            [&](std::size_t k) { return value_at(mesh_, bends, cells.places[k]); });
    }

    const ModelSettings& settings_;
    const Precision precision_;
    const double detail_;
    const SurfaceMesh& mesh_;
    SpreadCells made_;
};

}  // namespace

std::size_t CellRequest::count(const SurfaceMesh& mesh) const {
    return static_cast<std::size_t>(count_cells(mesh, options_of(*this)));
}

Result<void> CellRequest::check(const SurfaceMesh& mesh) const {
    const CellOptions options = options_of(*this);
    const double bytes = memory_of_cells(mesh, options);
    if (bytes > static_cast<double>(available_memory())) {
        return failure(fmt::format("making these cells takes {}, more than is free",
                                   with_unit(bytes, "B")),
                       "use fewer cells with --cells");
    }
    return check_cells(mesh, options);
}

Result<SurfaceCells> CellRequest::make(const SurfaceMesh& mesh, Team& team,
                                       const RunControl& control) const {
    CellOptions options = options_of(*this);
    std::optional<Anisotropy> anisotropy;
    if (settings.directions) {
        anisotropy =
            anisotropy_of(*settings.directions, settings.stretch, mesh, team, control.cancel);
        if (control.cancel) return SurfaceCells();
        options.anisotropy = &*anisotropy;
    }
    const std::string doing =
        fmt::format("spreading {} cells", with_commas(static_cast<std::int64_t>(count(mesh))));
    options.progress = [&control, doing](double part) { report(control, doing, part); };
    options.progress(0);
    const bool is_kept = !cache.empty() && options.kind == CellKind::places;
    return is_kept ? cells_kept_in(cache, mesh, options, team, control)
                   : make_cells(mesh, options, team, control.cancel);
}

SpreadCells CellRequest::linked(const SurfaceMesh& mesh, SurfaceCells cells) const {
    return CellLinker(*this, mesh, std::move(cells)).link();
}

}  // namespace cascade

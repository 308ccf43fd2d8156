// Reads or makes the mesh, turns it upright, makes or finds the cells, then builds links and planes
// in the order of memory (surface/cell_order).
#include "run/domain/model_cells.h"

#include "core/check.h"
#include "core/file.h"
#include "core/quantities.h"
#include "core/with_commas.h"
#include "ir/word_format.h"
#include "lang/program/evaluate.h"
#include "lang/program/models.h"
#include "mesh/creature.h"
#include "mesh/implicit_surface.h"
#include "mesh/knot.h"
#include "mesh/make_mesh.h"
#include "mesh/model_file.h"
#include "mesh/normals.h"
#include "mesh/shapes.h"
#include "run/domain/carried_model.h"
#include "run/domain/free_memory.h"
#include "run/domain/model_directions.h"
#include "surface/cell_file.h"
#include "surface/cell_gradient.h"
#include "surface/cell_order.h"
#include "surface/curvature.h"
#include "surface/make_cells.h"
#include "surface/place_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <optional>
#include <type_traits>

namespace cascade {

namespace {

// A cell smaller than this part of the mean counts as this large, because steps would have to be
// just as short.
constexpr double least_area = 1e-3;
// A few in some thousand spread cells are so tight that the sum of their links' weights exceeds
// this over the mean area. They count as larger, so that they do not shorten the steps of all
// cells. Regular hexagons have 3.46.
constexpr double most_weight = 7.5;

Result<MadeMesh> read_mesh(const ModelSettings& settings, const ModelAccess& access) {
    Result<PolygonSoup> soup =
        access.is_asked_for ? read_model(std::filesystem::path(settings.path), access.reads)
                            : read_model(GrantedFiles(access.folder, access.reads), settings.path);
    if (!soup) return tl::unexpected(soup.error());
    Result<MadeMesh> made = make_mesh(*std::move(soup));
    if (made) return made;
    return failure(fmt::format("'{}': {}", settings.path, made.error().message), made.error().hint);
}

/// The surface where a formula of x, y and z is 0, with values above 0 inside.
Result<SurfaceMesh> implicit_mesh(const ModelSettings& settings, const std::atomic<bool>& cancel) {
    const auto function = [&](std::span<const Vector3d> points, std::span<double> values) {
        BuiltinValues place{};
        for (std::size_t k = 0; k < points.size(); ++k) {
            place[static_cast<std::size_t>(Builtin::x)] = points[k].x;
            place[static_cast<std::size_t>(Builtin::y)] = points[k].y;
            place[static_cast<std::size_t>(Builtin::z)] = points[k].z;
            values[k] = evaluate(*settings.implicit, place);
        }
    };
    const double half = settings.sizes.empty() ? 1 : settings.sizes[0];
    ImplicitRequest request;
    request.low = {-half, -half, -half};
    request.high = {half, half, half};
    request.edge = half / 25;
    return implicit_surface(function, request, cancel);
}

Result<MadeMesh> make_surface(const ModelSettings& settings, const ModelAccess& access,
                              const std::atomic<bool>& cancel) {
    // Fine enough for the smallest features, whatever the number of cells.
    constexpr double edge = 0.02;
    const auto size = [&](std::size_t k, double otherwise) {
        return k < settings.sizes.size() ? settings.sizes[k] : otherwise;
    };
    Result<SurfaceMesh> mesh;
    switch (settings.shape) {
        case ModelShape::file: return read_mesh(settings, access);
        case ModelShape::sphere: mesh = sphere_mesh(1, edge); break;
        case ModelShape::torus:
            mesh = torus_mesh(size(0, 1), size(1, 0.4), edge * size(0, 1));
            break;
        case ModelShape::box: {
            const Vector3d sides{size(0, 1), size(1, 1), size(2, 1)};
            mesh = box_mesh(sides, edge * std::max({sides.x, sides.y, sides.z}));
            break;
        }
        // The knot is 6 long.
        case ModelShape::knot: mesh = knot_mesh(size(0, 0.4), 3 * edge); break;
        case ModelShape::creature: mesh = creature_mesh(0.025, cancel); break;
        case ModelShape::implicit: mesh = implicit_mesh(settings, cancel); break;
    }
    if (!mesh) return tl::unexpected(mesh.error());
    return MadeMesh{*std::move(mesh), {}};
}

/// Weights of a Laplacian in units, one for each Voronoi edge.
std::vector<double> weights_of(const SurfaceCells& cells, ModelLaplacian laplacian,
                               const std::vector<double>& areas, double unit, double mean_area) {
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
                const bool is_sound = edge.distance > 0 && areas[cell] > 0;
                weights.push_back(is_sound ? edge.length / edge.distance / areas[cell] : 0);
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

/// Calls `write(row, column, cell, is_cell)` for all positions of the rows; the padding of the last
/// row repeats the last cell.
template <typename Write>
void for_each_place(const ModelCells& model, const Write& write) {
    const std::size_t count = model.order.size();
    std::size_t k = 0;
    for (std::int64_t row = 0; row < model.grid.height; ++row) {
        for (std::int64_t i = 0; i < model.grid.width; ++i, ++k) {
            write(row, i, model.order[std::min(k, count - 1)], k < count);
        }
    }
}

/// A plane of `value(cell, is_cell)`: a number, or an unsigned integer for a plane of words.
template <typename Value>
Field plane_of_cells(const ModelCells& model, Precision precision, const Value& value) {
    Field field(PlaneLayout(model.grid), precision);
    field.visit([&]<typename Number>(Plane<Number>& cells) {
        for_each_place(model, [&](std::int64_t row, std::int64_t i, std::size_t cell,
                                  bool is_cell) {
            const auto found = value(cell, is_cell);
            if constexpr (std::is_same_v<std::remove_const_t<decltype(found)>, std::uint32_t>) {
                const WordOf<Number> word = found;
                std::memcpy(cells.row(row) + i, &word, sizeof word);
            } else {
                cells.row(row)[i] = static_cast<Number>(found);
            }
        });
    });
    return field;
}

class ModelCellMaker {
public:
    ModelCellMaker(const Program& program, Team& team, RunControl& control)
        : program_(program), settings_(*program.domain.model), team_(team), control_(control) {}

    Result<std::shared_ptr<const ModelCells>> make(const ModelAccess& access) {
        report("making the surface");
        Result<MadeMesh> made = make_surface(settings_, access, control_.cancel);
        if (!made) return tl::unexpected(made.error());
        if (control_.cancel) return std::shared_ptr<const ModelCells>();
        model_->mesh = std::move(made->mesh);
        model_->repairs = std::move(made->repairs);
        model_->up = settings_.up;
        for (Vector3d& point : model_->mesh.points) point = turned_upright(point, settings_.up);
        if (access.check) {
            if (auto good = access.check(model_->mesh); !good) return tl::unexpected(good.error());
        }
        if (auto spread = spread_cells(access.cache); !spread)
            return tl::unexpected(spread.error());
        if (control_.cancel) return std::shared_ptr<const ModelCells>();
        return linked();
    }

    std::shared_ptr<const ModelCells> link(CarriedModel carried) {
        model_->mesh = std::move(carried.mesh);
        model_->repairs = std::move(carried.repairs);
        model_->cells = std::move(carried.cells);
        model_->up = settings_.up;
        return linked();
    }

private:
    void report(std::string what) {
        if (!control_.report) return;
        Progress progress;
        progress.doing = std::move(what);
        control_.report(progress);
    }

    Result<void> spread_cells(const std::filesystem::path& cache) {
        CellOptions options;
        options.kind = kind_of(settings_.cells);
        options.count = static_cast<std::uint64_t>(settings_.count);
        options.seed = program_.domain.seed;
        std::optional<Anisotropy> anisotropy;
        if (settings_.directions) {
            anisotropy = anisotropy_of(*settings_.directions, settings_.stretch, model_->mesh,
                                       team_, control_.cancel);
            if (control_.cancel) return {};
            options.anisotropy = &*anisotropy;
        }
        const double bytes = memory_of_cells(model_->mesh, options);
        if (bytes > static_cast<double>(available_memory())) {
            return failure(fmt::format("making these cells takes {}, more than is free",
                                       with_unit(bytes, "B")),
                           "fewer cells: --cells");
        }
        report(fmt::format("spreading {} cells", with_commas(static_cast<std::int64_t>(
                                                     count_cells(model_->mesh, options)))));
        const bool is_kept = !cache.empty() && options.kind == CellKind::places;
        auto made = is_kept ? cells_kept_in(cache, options)
                            : make_cells(model_->mesh, options, team_, control_.cancel);
        if (!made) return tl::unexpected(made.error());
        model_->cells = *std::move(made);
        return {};
    }

    /// Reads the cells from a file in the folder, or makes them and writes the file. Results are
    /// the same either way, so a file that cannot be written is no reason to stop.
    Result<SurfaceCells> cells_kept_in(const std::filesystem::path& cache,
                                       const CellOptions& options) {
        const auto path = cache / (key_of(model_->mesh, options).text() + ".cells");
        const auto folder = make_folder(cache);
        auto kept = kept_cells(path, model_->mesh, options, team_, control_.cancel);
        if (!kept) return tl::unexpected(kept.error());
        if (control_.cancel) return std::move(kept->cells);
        const std::string why = folder ? kept->not_kept : folder.error().message;
        if (kept->were_kept) {
            if (control_.note) control_.note("took the cells from " + path.string());
        } else if (why.empty()) {
            if (control_.note) control_.note("kept the cells in " + path.string());
        } else if (control_.warn) {
            control_.warn("the cells are not kept: " + why);
        }
        return std::move(kept->cells);
    }

    /// With planes and links.
    std::shared_ptr<const ModelCells> linked() {
        model_->grid = rows_of_cells(static_cast<std::int64_t>(model_->count()));
        measure();
        return std::move(model_);
    }

    void measure() {
        const SurfaceCells& cells = model_->cells;
        const double total = std::accumulate(cells.areas.begin(), cells.areas.end(), 0.0);
        const double mean = total / static_cast<double>(model_->count());
        model_->unit = settings_.unit.value_or(std::sqrt(mean));
        std::vector<double> areas = cells.areas;  // In square units.
        for (double& area : areas) {
            area = std::max(area, least_area * mean) / (model_->unit * model_->unit);
        }
        if (settings_.cells == ModelCellKind::spread) widen_tight_cells(areas);
        std::vector<double> weights =
            weights_of(cells, settings_.laplacian, areas, model_->unit, mean);
        link_cells(std::move(weights));
        make_planes(areas);
    }

    void widen_tight_cells(std::vector<double>& areas) const {
        const double mean =
            std::accumulate(areas.begin(), areas.end(), 0.0) / static_cast<double>(areas.size());
        for (std::size_t cell = 0; cell < areas.size(); ++cell) {
            double sum = 0;
            for (const VoronoiEdge& edge : model_->cells.edges_of(cell)) sum += edge.weight();
            areas[cell] = std::max(areas[cell], sum * mean / most_weight);
        }
    }

    void link_cells(std::vector<double> weights) {
        const SurfaceCells& cells = model_->cells;
        LinkList list;
        list.ends = cells.ends;
        list.neighbours.reserve(cells.edges.size());
        std::size_t edge = 0;
        for (std::size_t cell = 0; cell < model_->count(); ++cell) {
            double sum = 0;
            for (; edge < cells.ends[cell]; ++edge) {
                list.neighbours.push_back(cells.edges[edge].neighbour);
                sum += weights[edge];
            }
            model_->largest_weight = std::max(model_->largest_weight, sum);
        }
        list.weights = std::move(weights);
        model_->order = order_for_steps(list);
        model_->links =
            Links(list, PlaneLayout(model_->grid), program_.domain.precision, model_->order);
    }

    /// A plane of `value(k)` in cell k: a number, or an unsigned integer for words.
    template <typename Value>
    void put(ModelPlane plane, const Value& value) {
        model_->planes[static_cast<std::size_t>(plane)] =
            plane_of_cells(*model_, program_.domain.precision,
                           [&](std::size_t cell, bool) { return value(cell); });
    }

    void make_planes(const std::vector<double>& areas) {
        model_->inside = Mask(PlaneLayout(model_->grid));
        for_each_place(*model_, [&](std::int64_t row, std::int64_t i, std::size_t, bool is_cell) {
            model_->inside.row(row)[i] = is_cell ? 1 : 0;
        });
        model_->planes.resize(model_plane_count);
        const SurfaceMesh& mesh = model_->mesh;
        const SurfaceCells& cells = model_->cells;
        put(ModelPlane::number, [](std::size_t k) { return static_cast<std::uint32_t>(k); });
        // The padding of the last row does not count in sums by area.
        model_->planes[static_cast<std::size_t>(ModelPlane::area)] =
            plane_of_cells(*model_, program_.domain.precision, [&](std::size_t cell, bool is_cell) {
                return is_cell ? areas[cell] : 0.0;
            });
        const MeshFacts facts = facts_of(mesh);
        const Vector3d size = facts.high - facts.low;
        const double longest = std::max({size.x, size.y, size.z});
        std::vector<Vector3d> places;
        for (const SurfacePlace& place : cells.places)
            places.push_back(position_of(mesh, place) - facts.low);
        const auto part = [](double of, double side) { return side > 0 ? of / side : 0.5; };
        put(ModelPlane::x, [&](std::size_t k) { return part(places[k].x, longest); });
        put(ModelPlane::y, [&](std::size_t k) { return part(places[k].y, longest); });
        put(ModelPlane::z, [&](std::size_t k) { return part(places[k].z, longest); });
        put(ModelPlane::sx, [&](std::size_t k) { return part(places[k].x, size.x); });
        put(ModelPlane::sy, [&](std::size_t k) { return part(places[k].y, size.y); });
        put(ModelPlane::sz, [&](std::size_t k) { return part(places[k].z, size.z); });
        const std::vector<Vector3d> of_points = sphere_normals(mesh);
        std::vector<Vector3d> normals;
        for (const SurfacePlace& place : cells.places) {
            normals.push_back(normal_at(mesh, of_points, place));
        }
        put(ModelPlane::nx, [&](std::size_t k) { return normals[k].x; });
        put(ModelPlane::ny, [&](std::size_t k) { return normals[k].y; });
        put(ModelPlane::nz, [&](std::size_t k) { return normals[k].z; });
        // Turk's estimate, as a curvature in 1 / unit.
        std::vector<double> bends = turk_radii(mesh);
        for (double& radius : bends) radius = radius > 0 ? model_->unit / radius : 0;
        put(ModelPlane::curvature,
            [&](std::size_t k) { return value_at(mesh, bends, cells.places[k]); });
    }

    const Program& program_;
    const ModelSettings& settings_;
    Team& team_;
    RunControl& control_;
    std::shared_ptr<ModelCells> model_ = std::make_shared<ModelCells>();
};

}  // namespace

Result<std::shared_ptr<const ModelCells>> make_model_cells(const Program& program,
                                                           const ModelAccess& access, Team& team,
                                                           RunControl& control) {
    return ModelCellMaker(program, team, control).make(access);
}

std::shared_ptr<const ModelCells> link_carried_model(const Program& program, CarriedModel model,
                                                     Team& team, RunControl& control) {
    return ModelCellMaker(program, team, control).link(std::move(model));
}

const Links& ModelCells::links_with_gradients() const {
    std::call_once(has_gradients_, [&] {
        const std::atomic<bool> never = false;
        Team team(hardware_threads());
        std::vector<Vector3d> gradients = cell_gradient_weights(mesh, cells, team, never);
        for (Vector3d& gradient : gradients) gradient = gradient * unit;
        links_with_gradients_ =
            links.with_gradients(gradients, cells.ends, PlaneLayout(grid), order);
    });
    return links_with_gradients_;
}

SurfaceMesh ModelCells::mesh_of_file() const {
    SurfaceMesh turned_back = mesh;
    for (Vector3d& point : turned_back.points) point = turned_from_upright(point, up);
    return turned_back;
}

ModelBox::ModelBox(const SurfaceMesh& mesh) {
    const SurfaceMesh::Box box = mesh.box();
    const Vector3d size = box.high - box.low;
    low = box.low;
    longest = std::max({size.x, size.y, size.z});
}

Field field_of_cells(std::span<const double> values, const ModelCells& model, Precision precision) {
    return plane_of_cells(model, precision, [&](std::size_t cell, bool) { return values[cell]; });
}

Field in_one_row(const Field& field, const ModelCells& model) {
    const auto count = static_cast<std::int64_t>(model.count());
    Field row(PlaneLayout(Grid{count, 1}), field.precision());
    field.visit([&]<typename Number>(const Plane<Number>& from) {
        Plane<Number>& to = row.plane<Number>();
        for (std::int64_t k = 0; k < count; ++k) {
            to.row(0)[model.cell_at(k)] = from.row(k / model.grid.width)[k % model.grid.width];
        }
    });
    return row;
}

Field in_rows(const Field& one_row, const ModelCells& model) {
    return one_row.visit([&]<typename Number>(const Plane<Number>& from) {
        return plane_of_cells(model, one_row.precision(),
                              [row = from.row(0)](std::size_t cell, bool) { return row[cell]; });
    });
}

std::vector<double> cell_values(const Field& field, const ModelCells& model) {
    std::vector<double> values(model.count());
    for (std::size_t k = 0; k < values.size(); ++k) {
        const auto place = static_cast<std::int64_t>(k);
        values[model.order[k]] =
            field.number_at(place % model.grid.width, place / model.grid.width);
    }
    return values;
}

}  // namespace cascade

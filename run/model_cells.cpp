#include "run/model_cells.h"

#include "core/with_commas.h"
#include "ir/word_format.h"
#include "lang/evaluate.h"
#include "lang/models.h"
#include "surface/cell_gradient.h"
#include "surface/curvature.h"
#include "surface/make_mesh.h"
#include "surface/model_file.h"
#include "surface/place_values.h"
#include "surface/scatter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

namespace cascade {

namespace {

constexpr int rounds = 40;

// Cells that are so much smaller than the mean are taken for no smaller: a step would have to be as short.
constexpr double least_area = 1e-3;

Result<MadeMesh> read_mesh(const ModelSettings& settings, const ModelAccess& access) {
    std::filesystem::path path = settings.path;
    if (!access.is_asked_for) {
        auto readable = readable_path(access.folder, settings.path, access.reads);
        if (!readable) return tl::unexpected(readable.error());
        path = *readable;
    }
    Result<PolygonSoup> soup = read_model(path);
    if (!soup) return tl::unexpected(soup.error());
    Result<MadeMesh> made = make_mesh(*std::move(soup));
    if (made) return made;
    return failure(fmt::format("'{}': {}", settings.path, made.error().message), made.error().hint);
}

Result<MadeMesh> make_surface(const ModelSettings& settings, const ModelAccess& access) {
    if (settings.shape == ModelShape::file) return read_mesh(settings, access);
    return failure("surfaces without a file are not made yet");
}

/// The cells of a list in another order; `order[k]` is the number of what becomes number k.
SurfaceCells reordered(const SurfaceCells& cells, const std::vector<std::uint32_t>& order) {
    std::vector<std::uint32_t> position(order.size());
    for (std::uint32_t k = 0; k < order.size(); ++k) position[order[k]] = k;
    SurfaceCells result;
    result.bare_area = cells.bare_area;
    result.places.reserve(order.size());
    result.areas.reserve(order.size());
    result.ends.reserve(order.size());
    result.walls.reserve(cells.walls.size());
    for (const std::uint32_t cell : order) {
        result.places.push_back(cells.places[cell]);
        result.areas.push_back(cells.areas[cell]);
        for (CellWall wall : cells.walls_of(cell)) {
            wall.neighbour = position[wall.neighbour];
            result.walls.push_back(wall);
        }
        result.ends.push_back(result.walls.size());
    }
    return result;
}

/// Weights of a Laplacian in units, one for each wall.
std::vector<double> weights_of(const SurfaceCells& cells, ModelLaplacian laplacian,
                               const std::vector<double>& areas, double unit, double mean_area) {
    std::vector<double> weights;
    weights.reserve(cells.walls.size());
    for (std::size_t cell = 0; cell < cells.places.size(); ++cell) {
        double lengths = 0;
        for (const CellWall& wall : cells.walls_of(cell)) lengths += wall.length;
        for (const CellWall& wall : cells.walls_of(cell)) {
            if (laplacian == ModelLaplacian::turk) {
                weights.push_back(lengths > 0 ? 4 * wall.length / lengths * unit * unit / mean_area : 0);
            } else {
                const bool is_sound = wall.distance > 0 && areas[cell] > 0;
                weights.push_back(is_sound ? wall.length / wall.distance / areas[cell] : 0);
            }
        }
    }
    return weights;
}

class ModelCellMaker {
public:
    ModelCellMaker(const Program& program, Team& team, RunControl& control)
        : program_(program), settings_(*program.domain.model), team_(team), control_(control) {}

    Result<std::shared_ptr<const ModelCells>> make(const ModelAccess& access) {
        report("reading");
        Result<MadeMesh> made = make_surface(settings_, access);
        if (!made) return tl::unexpected(made.error());
        model_->mesh = std::move(made->mesh);
        model_->repairs = std::move(made->repairs);
        if (auto spread = spread_cells(); !spread) return tl::unexpected(spread.error());
        if (control_.cancel) return std::shared_ptr<const ModelCells>();
        model_->grid = rows_of_cells(static_cast<std::int64_t>(model_->count()));
        measure();
        return std::shared_ptr<const ModelCells>(std::move(model_));
    }

private:
    void report(const char* what) {
        if (!control_.report) return;
        Progress progress;
        progress.stage = what;
        progress.note = "cells";
        control_.report(progress);
    }

    Result<void> spread_cells() {
        report("spreading");
        const auto count = static_cast<std::size_t>(settings_.count);
        const auto pieces = pieces_of(model_->mesh);
        const std::size_t piece_count =
            pieces.empty() ? 0 : *std::max_element(pieces.begin(), pieces.end()) + std::size_t{1};
        if (count < piece_count) {
            return failure(fmt::format("the model has {} pieces, but {} cells are to be spread over it",
                                       with_commas(static_cast<std::int64_t>(piece_count)),
                                       with_commas(settings_.count)),
                           "each piece needs cells: --cells");
        }
        std::vector<SurfacePlace> places = scatter(model_->mesh, count, program_.domain.seed);
        relax(model_->mesh, places, rounds, team_, control_.cancel);
        if (control_.cancel) return {};
        SurfaceCells cells = voronoi_cells(model_->mesh, std::move(places), team_, control_.cancel);
        model_->numbers.resize(cells.places.size());
        std::iota(model_->numbers.begin(), model_->numbers.end(), 0);
        model_->cells = reordered(cells, model_->numbers);
        return {};
    }

    /// Planes and links.
    void measure() {
        const SurfaceCells& cells = model_->cells;
        const double total = std::accumulate(cells.areas.begin(), cells.areas.end(), 0.0);
        const double mean = total / static_cast<double>(model_->count());
        model_->unit = settings_.unit.value_or(std::sqrt(mean));
        std::vector<double> areas = cells.areas;  // In square units.
        for (double& area : areas) {
            area = std::max(area, least_area * mean) / (model_->unit * model_->unit);
        }
        const std::vector<double> weights =
            weights_of(cells, settings_.laplacian, areas, model_->unit, mean);
        link(weights);
        make_planes(areas);
    }

    void link(const std::vector<double>& weights) {
        const SurfaceCells& cells = model_->cells;
        LinkList list;
        list.ends = cells.ends;
        list.weights = weights;
        list.gradients = cell_gradient_weights(model_->mesh, cells, team_, control_.cancel);
        for (Vector3d& gradient : list.gradients) gradient = gradient * model_->unit;
        std::size_t wall = 0;
        for (std::size_t cell = 0; cell < model_->count(); ++cell) {
            double sum = 0;
            for (; wall < cells.ends[cell]; ++wall) {
                list.neighbours.push_back(cells.walls[wall].neighbour);
                sum += weights[wall];
            }
            model_->largest_weight = std::max(model_->largest_weight, sum);
        }
        model_->links = Links(list, PlaneLayout(model_->grid), program_.domain.precision);
    }

    /// `value(k)` in cell k; the cells behind the last one are like it.
    template <typename Value>
    void put(ModelPlane plane, const Value& value) {
        Field& field = model_->planes[static_cast<std::size_t>(plane)];
        field = Field(PlaneLayout(model_->grid), program_.domain.precision);
        const std::size_t count = model_->count();
        field.visit([&]<typename Number>(Plane<Number>& cells) {
            for (std::int64_t row = 0; row < model_->grid.height; ++row) {
                for (std::int64_t i = 0; i < model_->grid.width; ++i) {
                    const auto k = static_cast<std::size_t>(row * model_->grid.width + i);
                    if constexpr (std::is_same_v<decltype(value(k)), std::uint32_t>) {
                        const WordOf<Number> word = value(std::min(k, count - 1));
                        std::memcpy(cells.row(row) + i, &word, sizeof word);
                    } else {
                        const bool fills_up = k >= count && plane == ModelPlane::area;
                        cells.row(row)[i] =
                            fills_up ? Number{0} : static_cast<Number>(value(std::min(k, count - 1)));
                    }
                }
            }
        });
    }

    void make_planes(const std::vector<double>& areas) {
        model_->planes.resize(model_plane_count);
        const SurfaceMesh& mesh = model_->mesh;
        const SurfaceCells& cells = model_->cells;
        put(ModelPlane::number, [&](std::size_t k) { return model_->numbers[k]; });
        put(ModelPlane::area, [&](std::size_t k) { return areas[k]; });
        const MeshFacts facts = facts_of(mesh);
        const Vector3d size = facts.high - facts.low;
        const double longest = std::max({size.x, size.y, size.z});
        std::vector<Vector3d> places;
        for (const SurfacePlace& place : cells.places) places.push_back(position_of(mesh, place) - facts.low);
        const auto part = [](double of, double side) { return side > 0 ? of / side : 0.5; };
        put(ModelPlane::x, [&](std::size_t k) { return part(places[k].x, longest); });
        put(ModelPlane::y, [&](std::size_t k) { return part(places[k].y, longest); });
        put(ModelPlane::z, [&](std::size_t k) { return part(places[k].z, longest); });
        put(ModelPlane::sx, [&](std::size_t k) { return part(places[k].x, size.x); });
        put(ModelPlane::sy, [&](std::size_t k) { return part(places[k].y, size.y); });
        put(ModelPlane::sz, [&](std::size_t k) { return part(places[k].z, size.z); });
        const std::vector<Vector3d> of_points = point_normals(mesh);
        std::vector<Vector3d> normals;
        for (const SurfacePlace& place : cells.places) {
            Vector3d sum{};
            for (std::size_t k = 0; k < 3; ++k) {
                sum = sum + of_points[mesh.triangles[place.triangle][k]] * place.weights[k];
            }
            if (!(length(sum) > 0)) sum = mesh.double_area_normal(place.triangle);
            normals.push_back(length(sum) > 0 ? sum * (1 / length(sum)) : Vector3d{0, 0, 1});
        }
        put(ModelPlane::nx, [&](std::size_t k) { return normals[k].x; });
        put(ModelPlane::ny, [&](std::size_t k) { return normals[k].y; });
        put(ModelPlane::nz, [&](std::size_t k) { return normals[k].z; });
        // Turk's estimate, as a curvature in one over units.
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

std::vector<double> in_own_order(const Field& field, const ModelCells& model) {
    std::vector<double> values(model.count());
    for (std::size_t k = 0; k < model.count(); ++k) {
        const auto place = static_cast<std::int64_t>(k);
        values[model.numbers[k]] =
            field.number_at(place % model.grid.width, place / model.grid.width);
    }
    return values;
}

}  // namespace cascade

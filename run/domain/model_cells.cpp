// Reads or makes the mesh, and turns it upright. Makes its cells (run/domain/spread_cells) either
// immediately or in the first call of spread().
#include "run/domain/model_cells.h"

#include "core/check.h"
#include "core/run_control.h"
#include "lang/program/models.h"
#include "mesh/animals.h"
#include "mesh/make_mesh.h"
#include "mesh/model_file.h"
#include "mesh/shapes.h"
#include "run/domain/carried_model.h"
#include "run/domain/cell_planes.h"
#include "run/domain/spread_cells.h"
#include "run/domain/tensor_links.h"
#include "run/domain/volume_surface.h"
#include "surface/cell_gradient.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace cascade {

namespace {

Result<MadeMesh> read_mesh(const ModelSettings& settings, const ModelAccess& access) {
    Result<PolygonSoup> soup =
        access.is_asked_for ? read_model(std::filesystem::path(settings.path), access.reads)
                            : read_model(GrantedFiles(access.folder, access.reads), settings.path);
    if (!soup) return tl::unexpected(soup.error());
    Result<MadeMesh> made = make_mesh(*std::move(soup));
    if (made) return made;
    return failure(fmt::format("'{}': {}", settings.path, made.error().message), made.error().hint);
}

Result<SurfaceMesh> mesh_of(const Animal& animal, const std::atomic<bool>& cancel) {
    return animal.body.mesh(animal.edge, cancel);
}

Result<MadeMesh> make_surface(const ModelSettings& settings, const Literals& literals,
                              const ModelAccess& access, const std::atomic<bool>& cancel) {
    // The length of edges. It is small enough for the smallest features of the shapes, and does not
    // depend on the number of cells.
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
        // The knot is 6 units large, so its edges may be three times as long.
        case ModelShape::knot: mesh = knot_mesh(size(0, 0.4), 3 * edge); break;
        case ModelShape::creature: mesh = mesh_of(creature(), cancel); break;
        case ModelShape::leopard: mesh = mesh_of(leopard(), cancel); break;
        case ModelShape::giraffe: mesh = mesh_of(giraffe(), cancel); break;
        case ModelShape::zebra: mesh = mesh_of(zebra(), cancel); break;
        case ModelShape::fish: mesh = mesh_of(fish(), cancel); break;
        case ModelShape::frog: mesh = mesh_of(frog(), cancel); break;
        case ModelShape::implicit:
            mesh = surface_of_formula(settings, literals, access, cancel);
            break;
    }
    if (!mesh) return tl::unexpected(mesh.error());
    return MadeMesh{*std::move(mesh), {}};
}

ModelCells::Make linking(const CellRequest& request, SurfaceCells cells) {
    return [request, cells = std::move(cells)](const ModelCells& model) mutable {
        return request.linked(model.mesh, std::move(cells));
    };
}

}  // namespace

ModelCells::ModelCells(SurfaceMesh upright, std::size_t count, Make make)
    : mesh(std::move(upright)),
      count_(count),
      grid_(rows_of_cells(static_cast<std::int64_t>(count))),
      make_(std::move(make)) {}

ModelCells::~ModelCells() = default;

const SpreadCells& ModelCells::spread() const {
    std::call_once(is_spread_, [&] { spread_ = make_(*this); });
    return spread_;
}

const Links& ModelCells::links_with_gradients() const {
    std::call_once(has_gradients_, [&] {
        links_with_gradients_ =
            spread().links.with_gradients(gradient_weights(), spread().cells.ends,
                                          PlaneLayout(grid()), spread().order);
    });
    return links_with_gradients_;
}

std::vector<Vector3d> ModelCells::gradient_weights() const {
    Team team(hardware_threads());
    std::vector<Vector3d> gradients =
        cell_gradient_weights(mesh, spread().cells, team, never_cancelled);
    for (Vector3d& gradient : gradients) gradient = gradient * spread().unit;
    return gradients;
}

const TensorLinks& ModelCells::tensor_links() const {
    std::call_once(has_tensors_, [&] { tensor_links_ = std::make_unique<TensorLinks>(*this); });
    return *tensor_links_;
}

SurfaceMesh ModelCells::mesh_of_file() const {
    SurfaceMesh turned_back = mesh;
    for (Vector3d& point : turned_back.points) point = turned_from_upright(point, stance);
    return turned_back;
}

Result<std::shared_ptr<const ModelCells>> make_model_cells(const Program& program,
                                                           const ModelAccess& access, Team& team,
                                                           RunControl& control) {
    using Made = std::shared_ptr<const ModelCells>;
    const CellRequest request(program, access.cache);
    const ModelSettings& settings = request.settings;
    if (control.report) {
        Progress progress;
        progress.doing = "making the surface";
        control.report(progress);
    }
    Result<MadeMesh> made = make_surface(settings, *program.literals, access, control.cancel);
    if (!made) return tl::unexpected(made.error());
    if (control.cancel) return Made();
    for (Vector3d& point : made->mesh.points) point = turned_upright(point, settings.stance);
    if (access.check) {
        if (auto good = access.check(made->mesh); !good) return tl::unexpected(good.error());
    }
    if (auto good = request.check(made->mesh); !good) return tl::unexpected(good.error());
    const std::size_t count = request.count(made->mesh);
    ModelCells::Make make = [request](const ModelCells& model) {
        Team makers(hardware_threads());
        auto cells = request.make(model.mesh, makers, RunControl());
        CHECK(cells, "what could fail was checked");
        return request.linked(model.mesh, *std::move(cells));
    };
    if (!access.is_made_when_read) {
        auto cells = request.make(made->mesh, team, control);
        if (!cells) return tl::unexpected(cells.error());
        if (control.cancel) return Made();
        make = linking(request, *std::move(cells));
    }
    auto model = std::make_shared<ModelCells>(std::move(made->mesh), count, std::move(make));
    model->repairs = std::move(made->repairs);
    model->stance = settings.stance;
    if (!access.is_made_when_read) model->spread();
    return model;
}

std::shared_ptr<const ModelCells> link_carried_model(const Program& program, CarriedModel carried) {
    const CellRequest request(program);
    const std::size_t count = carried.cells.places.size();
    auto model = std::make_shared<ModelCells>(std::move(carried.mesh), count,
                                              linking(request, std::move(carried.cells)));
    model->repairs = std::move(carried.repairs);
    model->stance = request.settings.stance;
    return model;
}

ModelBox::ModelBox(const SurfaceMesh& mesh) {
    const SurfaceMesh::Box box = mesh.box();
    const Vector3d size = box.high - box.low;
    low = box.low;
    longest = std::max({size.x, size.y, size.z});
}

Field field_of_cells(std::span<const double> values, const ModelCells& model, Precision precision) {
    return plane_of_cells(model.grid(), model.spread().order, precision,
                          [&](std::size_t cell, bool) { return values[cell]; });
}

Field in_one_row(const Field& field, const ModelCells& model) {
    const auto count = static_cast<std::int64_t>(model.count());
    Field row(PlaneLayout(Grid{count, 1}), field.precision());
    field.visit([&]<typename Number>(const Plane<Number>& from) {
        Plane<Number>& to = row.plane<Number>();
        for (std::int64_t k = 0; k < count; ++k) {
            to.row(0)[model.cell_at(k)] = from.row(k / model.grid().width)[k % model.grid().width];
        }
    });
    return row;
}

Field in_rows(const Field& one_row, const ModelCells& model) {
    return one_row.visit([&]<typename Number>(const Plane<Number>& from) {
        return plane_of_cells(model.grid(), model.spread().order, one_row.precision(),
                              [row = from.row(0)](std::size_t cell, bool) { return row[cell]; });
    });
}

std::vector<double> cell_values(const Field& field, const ModelCells& model) {
    std::vector<double> values(model.count());
    for (std::size_t k = 0; k < values.size(); ++k) {
        const auto place = static_cast<std::int64_t>(k);
        values[model.cell_at(place)] =
            field.number_at(place % model.grid().width, place / model.grid().width);
    }
    return values;
}

}  // namespace cascade

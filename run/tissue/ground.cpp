// Crawling cells can read every plane of the domain. At a crawling cell, the values are
// interpolated at the nearest position of the domain.
#include "run/tissue/ground.h"

#include "core/overloaded.h"
#include "surface/curvature.h"

#include <algorithm>

namespace cascade {

namespace {

/// Returns the mesh of a model with lengths in the script's unit.
SurfaceMesh in_script_lengths(const SurfaceMesh& mesh) {
    SurfaceMesh scaled = mesh;
    const ModelBox box(mesh);
    for (Vector3d& point : scaled.points) point = box.in_script(point);
    return scaled;
}

/// Returns the size of the box that a grid fills. A plane has no depth.
Vector3d extent_of(const Grid& grid) {
    const auto longest = static_cast<double>(grid.longest_side());
    const auto side = [&](std::int64_t cells) { return static_cast<double>(cells) / longest; };
    return {side(grid.width), side(grid.height), grid.depth > 1 ? side(grid.depth) : 0};
}

std::unique_ptr<Surroundings> box_of(const Grid& grid) {
    const auto repeats = [](Boundary boundary) { return boundary == Boundary::periodic; };
    return in_box(extent_of(grid), {repeats(grid.boundary.x), repeats(grid.boundary.y),
                                    grid.depth > 1 && repeats(grid.boundary.z)});
}

/// Computes a curvature at each point of a mesh, in units of 1 / `unit`.
std::vector<float> curvature_at_points(const SurfaceMesh& mesh, ModelPlane which, double unit) {
    std::vector<float> values;
    if (which == ModelPlane::curvature) {
        for (const double radius : turk_radii(mesh)) {
            values.push_back(static_cast<float>(unit / radius));
        }
        return values;
    }
    const PrincipalCurvatures found = principal_curvatures(mesh);
    for (std::size_t point = 0; point < mesh.points.size(); ++point) {
        const double value = which == ModelPlane::curvature_mean ? unit * found.mean(point)
                             : which == ModelPlane::curvature_gauss
                                 ? unit * unit * found.gaussian(point)
                             : which == ModelPlane::curvature_high ? unit * found.high[point]
                                                                   : unit * found.low[point];
        values.push_back(static_cast<float>(value));
    }
    return values;
}

/// Whether the values of the plane belong to the crawling cells, and not to the domain.
bool is_of_tissue(ModelPlane plane) {
    return plane == ModelPlane::number || plane == ModelPlane::area;
}

bool is_sensed(const PlaneSource& source) {
    return std::visit(
        Overloaded{[](ModelPlane plane) { return !is_of_tissue(plane); },
                   [](const SensedItem&) { return true; }, [](const NamedPlane&) { return true; },
                   [](SurfaceValueId) { return true; }, [](const auto&) { return false; }},
        source);
}

}  // namespace

TissueGround::TissueGround(const Grid& grid, const ModelCells* model) : grid_(grid), model_(model) {
    if (model == nullptr) {
        surroundings_ = box_of(grid);
        return;
    }
    mesh_ = std::make_shared<const SurfaceMesh>(in_script_lengths(model->mesh));
    surroundings_ = around_surface(*mesh_);
}

TissueGround::TissueGround(const Grid& grid, SurfaceMesh body)
    : grid_(grid), model_(nullptr), mesh_(std::make_shared<const SurfaceMesh>(std::move(body))) {
    surroundings_ = around_surface(*mesh_);
}

PlaceValue TissueGround::value_of(const Field& field) const {
    if (model_ == nullptr) return of_grid(field, grid_.boundary);
    if (!filter_) {
        Team team(hardware_threads());
        filter_ = std::make_unique<CellFilter>(model_->mesh, model_->spread().cells, team);
    }
    const std::vector<double> values = cell_values(field, *model_);
    return of_cells(*filter_, std::vector<float>(values.begin(), values.end()));
}

/// Returns a function that gives a cell's position along a side of the domain's box, as a fraction
/// of that side.
PlaceValue TissueGround::part_of_side(std::size_t axis) const {
    const Vector3d extent = model_ != nullptr ? surroundings_->extent() : extent_of(grid_);
    const double side = axis == 0 ? extent.x : axis == 1 ? extent.y : extent.z;
    return [axis, side](const NearPlace& near) {
        const Vector3d& p = near.position;
        const double at = axis == 0 ? p.x : axis == 1 ? p.y : p.z;
        return side > 0 ? at / side : 0.5;
    };
}

Sense TissueGround::sense_of(const PlaneSource& source, const BindingContext& fields) const {
    using Kind = Sense::Kind;
    const PlaceValue none = [](const NearPlace&) { return 0.0; };
    const auto value = [](PlaceValue of) { return Sense{Kind::value, std::move(of)}; };
    if (const auto* item = std::get_if<SensedItem>(&source)) {
        return value(value_of(plane_of(item->item, fields)));
    }
    if (const auto* plane = std::get_if<ModelPlane>(&source)) {
        switch (*plane) {
            case ModelPlane::off: return {Kind::off};
            case ModelPlane::nx: return {Kind::normal_x};
            case ModelPlane::ny: return {Kind::normal_y};
            case ModelPlane::nz: return {Kind::normal_z};
            case ModelPlane::feature: return value(mesh_ ? feature_of(*mesh_) : none);
            case ModelPlane::sx: return value(part_of_side(0));
            case ModelPlane::sy: return value(part_of_side(1));
            case ModelPlane::sz: return value(part_of_side(2));
            default: break;
        }
        if (mesh_ == nullptr) return value(none);  // A plane has no curvature.
        if (model_ == nullptr) {
            const double cell = 1 / static_cast<double>(grid_.longest_side());
            return value(of_points(*mesh_, curvature_at_points(*mesh_, *plane, cell)));
        }
    }
    return value(value_of(plane_of(source, fields)));
}

std::vector<PlaneSource> sensed_by(std::span<const StepPlan* const> plans) {
    std::vector<PlaneSource> sensed;
    for (const StepPlan* plan : plans) {
        for (const Pass& pass : plan->passes) {
            for (const PlaneSource& source : pass.bound.fields) {
                const bool is_new = std::ranges::find(sensed, source) == sensed.end();
                if (is_new && is_sensed(source)) sensed.push_back(source);
            }
        }
    }
    return sensed;
}

}  // namespace cascade

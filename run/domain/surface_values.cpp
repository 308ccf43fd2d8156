// Computes each value when it is first read, and stores it. In cells that no path reaches,
// distances have a large finite value.
#include "run/domain/surface_values.h"

#include "core/near_name.h"
#include "core/run_control.h"
#include "lang/program/models.h"
#include "run/domain/cell_planes.h"
#include "run/domain/model_directions.h"
#include "surface/cell_frames.h"
#include "surface/curvature.h"
#include "surface/distance.h"
#include "surface/key_positions.h"
#include "surface/nearest_place.h"
#include "surface/place_values.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace cascade {

namespace {

/// The time of the last use for values that the script itself reads. It is later than all times, so
/// these values are never deleted.
constexpr std::int64_t always = std::numeric_limits<std::int64_t>::max();

/// Returns the largest distance that a formula needs. If the formula only compares the distance
/// with numbers, this is the largest of these numbers. Otherwise it is infinity.
double reach_needed(const Formula& formula, SurfaceValueId id) {
    constexpr std::array comparisons = {Function::less, Function::less_equal, Function::greater,
                                        Function::greater_equal};
    constexpr double infinite = std::numeric_limits<double>::infinity();
    if (formula.nodes.back().is(id)) return infinite;
    double reach = 0;
    for (const Node& node : formula.nodes) {
        const auto is_it = [&](NodeId operand) { return formula.nodes[operand].is(id); };
        if (std::none_of(node.reads().begin(), node.reads().end(), is_it)) continue;
        const bool compares = std::any_of(comparisons.begin(), comparisons.end(),
                                          [&](Function each) { return node.calls(each); });
        if (!compares) return infinite;
        for (const NodeId operand : node.reads()) {
            const double* const number = formula.nodes[operand].as<double>();
            if (!number && !is_it(operand)) return infinite;
            if (number) reach = std::max(reach, *number);
        }
    }
    return reach;
}

std::vector<double> key_values(const ModelCells& model, std::span<const double> numbers, Team& team,
                               const std::atomic<bool>& cancel) {
    const ModelBox box(model.mesh);
    const double smoothing = numbers.size() % 4 == 1 ? numbers.back() : usual_smoothing;
    std::vector<KeyValue> keys;
    for (std::size_t k = 0; k + 3 < numbers.size(); k += 4) {
        keys.push_back(
            {box.in_model({numbers[k], numbers[k + 1], numbers[k + 2]}), numbers[k + 3]});
    }
    return smoothed(model.spread().cells,
                    nearest_key_values(model.mesh, model.spread().cells, keys, cancel),
                    smoothing * box.longest, team, cancel);
}

}  // namespace

/// Data that all distances share.
struct SurfaceValues::Paths {
    NearestPlace nearest;
    std::shared_ptr<const DistanceMesh> mesh;
    std::vector<Vector3d> cells;  ///< The positions of the cells.

    Paths(const ModelCells& model, const std::atomic<bool>& cancel)
        : nearest(model.mesh), mesh(std::make_shared<const DistanceMesh>(model.mesh, cancel)) {
        for (const SurfacePlace& place : model.spread().cells.places) {
            cells.push_back(position_of(model.mesh, place));
        }
    }
};

SurfaceValues::SurfaceValues(const Program& program, const ModelCells& model, Team& team)
    : program_(program), model_(model), team_(team) {}

SurfaceValues::~SurfaceValues() = default;

std::vector<double> SurfaceValues::distances(std::span<const double> places, double reach,
                                             const std::atomic<bool>& cancel) {
    if (!paths_) paths_ = std::make_unique<Paths>(model_, cancel);
    const ModelBox box(model_.mesh);
    std::vector<SurfacePlace> sources;
    std::vector<Vector3d> positions;
    for (std::size_t k = 0; k + 2 < places.size(); k += 3) {
        const auto place =
            paths_->nearest.find(box.in_model({places[k], places[k + 1], places[k + 2]}));
        if (!place) continue;
        sources.push_back(*place);
        positions.push_back(position_of(model_.mesh, *place));
    }
    reach *= box.longest;
    const SurfaceDistance distance(paths_->mesh, sources, cancel, reach);
    std::vector<double> found(model_.count(), unreachable_distance);
    for (std::size_t cell = 0; cell < found.size(); ++cell) {
        // No path is shorter than the straight line. So a cell is out of reach if all straight
        // lines to it are longer than `reach`.
        const bool is_far =
            std::none_of(positions.begin(), positions.end(), [&](const Vector3d& from) {
                return !(length(paths_->cells[cell] - from) > reach);
            });
        const double path = is_far ? std::numeric_limits<double>::infinity()
                                   : distance.at(model_.spread().cells.places[cell]).distance;
        if (path <= reach) found[cell] = std::min(path / box.longest, unreachable_distance);
    }
    return found;
}

const SurfaceValues::Kept& SurfaceValues::made(SurfaceValueId id, double reach,
                                               const std::atomic<bool>& cancel) {
    const auto known = values_.find(id);
    if (known != values_.end() && known->second.reach >= reach) return known->second;
    const SurfaceValue& value = program_.literals->surface_value(id);
    if (value.function != Function::distance) reach = std::numeric_limits<double>::infinity();
    const std::vector<double> found =
        value.function == Function::distance ? distances(value.numbers, reach, cancel)
        : value.function == Function::along  ? angles(value, cancel)
                                             : key_values(model_, value.numbers, team_, cancel);
    Kept& kept = values_[id];
    kept.field = field_of_cells(found, model_, program_.domain.precision);
    kept.reach = reach;
    return kept;
}

void SurfaceValues::make(std::span<const Formula* const> formulas,
                         const std::atomic<bool>& cancel) {
    for (const Formula* formula : formulas) {
        for (const Node& node : formula->nodes) {
            if (cancel) return;
            if (const auto* id = node.as<SurfaceValueId>()) {
                (void)made(*id, std::numeric_limits<double>::infinity(), cancel);
                values_[*id].last_read = always;
            }
            if (!node.is<Builtin>()) continue;
            const auto read = model_plane_of(*node.as<Builtin>());
            if (read && is_made_when_read(*read)) (void)plane(*read);
            // Curvatures are computed when the cells are made, so the cells must be made before the
            // run.
            if (read == ModelPlane::curvature) (void)model_.spread();
        }
    }
    paths_.reset();
}

void SurfaceValues::prepare(std::span<const Formula* const> formulas) {
    ++evaluation_;
    std::erase_if(values_, [&](const auto& each) {
        return each.second.last_read < evaluation_ - evaluations_kept;
    });
    for (const Formula* formula : formulas) {
        for (const Node& node : formula->nodes) {
            const auto* id = node.as<SurfaceValueId>();
            if (id != nullptr) {
                (void)made(*id, reach_needed(*formula, *id), never_cancelled);
                (void)value(*id);
            }
        }
    }
}

const Field& SurfaceValues::value(SurfaceValueId id) {
    if (!values_.contains(id)) {
        (void)made(id, std::numeric_limits<double>::infinity(), never_cancelled);
    }
    Kept& kept = values_[id];
    kept.last_read = std::max(kept.last_read, evaluation_);
    return kept.field;
}

const Field& SurfaceValues::plane(ModelPlane plane) {
    if (!planes_.contains(plane)) {
        plane >= ModelPlane::right_x ? make_directions() : make_curvatures();
    }
    return planes_.at(plane);
}

Field SurfaceValues::in_cells(const std::vector<double>& of_points, double factor) const {
    std::vector<double> values = values_at(model_.mesh, of_points, model_.spread().cells.places);
    for (double& value : values) value *= factor;
    return field_of_cells(values, model_, program_.domain.precision);
}

void SurfaceValues::make_curvatures() {
    const PrincipalCurvatures found = principal_curvatures(model_.mesh);
    std::vector<double> mean, gauss;
    for (std::size_t point = 0; point < model_.mesh.points.size(); ++point) {
        mean.push_back(found.mean(point));
        gauss.push_back(found.gaussian(point));
    }
    const double unit = model_.spread().unit;
    planes_[ModelPlane::curvature_mean] = in_cells(mean, unit);
    planes_[ModelPlane::curvature_high] = in_cells(found.high, unit);
    planes_[ModelPlane::curvature_low] = in_cells(found.low, unit);
    planes_[ModelPlane::curvature_gauss] = in_cells(gauss, unit * unit);
}

void SurfaceValues::make_directions() {
    const SpreadCells& spread = model_.spread();
    const SurfaceCells& cells = spread.cells;
    const bool are_spread = program_.domain.model->cells == ModelCellKind::spread;
    const CellFrames frames = cell_frames(model_.mesh, cells);
    const auto put = [&](ModelPlane plane, const auto& value) {
        planes_[plane] = plane_of_cells(model_.grid(), spread.order, program_.domain.precision,
                                        [&](std::size_t cell, bool) { return value(cell); });
    };
    put(ModelPlane::right_x, [&](std::size_t k) { return frames.right[k].x; });
    put(ModelPlane::right_y, [&](std::size_t k) { return frames.right[k].y; });
    put(ModelPlane::right_z, [&](std::size_t k) { return frames.right[k].z; });
    put(ModelPlane::down_x, [&](std::size_t k) { return frames.down[k].x; });
    put(ModelPlane::down_y, [&](std::size_t k) { return frames.down[k].y; });
    put(ModelPlane::down_z, [&](std::size_t k) { return frames.down[k].z; });
    const std::vector<double> evenness =
        evenness_of_cells(model_.mesh, cells, frames, conduction_of(cells, are_spread, spread.unit),
                          team_, never_cancelled);
    put(ModelPlane::evenness, [&](std::size_t k) { return evenness[k]; });
    const SurfaceMesh::Box box = model_.mesh.box();
    const Vector3d middle = (box.low + box.high) * 0.5;
    std::vector<Vector3d> places;
    for (const SurfacePlace& place : cells.places)
        places.push_back((position_of(model_.mesh, place) - middle) * (1 / spread.unit));
    put(ModelPlane::place_x, [&](std::size_t k) { return places[k].x; });
    put(ModelPlane::place_y, [&](std::size_t k) { return places[k].y; });
    put(ModelPlane::place_z, [&](std::size_t k) { return places[k].z; });
}

/// Computes the angles of a field of directions, measured in the frame of each cell.
std::vector<double> SurfaceValues::angles(const SurfaceValue& value,
                                          const std::atomic<bool>& cancel) {
    const SurfaceCells& cells = model_.spread().cells;
    const DirectionSettings settings{
        value.direction, value.numbers, std::nullopt, value.smoothing, {}};
    const std::vector<Vector3d> lines = direction_lines(settings, model_.mesh, team_, cancel);
    const CellFrames frames = cell_frames(model_.mesh, cells);
    std::vector<double> found;
    for (std::size_t cell = 0; cell < cells.places.size(); ++cell) {
        const Vector3d line = lines[cells.places[cell].triangle];
        found.push_back(std::atan2(dot(line, frames.down[cell]), dot(line, frames.right[cell])));
    }
    return found;
}

Result<const PointAttribute*> find_attribute(const std::string& name, const SurfaceMesh& mesh) {
    std::vector<std::string> names;
    for (const PointAttribute& attribute : mesh.attributes) {
        if (attribute.name == name) return &attribute;
        names.push_back(attribute.name);
    }
    const std::string near = nearest_name(name, names);
    return failure(fmt::format("the model's points have no attribute '{}'", name),
                   !near.empty()   ? fmt::format("did you mean '{}'?", near)
                   : names.empty() ? std::string("they have no attributes")
                                   : fmt::format("they have {}", fmt::join(names, ", ")));
}

Result<Field> attribute_plane(const std::string& name, const ModelCells& model,
                              Precision precision) {
    const auto attribute = find_attribute(name, model.mesh);
    if (!attribute) return tl::unexpected(attribute.error());
    return field_of_cells(values_at(model.mesh, (*attribute)->values, model.spread().cells.places),
                          model, precision);
}

}  // namespace cascade

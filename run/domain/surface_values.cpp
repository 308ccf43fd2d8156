// Each value is made once, when it is first read; distances are capped where no path leads.
#include "run/domain/surface_values.h"

#include "core/near_name.h"
#include "lang/program/models.h"
#include "surface/curvature.h"
#include "surface/distance.h"
#include "surface/key_positions.h"
#include "surface/nearest_place.h"
#include "surface/place_values.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

const std::atomic<bool> never = false;

std::vector<double> distances(const ModelCells& model, std::span<const double> numbers,
                              const std::atomic<bool>& cancel) {
    const NearestPlace nearest(model.mesh);
    const ModelBox box(model.mesh);
    std::vector<SurfacePlace> sources;
    for (std::size_t k = 0; k + 2 < numbers.size(); k += 3) {
        const auto place = nearest.find(box.in_model({numbers[k], numbers[k + 1], numbers[k + 2]}));
        if (place) sources.push_back(*place);
    }
    std::vector<double> found =
        distances_of_cells(SurfaceDistance(model.mesh, sources, cancel), model.cells);
    for (double& distance : found) {
        distance = std::min(distance / box.longest, unreachable_distance);
    }
    return found;
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
    return smoothed(model.cells, nearest_key_values(model.mesh, model.cells, keys, cancel),
                    smoothing * box.longest, team, cancel);
}

/// A coordinate of a texture as a position among `count` pixels: the pixel before it, the one
/// after, and the weight of the second.
struct BetweenPixels {
    std::size_t before = 0, after = 0;
    double part = 0;

    BetweenPixels(double coordinate, std::int64_t count) {
        if (!std::isfinite(coordinate)) coordinate = 0;
        const double place =
            (coordinate - std::floor(coordinate)) * static_cast<double>(count) - 0.5;
        const auto first = static_cast<std::int64_t>(std::floor(place));
        part = place - std::floor(place);
        before = static_cast<std::size_t>((first + count) % count);
        after = static_cast<std::size_t>((first + 1 + count) % count);
    }
};

double lightness_at(const GreyPicture& picture, const std::array<double, 2>& place) {
    const BetweenPixels column(place[0], picture.width);
    const BetweenPixels row(1 - place[1], picture.height);  // Rows are counted from the top.
    const auto pixel = [&](std::size_t j, std::size_t i) {
        return double{picture.values[j * static_cast<std::size_t>(picture.width) + i]};
    };
    const auto along = [&](std::size_t j) {
        return std::lerp(pixel(j, column.before), pixel(j, column.after), column.part);
    };
    return std::lerp(along(row.before), along(row.after), row.part);
}

}  // namespace

void SurfaceValues::make(std::span<const Formula* const> formulas,
                         const std::atomic<bool>& cancel) {
    for (const Formula* formula : formulas) {
        for (const Node& node : formula->nodes) {
            if (cancel) return;
            const auto* id = node.as<SurfaceValueId>();
            if (id != nullptr && !values_.contains(*id)) {
                values_[*id] = make_value(program_.literals->surface_value(*id), cancel);
            }
            if (!node.is<Builtin>()) continue;
            const auto read = model_plane_of(*node.as<Builtin>());
            if (read && is_made_when_read(*read)) (void)plane(*read);
        }
    }
}

const Field& SurfaceValues::value(SurfaceValueId id) {
    const auto known = values_.find(id);
    if (known != values_.end()) return known->second;
    return values_[id] = make_value(program_.literals->surface_value(id), never);
}

const Field& SurfaceValues::plane(ModelPlane plane) {
    if (planes_.empty()) make_curvatures();
    return planes_.at(plane);
}

Field SurfaceValues::make_value(const SurfaceValue& value, const std::atomic<bool>& cancel) const {
    const std::vector<double> found = value.function == Function::distance
                                          ? distances(model_, value.numbers, cancel)
                                          : key_values(model_, value.numbers, team_, cancel);
    return field_of_cells(found, model_, program_.domain.precision);
}

Field SurfaceValues::in_cells(const std::vector<double>& of_points, double factor) const {
    std::vector<double> values = values_at(model_.mesh, of_points, model_.cells.places);
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
    const double unit = model_.unit;
    planes_[ModelPlane::curvature_mean] = in_cells(mean, unit);
    planes_[ModelPlane::curvature_high] = in_cells(found.high, unit);
    planes_[ModelPlane::curvature_low] = in_cells(found.low, unit);
    planes_[ModelPlane::curvature_gauss] = in_cells(gauss, unit * unit);
}

Result<const PointAttribute*> find_attribute(const std::string& name, const SurfaceMesh& mesh) {
    std::vector<std::string> names;
    for (const PointAttribute& attribute : mesh.attributes) {
        if (attribute.name == name) return &attribute;
        names.push_back(attribute.name);
    }
    const std::string near = nearest_name(name, names);
    return failure(fmt::format("the model's points have no '{}'", name),
                   !near.empty()   ? fmt::format("did you mean '{}'?", near)
                   : names.empty() ? std::string("they have no attributes")
                                   : fmt::format("they have {}", fmt::join(names, ", ")));
}

Result<Field> attribute_plane(const std::string& name, const ModelCells& model,
                              Precision precision) {
    const auto attribute = find_attribute(name, model.mesh);
    if (!attribute) return tl::unexpected(attribute.error());
    return field_of_cells(values_at(model.mesh, (*attribute)->values, model.cells.places), model,
                          precision);
}

Result<Field> painted_plane(const GreyPicture& picture, const ModelCells& model,
                            Precision precision) {
    if (model.mesh.texture.empty()) {
        return failure("the model has no texture coordinates",
                       "they say where a picture lies on it");
    }
    std::vector<double> values;
    values.reserve(model.count());
    for (const SurfacePlace& place : model.cells.places) {
        values.push_back(lightness_at(picture, *texture_place_at(model.mesh, place)));
    }
    return field_of_cells(values, model, precision);
}

}  // namespace cascade

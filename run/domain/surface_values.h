// Values of a model's cells that come from places on its surface: distances, values of keys,
// curvatures, and attributes of its points and its texture.
#pragma once

#include "core/parallel.h"
#include "core/plane.h"
#include "core/result.h"
#include "lang/program/program.h"
#include "picture/grey_picture.h"
#include "run/domain/model_cells.h"

#include <atomic>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace cascade {

/// distance(…) where no path leads, in longest sides of the model. Larger than any path, and small
/// enough for arithmetic in binary32.
inline constexpr double unreachable_distance = 1000;

/// The default smoothing of keys(…): a standard deviation in longest sides.
inline constexpr double usual_smoothing = 0.1;

/// Planes that are made when they are first read, and kept. Program, model and team must outlive
/// this; values may be added to the program. Only one thread at a time.
class SurfaceValues {
public:
    SurfaceValues(const Program& program, const ModelCells& model, Team& team)
        : program_(program), model_(model), team_(team) {}

    /// Computes the values that formulas read. They are meaningless if `cancel` became true.
    void make(std::span<const Formula* const> formulas, const std::atomic<bool>& cancel);

    const Field& value(SurfaceValueId id);
    /// One of the planes of a model that are made on demand.
    const Field& plane(ModelPlane plane);

private:
    Field make_value(const SurfaceValue& value, const std::atomic<bool>& cancel) const;
    void make_curvatures();
    Field in_cells(const std::vector<double>& of_points, double factor) const;

    const Program& program_;
    const ModelCells& model_;
    Team& team_;
    std::map<SurfaceValueId, Field> values_;
    std::map<ModelPlane, Field> planes_;
};

/// The values that attr("name") reads. Fails if the points of the model have none of that name.
Result<const PointAttribute*> find_attribute(const std::string& name, const SurfaceMesh& mesh);

/// attr("name") in the cells, interpolated linearly between points. Fails as find_attribute() does.
Result<Field> attribute_plane(const std::string& name, const ModelCells& model,
                              Precision precision);

/// uvimage(…) in the cells, interpolated linearly between the centres of four pixels. Coordinates
/// beyond 0 … 1 repeat the picture. Fails if the model has no texture coordinates.
Result<Field> painted_plane(const GreyPicture& picture, const ModelCells& model,
                            Precision precision);

}  // namespace cascade

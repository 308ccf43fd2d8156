// What is known of the cells of a model from places on its surface: distances, values of keys,
// curvatures, and what its points and its texture have.
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

/// distance(…) where no way leads, in longest sides of the model. Larger than ways are, and small
/// enough to be reckoned with in binary32.
inline constexpr double unreachable_distance = 1000;

/// How far keys(…) spreads each key's value if nothing is said: a standard deviation in longest
/// sides.
inline constexpr double usual_smoothing = 0.1;

/// Planes that are made when they are first read, and kept. Program, model and team must stay;
/// values may be added to the program. One thread at a time.
class SurfaceValues {
public:
    SurfaceValues(const Program& program, const ModelCells& model, Team& team)
        : program_(program), model_(model), team_(team) {}

    /// Those that formulas read. They mean nothing if `cancel` became true.
    void make(std::span<const Formula* const> formulas, const std::atomic<bool>& cancel);

    /// Literals::surface_values()[number].
    const Field& value(std::uint32_t number);
    /// One of those that are made when they are read.
    const Field& plane(ModelPlane plane);

private:
    Field make_value(const SurfaceValue& value, const std::atomic<bool>& cancel) const;
    void make_curvatures();
    Field in_cells(const std::vector<double>& of_points, double factor) const;

    const Program& program_;
    const ModelCells& model_;
    Team& team_;
    std::map<std::uint32_t, Field> values_;
    std::map<ModelPlane, Field> planes_;
};

/// attr("name") in the cells, linear between points. Fails, in words, where the points of the model
/// have nothing of that name.
Result<Field> attribute_plane(const std::string& name, const ModelCells& model,
                              Precision precision);

/// uvimage(…) in the cells: linear between the middles of four pixels. Places beyond 0 … 1 repeat
/// the picture. Fails where the model has no texture coordinates.
Result<Field> painted_plane(const GreyPicture& picture, const ModelCells& model,
                            Precision precision);

}  // namespace cascade

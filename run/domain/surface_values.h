// Values of a model's cells derived from positions on its surface: distances, values of keys,
// curvatures, directions, and attributes of its points.
#pragma once

#include "core/parallel.h"
#include "core/plane.h"
#include "core/result.h"
#include "lang/program/program.h"
#include "run/domain/model_cells.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace cascade {

/// distance(…) where no path leads, in longest sides of the model. Larger than any path, and small
/// enough for arithmetic in binary32.
inline constexpr double unreachable_distance = 1000;

/// The default smoothing of keys(…): a standard deviation in longest sides.
inline constexpr double usual_smoothing = 0.1;

/// Planes that are made and stored on their first reading. Program, model and team must outlive
/// this. Values may be added to the program. Not thread-safe.
class SurfaceValues {
public:
    SurfaceValues(const Program& program, const ModelCells& model, Team& team);
    ~SurfaceValues();

    /// Computes the values read by formulas. They are meaningless if `cancel` became true.
    void make(std::span<const Formula* const> formulas, const std::atomic<bool>& cancel);

    const Field& value(SurfaceValueId id);
    /// Prepares for one evaluation of formulas of a picture or a stroke. These may name new
    /// positions without end, so a value that make() did not make is released when none of the last
    /// `evaluations_kept` evaluations has read it. They come many times a second, so distances that
    /// formulas only compare with numbers are computed only as far as these comparisons need.
    void prepare(std::span<const Formula* const> formulas);
    /// The number of values in memory.
    std::size_t count() const { return values_.size(); }
    static constexpr std::int64_t evaluations_kept = 16;

    /// A plane of the model, made on demand.
    const Field& plane(ModelPlane plane);

private:
    struct Kept {
        Field field;
        std::int64_t last_read = 0;
        double reach = std::numeric_limits<double>::infinity();  ///< Farther cells are unreachable.
    };

    struct Paths;
    const Kept& made(SurfaceValueId id, double reach, const std::atomic<bool>& cancel);
    std::vector<double> distances(std::span<const double> places, double reach,
                                  const std::atomic<bool>& cancel);
    void make_curvatures();
    void make_directions();
    std::vector<double> angles(const SurfaceValue& value, const std::atomic<bool>& cancel);
    Field in_cells(const std::vector<double>& of_points, double factor) const;

    const Program& program_;
    const ModelCells& model_;
    Team& team_;
    std::map<SurfaceValueId, Kept> values_;
    std::int64_t evaluation_ = 0;
    std::unique_ptr<Paths> paths_;  ///< Made for the first distance.
    std::map<ModelPlane, Field> planes_;
};

/// The values read by attr("name"). Fails if the points of the model have none of that name.
Result<const PointAttribute*> find_attribute(const std::string& name, const SurfaceMesh& mesh);

/// attr("name") in the cells, interpolated linearly between points. Fails as find_attribute() does.
Result<Field> attribute_plane(const std::string& name, const ModelCells& model,
                              Precision precision);

}  // namespace cascade

// Values in the cells of a model that depend on positions on its surface: distances, values
// interpolated between keys, curvatures, directions, and attributes of the model's points.
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

/// The value of distance(…) in cells that no path reaches, as a multiple of the model's longest
/// side. It is larger than the length of any path, and small enough for arithmetic in binary32.
inline constexpr double unreachable_distance = 1000;

/// The default smoothing of keys(…): a standard deviation, as a multiple of the model's longest
/// side.
inline constexpr double usual_smoothing = 0.1;

/// Values and planes are computed when they are first read, and then stored. Program, model and
/// team must outlive this object. Values may be added to the program later. Only one thread may use
/// this object.
class SurfaceValues {
public:
    SurfaceValues(const Program& program, const ModelCells& model, Team& team);
    ~SurfaceValues();

    /// Computes all values that the formulas read. The values are meaningless if `cancel` became
    /// true.
    void make(std::span<const Formula* const> formulas, const std::atomic<bool>& cancel);

    const Field& value(SurfaceValueId id);
    /// Must be called before the formulas of a picture or a stroke are evaluated, which happens
    /// many times a second. Such formulas may name new positions each time, so their values are not
    /// stored forever. A value that make() has not computed is deleted if none of the last
    /// `evaluations_kept` evaluations has read it. If the formulas only compare a distance with
    /// numbers, the distance is computed only as far as these comparisons need.
    void prepare(std::span<const Formula* const> formulas);
    /// The number of stored values.
    std::size_t count() const { return values_.size(); }
    static constexpr std::int64_t evaluations_kept = 16;

    /// Returns a plane of the model. The first call computes it.
    const Field& plane(ModelPlane plane);

private:
    struct Kept {
        Field field;
        std::int64_t last_read = 0;
        /// Cells whose distance is greater count as unreachable.
        double reach = std::numeric_limits<double>::infinity();
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
    /// The data for distances. Made when the first distance is needed.
    std::unique_ptr<Paths> paths_;
    std::map<ModelPlane, Field> planes_;
};

/// Finds the attribute that attr("name") reads. Fails if the points of the model have no attribute
/// with that name.
Result<const PointAttribute*> find_attribute(const std::string& name, const SurfaceMesh& mesh);

/// Returns the values of attr("name") in the cells, interpolated linearly between points. Fails in
/// the same cases as find_attribute().
Result<Field> attribute_plane(const std::string& name, const ModelCells& model,
                              Precision precision);

}  // namespace cascade

// Reads all arrays, and then evaluates the formula at the positions of a lattice.
#include "run/domain/volume_surface.h"

#include "core/printable.h"
#include "lang/program/evaluate.h"
#include "mesh/implicit_surface.h"
#include "picture/npy.h"
#include "run/domain/file_places.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace cascade {

namespace {

/// How many edges of triangles fit along a side of the cube: `usual_edges` by default, which is
/// also the smallest number, and `most_edges` at most. With many more edges, making the surface
/// would take minutes.
constexpr double usual_edges = 50, most_edges = 100;
/// The number of positions that are evaluated together. It is small enough for their values to stay
/// in the caches.
constexpr std::size_t places_together = 256;

/// An array, and its position in the cube.
struct Volume {
    NpyArray array;
    std::array<std::int64_t, 3> sides;
    double element = 0;  ///< The length of an element in an array that fills the cube.

    Volume(NpyArray read, double half)
        : array(std::move(read)),
          sides{array.columns, array.rows, array.slices},
          element(2 * half / static_cast<double>(*std::ranges::max_element(sides))) {}

    double extent(std::size_t axis) const { return static_cast<double>(sides[axis]) * element; }
    double at(const FilePlace& place) const { return number_at_place(array.values, sides, place); }
};

BuiltinValues builtins_at(const Vector3d& point) {
    BuiltinValues values{};
    values[static_cast<std::size_t>(Builtin::x)] = point.x;
    values[static_cast<std::size_t>(Builtin::y)] = point.y;
    values[static_cast<std::size_t>(Builtin::z)] = point.z;
    return values;
}

class SpaceFormula {
public:
    SpaceFormula(const Formula& formula, const Literals& literals)
        : formula_(formula), literals_(literals) {}

    Result<void> read(const ModelAccess& access, double half) {
        for (const Node& node : formula_.nodes) {
            if (!node.calls(Function::field)) continue;
            const TextId text = text_of(node);
            if (volumes_.contains(text)) continue;
            const std::string& name = literals_.text(text);
            const auto bytes =
                GrantedFiles(access.folder, access.reads).read(name, largest_npy_file);
            if (!bytes) return tl::unexpected(bytes.error());
            auto array = parse_npy(*bytes, Precision::binary64);
            if (!array) {
                return failure(fmt::format("cannot read '{}': {}", short_name(name),
                                           array.error().message),
                               array.error().hint);
            }
            const auto& places = literals_.reading(node.as<Call>()->detail).place;
            if (array->slices > 1 && places.size() == 2) {
                return failure(
                    fmt::format("'{}' has {} slices, but the position has only two numbers",
                                short_name(name), array->slices),
                    "add a third number, from 0 to 1, for a point between the first and the last "
                    "slice");
            }
            volumes_.emplace(text, Volume(*std::move(array), half));
        }
        return {};
    }

    /// Sets values[k] to the value at points[k]. If the formula reads arrays that fill the cube,
    /// values outside of them are below 0.
    void at(std::span<const Vector3d> points, std::span<double> values) const {
        std::vector<double> depths(points.size(), std::numeric_limits<double>::infinity());
        const KnownValues known = [&](const Node& node, const auto&, std::span<double> own) {
            if (const auto* const builtin = node.as<Builtin>()) {
                std::ranges::transform(points, own.begin(), [&](const Vector3d& point) {
                    return builtins_at(point)[static_cast<std::size_t>(*builtin)];
                });
                return true;
            }
            if (node.is<TextId>())
                return true;  // The call of field() below reads the array with this name.
            if (!node.calls(Function::field)) return false;
            const Volume& volume = volumes_.at(text_of(node));
            const auto& places = literals_.reading(node.as<Call>()->detail).place;
            for (std::size_t k = 0; k < points.size(); ++k) {
                own[k] = volume.at(places.empty() ? place_in_cube(volume, points[k], depths[k])
                                                  : place_by(places, builtins_at(points[k])));
            }
            return true;
        };
        evaluate(formula_, known, values);
        for (std::size_t k = 0; k < points.size(); ++k) {
            values[k] = depths[k] <= 0 ? depths[k] : std::min(values[k], depths[k]);
        }
    }

    /// Returns the length of the smallest element, or `otherwise` if the formula reads no arrays.
    double element(double otherwise) const {
        double smallest = std::numeric_limits<double>::infinity();
        for (const auto& [text, volume] : volumes_) smallest = std::min(smallest, volume.element);
        return volumes_.empty() ? otherwise : smallest;
    }
    bool reads_volumes() const { return !volumes_.empty(); }

private:
    /// Returns the position of a point in an array that fills the cube. Reduces `depth` to the
    /// distance from the nearest side of the array, in elements, if this distance is less. The
    /// distance is negative outside the array.
    static FilePlace place_in_cube(const Volume& volume, const Vector3d& point, double& depth) {
        FilePlace place{0.5, 0.5, 0.5};
        const std::array along{point.x, point.y, point.z};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double extent = volume.extent(axis);
            place[axis] += along[axis] / extent;
            depth = std::min({depth, place[axis] * extent / volume.element,
                              (1 - place[axis]) * extent / volume.element});
        }
        return place;
    }
    static FilePlace place_by(std::span<const Formula> formulas, const BuiltinValues& builtins) {
        FilePlace place{0.5, 0.5, 0.5};
        for (std::size_t axis = 0; axis < formulas.size(); ++axis) {
            place[axis] = evaluate(formulas[axis], builtins);
        }
        return place;
    }
    TextId text_of(const Node& node) const {
        return std::get<TextId>(formula_.nodes[node.operands[0]].kind);
    }

    const Formula& formula_;
    const Literals& literals_;
    std::map<TextId, Volume> volumes_;
};

}  // namespace

Result<SurfaceMesh> surface_of_formula(const ModelSettings& settings, const Literals& literals,
                                       const ModelAccess& access, const std::atomic<bool>& cancel) {
    const double half = settings.sizes.empty() ? 1 : settings.sizes[0];
    SpaceFormula formula(*settings.implicit, literals);
    if (const auto read = formula.read(access, half); !read) return tl::unexpected(read.error());
    ImplicitRequest request;
    request.edge = std::clamp(formula.element(2 * half / usual_edges), 2 * half / most_edges,
                              2 * half / usual_edges);
    // A surface that is closed at the sides of an array touches the sides of the cube, so the
    // lattice must extend beyond them.
    const double reach = formula.reads_volumes() ? half + 2 * request.edge : half;
    request.low = {-reach, -reach, -reach};
    request.high = {reach, reach, reach};
    const auto function = [&](std::span<const Vector3d> points, std::span<double> values) {
        for (std::size_t begin = 0; begin < points.size(); begin += places_together) {
            const std::size_t count = std::min(places_together, points.size() - begin);
            formula.at(points.subspan(begin, count), values.subspan(begin, count));
        }
    };
    return implicit_surface(function, request, cancel);
}

}  // namespace cascade

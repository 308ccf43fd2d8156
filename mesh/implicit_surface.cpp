// Cuts the lattice layer by layer, remeshes isotropically, and projects the points onto the surface
// by regula falsi with the Illinois rule.
#include "mesh/implicit_surface.h"

#include "mesh/centred_lattice.h"
#include "mesh/edge_pairs.h"
#include "mesh/isotropic_remesh.h"
#include "mesh/shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

/// The least distance of a triangle's corner from the ends of its lattice edge, as a fraction of
/// that edge. Triangles with corners at the ends could have no area.
constexpr double least_part = 0.1;
/// The distances from a point at which the surface is searched, as multiples of the edge, nearest
/// first.
constexpr std::array reaches = {0.05, 0.15, 0.4, 1.0};
constexpr int most_halvings = 60;
/// The largest error of a corner's position, as a multiple of the edge.
constexpr double accuracy = 1e-12;

std::string text_of(Vector3d p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z); }

/// Calls the function and checks its results.
class CheckedFunction {
public:
    explicit CheckedFunction(const ImplicitFunction& function) : function_(function) {}

    Result<void> operator()(std::span<const Vector3d> points, std::span<double> values) const {
        function_(points, values);
        for (std::size_t k = 0; k < points.size(); ++k) {
            if (std::isfinite(values[k])) continue;
            return failure(fmt::format("the function of the surface is {} at {}", values[k],
                                       text_of(points[k])),
                           "it has to be finite everywhere in the box");
        }
        return {};
    }

private:
    const ImplicitFunction& function_;
};

/// Projects points onto the surface along their normals.
class Projector {
public:
    Projector(const CheckedFunction& function, const ImplicitRequest& request)
        : function_(function), request_(request) {}

    Result<void> bring_back(std::span<Vector3d> points, std::span<const Vector3d> normals) {
        bracketed_.clear();
        if (Result<void> found = find_brackets(points, normals); !found) return found;
        return close_brackets(points);
    }

private:
    struct Bracket {
        std::size_t number = 0;
        Vector3d origin, direction;
        double near = 0, far = 0;  ///< The distances between which the function changes its sign.
        double near_value = 0, far_value = 0;
    };

    /// The point at a distance along a bracket's line, clamped to the box, because the function
    /// need not be defined outside of the box.
    Vector3d place(const Bracket& b, double distance) const {
        const Vector3d p = b.origin + b.direction * distance;
        return {std::clamp(p.x, request_.low.x, request_.high.x),
                std::clamp(p.y, request_.low.y, request_.high.y),
                std::clamp(p.z, request_.low.z, request_.high.z)};
    }

    Result<void> evaluate(const std::vector<Bracket>& brackets,
                          const std::vector<double>& distances) {
        places_.clear();
        for (std::size_t k = 0; k < brackets.size(); ++k) {
            places_.push_back(place(brackets[k], distances[k]));
        }
        values_.resize(places_.size());
        return function_(places_, values_);
    }

    /// Searches outwards from points inside and inwards from points outside, at growing distances.
    /// If the function does not change its sign within the largest distance, the point does not
    /// move.
    Result<void> find_brackets(std::span<const Vector3d> points,
                               std::span<const Vector3d> normals) {
        std::vector<Bracket> sought;
        for (std::size_t k = 0; k < points.size(); ++k) {
            sought.push_back({k, points[k], normals[k], 0, 0, 0, 0});
        }
        if (Result<void> fine = evaluate(sought, std::vector<double>(sought.size(), 0.0)); !fine) {
            return fine;
        }
        std::size_t kept = 0;
        for (std::size_t k = 0; k < sought.size(); ++k) {
            sought[k].near_value = values_[k];
            if (values_[k] < 0) sought[k].direction = -sought[k].direction;
            if (values_[k] != 0) sought[kept++] = sought[k];
        }
        sought.resize(kept);
        for (const double reach : reaches) {
            if (Result<void> fine =
                    evaluate(sought, std::vector<double>(sought.size(), reach * request_.edge));
                !fine) {
                return fine;
            }
            kept = 0;
            for (std::size_t k = 0; k < sought.size(); ++k) {
                Bracket& b = sought[k];
                b.far = reach * request_.edge;
                b.far_value = values_[k];
                if ((b.near_value > 0) != (b.far_value > 0)) {
                    bracketed_.push_back(b);
                    continue;
                }
                b.near = b.far;
                b.near_value = b.far_value;
                sought[kept++] = b;
            }
            sought.resize(kept);
        }
        return {};
    }

    /// Narrows all brackets to the surface by regula falsi. If a step does not move one end of a
    /// bracket, the value at this end is halved (the Illinois rule). An occasional bisection bounds
    /// the number of steps.
    Result<void> close_brackets(std::span<Vector3d> points) {
        std::vector<double> middles;
        for (int round = 0; round < most_halvings && !bracketed_.empty(); ++round) {
            middles.clear();
            for (const Bracket& b : bracketed_) {
                const double part = b.near_value / (b.near_value - b.far_value);
                const bool halves = round % 4 == 3 || !(part > 0 && part < 1);
                middles.push_back(b.near + (b.far - b.near) * (halves ? 0.5 : part));
            }
            if (Result<void> fine = evaluate(bracketed_, middles); !fine) return fine;
            std::size_t kept = 0;
            for (std::size_t k = 0; k < bracketed_.size(); ++k) {
                Bracket b = bracketed_[k];
                const double value = values_[k];
                if ((value > 0) == (b.near_value > 0)) {
                    b.near = middles[k];
                    b.near_value = value;
                    b.far_value *= 0.5;
                } else {
                    b.far = middles[k];
                    b.far_value = value;
                    b.near_value *= 0.5;
                }
                points[b.number] = places_[k];
                if (value != 0 && b.far - b.near > accuracy * request_.edge) bracketed_[kept++] = b;
            }
            bracketed_.resize(kept);
        }
        return {};
    }

    const CheckedFunction& function_;
    const ImplicitRequest& request_;
    std::vector<Bracket> bracketed_;
    std::vector<Vector3d> places_;
    std::vector<double> values_;
};

std::array<std::int32_t, 3> cells_of(const ImplicitRequest& request) {
    const Vector3d size = request.high - request.low;
    const auto count = [&](double length) {
        // Clamping is safe: counts are used only if lattice_points() is within its limit.
        return static_cast<std::int32_t>(
            std::clamp(std::ceil(length / request.edge - 1e-9), 1.0, 1e9));
    };
    return {count(size.x), count(size.y), count(size.z)};
}

class SurfaceFinder {
public:
    SurfaceFinder(const CheckedFunction& function, const ImplicitRequest& request,
                  const std::atomic<bool>& cancel, const std::function<void(double)>& progress)
        : function_(function),
          lattice_(request.low, request.high, cells_of(request)),
          cancel_(cancel),
          progress_(progress) {}

    /// Makes the triangles of all cells, layer by layer.
    Result<SurfaceMesh> cut() {
        const std::int32_t layers = lattice_.counts()[2];
        LatticeLayer centres_below, corners_below, centres, corners_above;
        if (auto fine = look(-1, true, centres_below); !fine) return tl::unexpected(fine.error());
        if (auto fine = look(0, false, corners_below); !fine) return tl::unexpected(fine.error());
        for (std::int32_t layer = 0; layer <= layers; ++layer) {
            if (auto fine = look(layer, true, centres); !fine) return tl::unexpected(fine.error());
            cross_level_faces(lattice_, layer, centres_below, corners_below, centres, triangles_);
            if (layer < layers) {
                if (auto fine = look(layer + 1, false, corners_above); !fine) {
                    return tl::unexpected(fine.error());
                }
                cross_upright_faces(lattice_, layer, corners_below, centres, corners_above,
                                    triangles_);
            }
            std::swap(centres_below, centres);
            std::swap(corners_below, corners_above);
            if (triangles_.size() > most_cut_triangles) {
                return failure("the surface has too many triangles", "choose longer edges");
            }
            if (cancel_) return failure("the computation of the surface was stopped");
            if (progress_) progress_(0.5 * (layer + 1) / (layers + 1));
        }
        if (triangles_.empty()) {
            return failure(
                "the function of the surface is not above 0 at any sampled point of the box",
                "choose shorter edges, or another box");
        }
        return joined();
    }

private:
    Result<void> look(std::int32_t layer, bool is_centres, LatticeLayer& values) {
        const std::vector<LatticePoint> points = layer_points(lattice_, layer, is_centres);
        places_.clear();
        for (const LatticePoint& point : points) places_.push_back(lattice_.place_of(point));
        values.values.resize(points.size());
        if (Result<void> fine = function_(places_, values.values); !fine) return fine;
        for (std::size_t k = 0; k < points.size(); ++k) {
            if (!(values.values[k] > 0) || !lattice_.is_at_side(points[k])) continue;
            return failure(
                fmt::format("the surface leaves the box: its function is {:.6g} at {}",
                            values.values[k], text_of(places_[k])),
                "make the box larger, or write min(f, g) with a function g that is above 0 only "
                "inside the box");
        }
        return {};
    }

    /// The mesh with a point for each crossed edge, in the order of edges.
    SurfaceMesh joined() {
        std::vector<Crossing> crossings;
        crossings.reserve(3 * triangles_.size());
        for (const auto& triangle : triangles_) {
            crossings.insert(crossings.end(), triangle.begin(), triangle.end());
        }
        std::sort(crossings.begin(), crossings.end());
        crossings.erase(std::unique(crossings.begin(), crossings.end(),
                                    [](const Crossing& a, const Crossing& b) {
                                        return a.edge == b.edge;
                                    }),
                        crossings.end());
        std::vector<Vector3d> points;
        for (const Crossing& crossing : crossings) {
            const auto [first, second] = ends_of(crossing.edge);
            const Vector3d from = lattice_.place_of(lattice_.point_of(first));
            const Vector3d to = lattice_.place_of(lattice_.point_of(second));
            points.push_back(from +
                             (to - from) * std::clamp(crossing.part, least_part, 1 - least_part));
        }
        std::vector<std::array<std::uint32_t, 3>> corners;
        for (const auto& triangle : triangles_) {
            std::array<std::uint32_t, 3> numbers{};
            for (std::size_t k = 0; k < 3; ++k) {
                const auto found =
                    std::lower_bound(crossings.begin(), crossings.end(), triangle[k]);
                numbers[k] = static_cast<std::uint32_t>(found - crossings.begin());
            }
            corners.push_back(numbers);
        }
        triangles_ = {};
        return mesh_of(std::move(points), std::move(corners));
    }

    const CheckedFunction& function_;
    CentredLattice lattice_;
    const std::atomic<bool>& cancel_;
    const std::function<void(double)>& progress_;
    std::vector<Vector3d> places_;
    CrossedTriangles triangles_;
};

Result<void> check_request(const ImplicitRequest& request) {
    const Vector3d size = request.high - request.low;
    for (const double length : {size.x, size.y, size.z, request.edge}) {
        if (length >= least_shape_length && length <= largest_shape_length) continue;
        return failure(fmt::format("a box from {} to {} with edges of {:.6g} holds no surface",
                                   text_of(request.low), text_of(request.high), request.edge));
    }
    const double points = lattice_points(request);
    if (points <= most_lattice_points) return {};
    return failure(fmt::format("the function of the surface would be computed at {:.3g} points, "
                               "but at most {:.3g} are allowed",
                               points, most_lattice_points),
                   "choose longer edges or a smaller box");
}

}  // namespace

double lattice_points(const ImplicitRequest& request) {
    const Vector3d size = request.high - request.low;
    double centres = 1, corners = 1;
    for (const double length : {size.x, size.y, size.z}) {
        const double cells = std::max(1.0, std::ceil(length / request.edge));
        centres *= cells + 2;
        corners *= cells + 1;
    }
    return centres + corners;
}

Result<SurfaceMesh> implicit_surface(const ImplicitFunction& function,
                                     const ImplicitRequest& request,
                                     const std::atomic<bool>& cancel,
                                     const std::function<void(double)>& progress) {
    if (Result<void> fine = check_request(request); !fine) return tl::unexpected(fine.error());
    const CheckedFunction checked(function);
    Result<SurfaceMesh> mesh = SurfaceFinder(checked, request, cancel, progress).cut();
    if (!mesh) return mesh;
    Projector projector(checked, request);
    int round = 0;
    const auto bring_back = [&](std::span<Vector3d> points, std::span<const Vector3d> normals) {
        if (progress) progress(std::min(0.99, 0.5 + 0.06 * ++round));
        return projector.bring_back(points, normals);
    };
    if (Result<void> fine = isotropic_remesh(*mesh, request.edge, bring_back, cancel); !fine) {
        return tl::unexpected(fine.error());
    }
    if (cancel) return failure("the computation of the surface was stopped");
    if (progress) progress(1);
    return mesh;
}

}  // namespace cascade

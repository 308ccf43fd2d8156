// Rings of points with normals, joined by quadrilaterals that are cut along their shorter
// diagonals.
#include "mesh/swept_shape.h"

#include "core/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace cascade {

namespace {

constexpr double step = 1e-5;       ///< The step in t and s of finite differences.
constexpr double pole_step = 1e-4;  ///< The distance from a pole at which normals are measured.
/// Parts smaller than this fraction of the shape count as points.
constexpr double vanishing_part = 1e-9;

/// Evaluates a surface, and remembers the first parameters at which it is not finite.
class Probe {
public:
    explicit Probe(const SweptSurface& surface) : surface_(surface) {}

    Vector3d at(double t, double s) {
        s -= std::floor(s);
        const Vector3d place = surface_(t, s);
        if (!is_finite(place)) note("the shape", t, s);
        return place;
    }
    /// A vector perpendicular to the surface, of any length.
    Vector3d normal(double t, double s) {
        const double before = std::max(0.0, t - step), after = std::min(1.0, t + step);
        const Vector3d along = (at(after, s) - at(before, s)) * (1 / (after - before));
        return cross(along, at(t, s + step) - at(t, s - step));
    }
    void note(const char* what, double t, double s) {
        if (fault_.empty())
            fault_ = fmt::format("{} is not finite at t = {:g}, s = {:g}", what, t, s);
    }
    const std::string& fault() const { return fault_; }

private:
    const SweptSurface& surface_;
    std::string fault_;
};

Vector3d derivative(const std::function<Vector3d(double)>& line, double t) {
    return line(std::min(1.0, t + step)) - line(std::max(0.0, t - step));
}

class SweptMesh {
public:
    SweptMesh(const SweptSurface& surface, SweptFacets facets, const SweptNumber& shade)
        : probe_(surface), facets_(facets), shade_(shade) {}

    Result<TriangleMesh> make() {
        for (std::uint32_t i = 0; i <= facets_.along; ++i) add_ring(i);
        if (!probe_.fault().empty()) return failure(probe_.fault());
        const double size = length(high_ - low_);
        for (const std::uint32_t end : {0u, facets_.along}) {
            if (is_point(end, vanishing_part * size)) make_pole(end);
            else add_cap(end);
        }
        for (std::uint32_t i = 0; i < facets_.along; ++i) join(i);
        const double volume = this->volume();
        if (!(std::abs(volume) > vanishing_part * size * size * size)) {
            return failure("the shape encloses no volume");
        }
        if (volume < 0) turn_around();
        set_normals();
        return std::move(mesh_);
    }

private:
    double t_of(std::uint32_t ring) const { return static_cast<double>(ring) / facets_.along; }
    double s_of(double number) const { return number / facets_.around; }
    std::uint32_t vertex(std::uint32_t ring, std::uint32_t number) const {
        return ring * facets_.around + number % facets_.around;
    }

    std::uint32_t add(Vector3d place, Vector3d normal, double shade) {
        places_.push_back(place);
        normals_.push_back(normal);
        mesh_.positions.push_back(single(place));
        if (shade_) mesh_.shades.push_back(static_cast<float>(std::clamp(shade, 0.0, 1.0)));
        return static_cast<std::uint32_t>(places_.size() - 1);
    }

    double shade_at(double t, double s) {
        if (!shade_) return 1;
        const double shade = shade_(t, s);
        if (!std::isfinite(shade)) probe_.note("the shade", t, s);
        return shade;
    }

    void add_ring(std::uint32_t ring) {
        const double t = t_of(ring);
        // Checks the position before the normal, because the message must name the position if both
        // are not finite.
        for (std::uint32_t j = 0; j < facets_.around; ++j) {
            const Vector3d place = probe_.at(t, s_of(j));
            if (places_.empty()) low_ = high_ = place;
            low_ = {std::min(low_.x, place.x), std::min(low_.y, place.y),
                    std::min(low_.z, place.z)};
            high_ = {std::max(high_.x, place.x), std::max(high_.y, place.y),
                     std::max(high_.z, place.z)};
            add(place, {}, shade_at(t, s_of(j)));
        }
        // An end may be a pole, with one vertex for each sector of the ring. Each of these vertices
        // has the normal of its sector.
        const bool is_end = ring == 0 || ring == facets_.along;
        const double inside = is_end ? std::clamp(t, pole_step, 1 - pole_step) : t;
        for (std::uint32_t j = 0; j < facets_.around; ++j) {
            normals_[vertex(ring, j)] = probe_.normal(inside, s_of(is_end ? j + 0.5 : j));
        }
    }

    bool is_point(std::uint32_t ring, double size) const {
        for (std::uint32_t j = 1; j < facets_.around; ++j) {
            if (length(places_[vertex(ring, j)] - places_[vertex(ring, 0)]) > size) return false;
        }
        return true;
    }

    void make_pole(std::uint32_t ring) {
        is_pole_[ring == 0 ? 0 : 1] = true;
        for (std::uint32_t j = 1; j < facets_.around; ++j) {
            places_[vertex(ring, j)] = places_[vertex(ring, 0)];
            mesh_.positions[vertex(ring, j)] = mesh_.positions[vertex(ring, 0)];
        }
    }

    /// Closes an end with a cap. The ring of the surface gets the normals at its own points. The
    /// cap has separate vertices, which get the normals of the cap's triangles.
    void add_cap(std::uint32_t ring) {
        const double t = t_of(ring);
        Vector3d middle;
        for (std::uint32_t j = 0; j < facets_.around; ++j) {
            middle = middle + places_[vertex(ring, j)] * (1.0 / facets_.around);
            normals_[vertex(ring, j)] = probe_.normal(t, s_of(j));
        }
        // Adds the centre without a normal, so that set_normals() uses the triangles' normals.
        const std::uint32_t centre = add(middle, {}, shade_at(t, 0));
        const std::uint32_t first = centre + 1;
        for (std::uint32_t j = 0; j < facets_.around; ++j) {
            add(places_[vertex(ring, j)], {}, shade_at(t, s_of(j)));
        }
        for (std::uint32_t j = 0; j < facets_.around; ++j) {
            const std::uint32_t here = first + j, next = first + (j + 1) % facets_.around;
            if (ring == 0) mesh_.triangles.push_back({centre, here, next});
            else mesh_.triangles.push_back({centre, next, here});
        }
    }

    /// Adds the quadrilaterals between a ring and the next.
    void join(std::uint32_t ring) {
        const bool from_point = ring == 0 && is_pole_[0];
        const bool to_point = ring + 1 == facets_.along && is_pole_[1];
        for (std::uint32_t j = 0; j < facets_.around; ++j) {
            const std::uint32_t a = vertex(ring, j), b = vertex(ring + 1, j);
            const std::uint32_t c = vertex(ring + 1, j + 1), d = vertex(ring, j + 1);
            if (from_point) {
                mesh_.triangles.push_back({a, b, c});
            } else if (to_point) {
                mesh_.triangles.push_back({a, b, d});
            } else if (length(places_[a] - places_[c]) <= length(places_[b] - places_[d])) {
                mesh_.triangles.push_back({a, b, c});
                mesh_.triangles.push_back({a, c, d});
            } else {
                mesh_.triangles.push_back({a, b, d});
                mesh_.triangles.push_back({b, c, d});
            }
        }
    }

    double volume() const {
        double sum = 0;
        for (const auto& [a, b, c] : mesh_.triangles) {
            sum += dot(places_[a] - places_[0],
                       cross(places_[b] - places_[0], places_[c] - places_[0]));
        }
        return sum / 6;
    }

    void turn_around() {
        for (auto& triangle : mesh_.triangles) std::swap(triangle[1], triangle[2]);
        for (Vector3d& normal : normals_) normal = -normal;
    }

    /// Sets the normals to the surface's normals. Where the surface has none, uses the normals of
    /// the triangles.
    void set_normals() {
        smooth_normals(mesh_);
        for (std::size_t k = 0; k < normals_.size(); ++k) {
            const Vector3d normal = unit(normals_[k]);
            if (length(normal) > 0.5) mesh_.normals[k] = single(normal);
        }
    }

    Probe probe_;
    SweptFacets facets_;
    const SweptNumber& shade_;
    TriangleMesh mesh_;
    std::vector<Vector3d> places_, normals_;  ///< Normals may have any length.
    Vector3d low_, high_;
    std::array<bool, 2> is_pole_{};  ///< Whether the first and the last ring are poles.
};

constexpr std::uint32_t lines = 24;  ///< The number of lines along which facets are tested.
constexpr std::array<double, 3> between = {0.25, 0.5, 0.75};

/// The distance of a point from the line through a and b.
double distance_from_line(Vector3d p, Vector3d a, Vector3d b) {
    return length(p - (a + (b - a) * nearest_fraction(a, b, p)));
}

/// Whether polygons with `count` edges approximate the lines `place(line, part)`, 0 ≤ part ≤ 1,
/// within the tolerance of `detail`.
template <typename Place>
bool keeps_to(const SweptDetail& detail, std::uint32_t count, const Place& place) {
    for (std::uint32_t line = 0; line < lines; ++line) {
        Vector3d before = place(line, 0);
        for (std::uint32_t k = 0; k < count; ++k) {
            const Vector3d after = place(line, (k + 1.0) / count);
            if (length(after - before) > detail.longest_edge) return false;
            for (const double part : between) {
                // The errors along t and around add up, so each may be half of the tolerance.
                const double error =
                    distance_from_line(place(line, (k + part) / count), before, after);
                if (error > detail.tolerance / 2) return false;
            }
            before = after;
        }
    }
    return true;
}

/// The length of the longest edge in a mesh with these numbers of facets.
double longest_edge(Probe& probe, SweptFacets facets) {
    double longest = 0;
    for (std::uint32_t i = 0; i < facets.along; ++i) {
        for (std::uint32_t j = 0; j < facets.around; ++j) {
            const auto at = [&](std::uint32_t along, std::uint32_t around) {
                return probe.at(static_cast<double>(i + along) / facets.along,
                                static_cast<double>(j + around) / facets.around);
            };
            const Vector3d a = at(0, 0), b = at(1, 0), c = at(1, 1), d = at(0, 1);
            longest = std::max({longest, length(b - a), length(c - b), length(d - a),
                                std::min(length(c - a), length(d - b))});
        }
    }
    return longest;
}

std::uint32_t more(std::uint32_t count) { return count + 1 + count / 4; }

tl::unexpected<Failure> too_fine(const char* direction) {
    return failure(fmt::format("the shape would need more than {} facets {}", most_swept_facets,
                               direction),
                   "choose longer edges or a larger tolerance");
}

}  // namespace

SweptSurface surface_of(Tube tube) {
    struct Ring {
        double t = -1;
        Vector3d middle, across, beside;
    };
    // Stores the last ring, because successive points often have the same t.
    return [tube = std::move(tube), ring = Ring()](double t, double s) mutable {
        if (ring.t != t) {
            Vector3d along = unit(derivative(tube.middle, t));
            if (!(length(along) > 0.5)) along = {0, 1, 0};
            Vector3d across = Vector3d{1, 0, 0} - along * along.x;
            if (length(across) < vanishing_part) across = Vector3d{0, 0, 1} - along * along.z;
            across = unit(across);
            ring = {t, tube.middle(t), across, cross(across, along)};
        }
        const double angle = 2 * std::numbers::pi * s;
        const Vector3d out = ring.across * std::cos(angle) + ring.beside * std::sin(angle);
        return ring.middle + out * tube.radius(t, s);
    };
}

Result<SweptFacets> facets_for(const SweptSurface& surface, const SweptDetail& detail) {
    CHECK(detail.longest_edge > 0 && detail.tolerance > 0, "a detail has a size");
    Probe probe(surface);
    SweptFacets facets{2, 3};
    const auto along = [&](std::uint32_t line, double part) {
        return probe.at(part, (line + 0.5) / lines);
    };
    const auto around = [&](std::uint32_t line, double part) {
        return probe.at((line + 0.5) / lines, part);
    };
    while (probe.fault().empty() && !keeps_to(detail, facets.along, along)) {
        facets.along = more(facets.along);
        if (facets.along > most_swept_facets) return too_fine("along t");
    }
    while (probe.fault().empty() && !keeps_to(detail, facets.around, around)) {
        facets.around = more(facets.around);
        if (facets.around > most_swept_facets) return too_fine("around");
    }
    // Diagonals are longer than sides, so more facets may be needed.
    while (probe.fault().empty() && longest_edge(probe, facets) > detail.longest_edge) {
        facets = {more(facets.along), more(facets.around)};
        if (facets.along > most_swept_facets) return too_fine("along t");
        if (facets.around > most_swept_facets) return too_fine("around");
    }
    if (!probe.fault().empty()) return failure(probe.fault());
    return facets;
}

Result<TriangleMesh> swept_shape(const SweptSurface& surface, SweptFacets facets,
                                 const SweptNumber& shade) {
    CHECK(facets.along >= 2 && facets.around >= 3, "a swept shape has facets in both directions");
    return SweptMesh(surface, facets, shade).make();
}

}  // namespace cascade

// Repeatedly halves all edges that are too long, and splits each triangle according to which of its
// edges are halved. If two diagonals are possible, the shorter one is used. Adjacency is updated.
#include "export/refine.h"

#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

namespace cascade {

namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Weights = std::array<double, 3>;

/// Corners of a part of a triangle. 0 … 2 are the triangle's own corners, and 3 + k is the middle
/// of its edge k.
using Part = std::array<std::uint32_t, 3>;

/// Divides a triangle, some of whose edges are halved, into parts. With two halved edges, the
/// corner between them is cut off, and the remaining quadrilateral is split along a diagonal. If
/// `is_first_shorter`, the diagonal begins at the corner before the first halved edge, otherwise at
/// the corner after the second.
std::vector<Part> parts_of(const std::array<bool, 3>& is_halved, bool is_first_shorter) {
    const int count = is_halved[0] + is_halved[1] + is_halved[2];
    if (count == 0) return {{0, 1, 2}};
    if (count == 3) return {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
    std::uint32_t a = 0;  // The first halved edge goes from a to b.
    while (!is_halved[a] || (count == 2 && !is_halved[corner_after(a)])) ++a;
    const std::uint32_t b = corner_after(a), c = corner_after(b);
    if (count == 1) return {{a, 3 + a, c}, {3 + a, b, c}};
    if (is_first_shorter) return {{3 + a, b, 3 + b}, {a, 3 + a, 3 + b}, {a, 3 + b, c}};
    return {{3 + a, b, 3 + b}, {a, 3 + a, c}, {3 + a, 3 + b, c}};
}

/// The triangles of the refined mesh, with their positions in the original mesh.
class Refiner {
public:
    explicit Refiner(const SurfaceMesh& mesh)
        : first_(mesh),
          points_(mesh.points),
          triangles_(mesh.triangles),
          across_(mesh.across),
          places_(mesh.points.size()) {
        constexpr Weights corners[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
            origins_.push_back({t, {corners[0], corners[1], corners[2]}});
            for (std::size_t k = 0; k < 3; ++k) places_[triangles_[t][k]] = {t, corners[k]};
        }
    }

    /// Halves all edges that are too long, once. Returns false if there are none, or if there would
    /// be too many triangles.
    bool halve(double longest, std::size_t most_triangles) {
        find_middles(longest);
        std::size_t count = triangles_.size();
        for (const auto& middles : middles_) {
            for (const std::uint32_t middle : middles) count += middle != none;
        }
        if (count == triangles_.size() || count > most_triangles) {
            points_.resize(places_.size());
            return false;
        }
        add_places();
        split();
        return true;
    }

    RefinedMesh finished() {
        RefinedMesh result;
        SurfaceMesh& mesh = result.mesh;
        mesh.points = std::move(points_);
        mesh.triangles = std::move(triangles_);
        mesh.across = std::move(across_);
        if (!first_.texture.empty()) {
            for (const TriangleOrigin& origin : origins_)
                mesh.texture.push_back(texture_of(origin));
        }
        for (const PointAttribute& attribute : first_.attributes) {
            PointAttribute taken{attribute.name, {}};
            for (const SurfacePlace& place : places_) {
                taken.values.push_back(value_of(attribute, place));
            }
            mesh.attributes.push_back(std::move(taken));
        }
        result.places = std::move(places_);
        result.origins = std::move(origins_);
        return result;
    }

private:
    static constexpr std::uint32_t none = TriangleEdge::none;

    double length_between(std::uint32_t a, std::uint32_t b) const {
        return length(points_[a] - points_[b]);
    }

    void find_middles(double longest) {
        middles_.assign(triangles_.size(), {none, none, none});
        for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
            for (std::uint32_t k = 0; k < 3; ++k) {
                const TriangleEdge other = across_[t][k];
                if (middles_[t][k] != none) continue;
                const std::uint32_t a = triangles_[t][k], b = triangles_[t][corner_after(k)];
                if (!(length_between(a, b) > longest)) continue;
                middles_[t][k] = static_cast<std::uint32_t>(points_.size());
                if (other.exists()) middles_[other.triangle][other.edge] = middles_[t][k];
                points_.push_back((points_[a] + points_[b]) * 0.5);
            }
        }
    }

    static Weights between(const Weights& a, const Weights& b) {
        return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
    }

    void add_places() {
        places_.resize(points_.size());
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            for (std::uint32_t k = 0; k < 3; ++k) {
                if (middles_[t][k] == none) continue;
                places_[middles_[t][k]] = {origins_[t].triangle,
                                           between(origins_[t].corners[k],
                                                   origins_[t].corners[corner_after(k)])};
            }
        }
    }

    void split() {
        std::vector<Triangle> triangles;
        std::vector<TriangleOrigin> origins;
        std::vector<std::array<TriangleEdge, 3>> across;
        // The pieces of each edge of the old triangles: both halves of a halved edge, or a single
        // piece.
        std::vector<std::array<std::array<TriangleEdge, 2>, 3>> pieces(triangles_.size());
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            const auto first = static_cast<std::uint32_t>(triangles.size());
            const std::vector<Part> parts = parts_of_triangle(t);
            for (const Part& part : parts) {
                Triangle corners{};
                TriangleOrigin origin{origins_[t].triangle, {}};
                for (std::size_t k = 0; k < 3; ++k) {
                    const std::uint32_t label = part[k], edge = label % 3;
                    corners[k] = label < 3 ? triangles_[t][label] : middles_[t][edge];
                    origin.corners[k] = label < 3
                                            ? origins_[t].corners[label]
                                            : between(origins_[t].corners[edge],
                                                      origins_[t].corners[corner_after(edge)]);
                }
                triangles.push_back(corners);
                origins.push_back(origin);
            }
            across.resize(triangles.size());
            link_parts(parts, first, across, pieces[t]);
        }
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k) {
                const TriangleEdge other = across_[t][k];
                if (!other.exists()) continue;
                const auto& mine = pieces[t][k];
                const auto& theirs = pieces[other.triangle][other.edge];
                const bool is_halved = middles_[t][k] != none;
                for (std::size_t half = 0; half < (is_halved ? 2u : 1u); ++half) {
                    across[mine[half].triangle][mine[half].edge] = theirs[is_halved ? 1 - half : 0];
                }
            }
        }
        triangles_ = std::move(triangles);
        origins_ = std::move(origins);
        across_ = std::move(across);
    }

    std::vector<Part> parts_of_triangle(std::size_t t) const {
        const auto& middles = middles_[t];
        const std::array<bool, 3> is_halved = {middles[0] != none, middles[1] != none,
                                               middles[2] != none};
        bool is_first_shorter = true;
        for (std::uint32_t a = 0; a < 3; ++a) {
            const std::uint32_t b = corner_after(a), c = corner_after(b);
            if (!is_halved[a] || !is_halved[b] || is_halved[c]) continue;
            is_first_shorter = length_between(triangles_[t][a], middles[b]) <=
                               length_between(middles[a], triangles_[t][c]);
        }
        return parts_of(is_halved, is_first_shorter);
    }

    /// Links the parts of a triangle with each other and finds the pieces of its edges.
    static void link_parts(std::span<const Part> parts, std::uint32_t first,
                           std::vector<std::array<TriangleEdge, 3>>& across,
                           std::array<std::array<TriangleEdge, 2>, 3>& pieces) {
        const auto find = [&](std::uint32_t from, std::uint32_t to) -> std::optional<TriangleEdge> {
            for (std::uint32_t p = 0; p < parts.size(); ++p) {
                for (std::uint32_t k = 0; k < 3; ++k) {
                    if (parts[p][k] == from && parts[p][corner_after(k)] == to) {
                        return TriangleEdge{first + p, k};
                    }
                }
            }
            return std::nullopt;
        };
        for (std::uint32_t p = 0; p < parts.size(); ++p) {
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t from = parts[p][k], to = parts[p][corner_after(k)];
                if (const auto beyond = find(to, from)) across[first + p][k] = *beyond;
                else
                    pieces[from % 3][from < 3 ? 0 : 1] = {first + p,
                                                          k};  // A whole edge is piece 0.
            }
        }
    }

    std::array<TexturePlace, 3> texture_of(const TriangleOrigin& origin) const {
        std::array<TexturePlace, 3> places;
        const auto& corners = first_.texture[origin.triangle];
        for (std::size_t k = 0; k < 3; ++k) {
            for (std::size_t c = 0; c < 2; ++c) {
                double sum = 0;
                for (std::size_t corner = 0; corner < 3; ++corner) {
                    sum += origin.corners[k][corner] * static_cast<double>(corners[corner][c]);
                }
                places[k][c] = static_cast<float>(sum);
            }
        }
        return places;
    }

    float value_of(const PointAttribute& attribute, const SurfacePlace& place) const {
        double sum = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t point = first_.triangles[place.triangle][k];
            if (place.weights[k] > 0) {
                sum += place.weights[k] * static_cast<double>(attribute.values[point]);
            }
        }
        return static_cast<float>(sum);
    }

    const SurfaceMesh& first_;
    std::vector<Vector3d> points_;
    std::vector<Triangle> triangles_;
    std::vector<std::array<TriangleEdge, 3>> across_;
    std::vector<SurfacePlace> places_;     ///< One per point.
    std::vector<TriangleOrigin> origins_;  ///< One per triangle.
    /// For each edge of a triangle, the new point in its middle, if any.
    std::vector<Triangle> middles_;
};

}  // namespace

RefinedMesh refined(const SurfaceMesh& mesh, double longest_edge, std::size_t most_triangles) {
    Refiner refiner(mesh);
    while (refiner.halve(longest_edge, most_triangles)) {
    }
    return refiner.finished();
}

void displace(SurfaceMesh& mesh, std::span<const Vector3d> normals,
              std::span<const float> heights) {
    for (std::size_t p = 0; p < mesh.points.size(); ++p) {
        if (!std::isfinite(heights[p])) continue;
        mesh.points[p] = mesh.points[p] + normals[p] * static_cast<double>(heights[p]);
    }
}

}  // namespace cascade

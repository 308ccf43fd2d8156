// Old points are removed in rounds, with edges improved after each, first under strict and then
// under weaker tests of the new triangles.
#include "surface/retile.h"

#include "surface/flip_edges.h"
#include "surface/mutual_tessellation.h"
#include "surface/remove_points.h"

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

constexpr int most_rounds = 16;  ///< Attempts to remove points that could not be removed before.

class Retiler {
public:
    Retiler(const SurfaceMesh& old, std::span<const SurfacePlace> places, HalfEdges& mesh,
            MutualTessellation made)
        : old_(old),
          places_(places),
          mesh_(mesh),
          made_(std::move(made)),
          removal_(mesh, made_.normals, spacing(old, places.size())),
          flipper_(mesh, made_.normals) {
        std::vector<bool> is_place(old.points.size());
        for (const std::uint32_t point : made_.point_of_place) {
            if (point < is_place.size()) is_place[point] = true;
        }
        for (std::uint32_t point = 0; point < is_place.size(); ++point) {
            if (!is_place[point]) left_.push_back({point, WhyKept::topology});
        }
    }

    Result<Retiled> retile(const std::atomic<bool>& cancel) {
        flipper_.improve(cancel);
        for (const Care care : {Care::high, Care::low}) {
            bool is_changed = true;
            for (int round = 0; round < most_rounds && is_changed && !left_.empty(); ++round) {
                is_changed = remove_all(care, cancel);
                if (is_changed) flipper_.improve(cancel);
            }
        }
        if (cancel) return failure("re-tiling the surface was stopped");
        return result();
    }

private:
    /// The side of a square with a place's share of the area.
    static double spacing(const SurfaceMesh& mesh, std::size_t places) {
        return std::sqrt(mesh.total_area() / static_cast<double>(std::max<std::size_t>(places, 1)));
    }

    /// Returns whether any point was removed.
    bool remove_all(Care care, const std::atomic<bool>& cancel) {
        const std::size_t before = left_.size();
        std::erase_if(left_, [&](KeptPoint& kept) {
            if (cancel) return false;
            const std::optional<WhyKept> why = removal_.remove(kept.old_point, care);
            if (why) {
                kept.why = *why;
                return false;
            }
            for (const FaceHandle f : removal_.changed()) flipper_.look_at(f);
            return true;
        });
        return left_.size() < before;
    }

    Retiled result() const {
        std::vector<std::uint32_t> points = made_.point_of_place;
        for (const KeptPoint& kept : left_) points.push_back(kept.old_point);
        Retiled result{surface_mesh(mesh_, points), left_};
        for (const PointAttribute& attribute : old_.attributes) {
            result.mesh.attributes.push_back({attribute.name, carried(attribute.values)});
        }
        return result;
    }

    std::vector<float> carried(const std::vector<float>& of_points) const {
        std::vector<float> values;
        for (const SurfacePlace& place : places_) {
            double sum = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                sum += place.weights[k] * of_points[old_.triangles[place.triangle][k]];
            }
            values.push_back(static_cast<float>(sum));
        }
        for (const KeptPoint& kept : left_) values.push_back(of_points[kept.old_point]);
        return values;
    }

    const SurfaceMesh& old_;
    std::span<const SurfacePlace> places_;
    HalfEdges& mesh_;
    MutualTessellation made_;
    PointRemoval removal_;
    EdgeFlipper flipper_;
    std::vector<KeptPoint> left_;  ///< Old points that remain.
};

}  // namespace

Result<Retiled> retile(const SurfaceMesh& mesh, std::span<const SurfacePlace> places,
                       const std::atomic<bool>& cancel) {
    Result<HalfEdges> edited = half_edges(mesh);
    if (!edited) return tl::unexpected(edited.error());
    Result<MutualTessellation> made = tessellate(*edited, mesh, places, cancel);
    if (!made) return tl::unexpected(made.error());
    return Retiler(mesh, places, *edited, *std::move(made)).retile(cancel);
}

}  // namespace cascade

// Writes what cells sense, cell by cell.
#include "tissue/sense_kernel.h"

#include "surface/place_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cascade {
namespace {

/// How far ahead of the present cell, in cells, data is brought to the cache.
constexpr std::int64_t ahead = 6;

class SenseKernel : public Kernel {
public:
    SenseKernel(std::shared_ptr<const Surroundings> surroundings, std::vector<Sense> senses,
                std::shared_ptr<NearTriangles> triangles)
        : surroundings_(std::move(surroundings)),
          senses_(std::move(senses)),
          triangles_(std::move(triangles)) {}

    void run(const KernelArgumentsOf<float>& arguments, const Patch& cells) const override {
        sense(arguments, cells);
    }
    void run(const KernelArgumentsOf<double>& arguments, const Patch& cells) const override {
        sense(arguments, cells);
    }

private:
    template <typename Number>
    void sense(const KernelArgumentsOf<Number>& arguments, const Patch& cells) const {
        const PlaneLayout& layout = arguments.layout;
        const auto count = static_cast<std::int64_t>(triangles_->before.size());
        for (std::int64_t row = cells.rows.begin; row < cells.rows.end; ++row) {
            for (std::int64_t column = 0; column < layout.width; ++column) {
                const std::int64_t place = row * layout.width + column;
                const auto cell = static_cast<std::size_t>(std::min(place, count - 1));
                if (place + ahead < count) {
                    surroundings_->prepare(
                        triangles_->before[static_cast<std::size_t>(place + ahead)]);
                }
                const std::int64_t at = layout.row_start(row) + column;
                const Vector3d point = {arguments.fields[0][at], arguments.fields[1][at],
                                        arguments.fields[2][at]};
                NearPlace other;
                const NearPlace& near = find(point, cell, place < count, other);
                if (place < count) triangles_->now[cell] = near.place.triangle;
                for (std::size_t k = 0; k < senses_.size(); ++k) {
                    arguments.results[k][at] = static_cast<Number>(value_of(senses_[k], near));
                }
            }
        }
    }

    /// `is_own`: the place is that of the cell, not one after the last cell, for which `other` is
    /// used.
    const NearPlace& find(Vector3d point, std::size_t cell, bool is_own, NearPlace& other) const {
        const std::uint32_t from = triangles_->before[cell];
        if (!is_own || triangles_->found.empty()) {
            return other = surroundings_->near(point, from);
        }
        NearTriangles::Found& found = triangles_->found[cell];
        if (found.point != point || found.from != from) {
            found.point = point;
            found.from = from;
            found.near = surroundings_->near(point, from);
        }
        return found.near;
    }

    static double value_of(const Sense& sense, const NearPlace& near) {
        switch (sense.kind) {
            case Sense::Kind::off: return near.off;
            case Sense::Kind::normal_x: return near.normal.x;
            case Sense::Kind::normal_y: return near.normal.y;
            case Sense::Kind::normal_z: return near.normal.z;
            case Sense::Kind::value: return sense.value(near);
        }
        return 0;
    }

    std::shared_ptr<const Surroundings> surroundings_;
    std::vector<Sense> senses_;
    std::shared_ptr<NearTriangles> triangles_;
};

/// Two adjacent cells along an axis and the part of the second.
struct Between {
    std::int64_t first = 0, second = 0;
    double part = 0;
};

Between between(double at, std::int64_t count, Boundary boundary) {
    if (!std::isfinite(at)) return {};
    const auto cells = static_cast<double>(count);
    const double from_centre = at - 0.5;
    double first = std::floor(from_centre);
    const double part = from_centre - first;
    if (boundary == Boundary::periodic) first -= cells * std::floor(first / cells);
    const auto inside = [&](double cell) {
        if (boundary == Boundary::periodic && cell >= cells) cell -= cells;
        return static_cast<std::int64_t>(std::clamp(cell, 0.0, cells - 1));
    };
    return {inside(first), inside(first + 1), part};
}

}  // namespace

KernelPointer make_sense_kernel(std::shared_ptr<const Surroundings> surroundings,
                                std::vector<Sense> senses,
                                std::shared_ptr<NearTriangles> triangles) {
    return std::make_shared<SenseKernel>(std::move(surroundings), std::move(senses),
                                         std::move(triangles));
}

PlaceValue feature_of(const SurfaceMesh& mesh) {
    std::vector<float> sizes;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        sizes.push_back(static_cast<float>(std::sqrt(mesh.area(t))));
    }
    return [sizes = std::move(sizes)](const NearPlace& near) -> double {
        return near.place.triangle < sizes.size() ? sizes[near.place.triangle] : 0.0F;
    };
}

PlaceValue of_points(const SurfaceMesh& mesh, std::vector<float> values) {
    return [&mesh, values = std::move(values)](const NearPlace& near) {
        return near.place.triangle < mesh.triangles.size() ? value_at(mesh, values, near.place) : 0;
    };
}

PlaceValue of_cells(const CellFilter& filter, std::vector<float> values) {
    return [&filter, values = std::move(values)](const NearPlace& near) {
        if (near.place.triangle == NearPlace::no_triangle) return 0.0;
        std::vector<CellShare> shares;
        filter.shares(near.place, shares);
        double sum = 0;
        for (const CellShare& share : shares) sum += double{share.weight} * values[share.cell];
        return sum;
    };
}

PlaceValue of_grid(const Field& values, Boundaries boundary) {
    return [&values, boundary](const NearPlace& near) {
        const PlaneLayout& layout = values.layout();
        const auto longest =
            static_cast<double>(std::max({layout.width, layout.height, layout.depth}));
        const std::array axes{between(near.position.x * longest, layout.width, boundary.x),
                              between(near.position.y * longest, layout.height, boundary.y),
                              between(near.position.z * longest, layout.depth, boundary.z)};
        double sum = 0;
        for (unsigned corner = 0; corner < 8; ++corner) {
            std::array<std::int64_t, 3> cell{};
            double weight = 1;
            for (std::size_t k = 0; k < 3; ++k) {
                const bool is_second = (corner >> k & 1U) != 0;
                cell[k] = is_second ? axes[k].second : axes[k].first;
                weight *= is_second ? axes[k].part : 1 - axes[k].part;
            }
            if (weight > 0) sum += weight * values.number_at(cell[0], cell[1], cell[2]);
        }
        return sum;
    };
}

}  // namespace cascade

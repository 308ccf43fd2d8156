// Writes for each cell the values that it senses.
#include "tissue/sense_kernel.h"

#include "core/links.h"
#include "surface/place_values.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

namespace cascade {
namespace {

class SenseKernel : public Kernel {
public:
    SenseKernel(std::shared_ptr<const Surroundings> surroundings, std::vector<Sense> senses,
                std::shared_ptr<NearTriangles> triangles, std::int64_t kept)
        : surroundings_(std::move(surroundings)),
          senses_(std::move(senses)),
          triangles_(std::move(triangles)),
          kept_count_(kept),
          kept_size_(key_size + senses_.size()),
          kept_(static_cast<std::size_t>(kept) * kept_size_) {
        std::fill_n(kept_.data(), static_cast<std::size_t>(kept) * kept_size_, NAN);
    }

    void run(const KernelArgumentsOf<float>& arguments, const Patch& cells) const override {
        sense(arguments, cells);
    }
    void run(const KernelArgumentsOf<double>& arguments, const Patch& cells) const override {
        sense(arguments, cells);
    }

private:
    /// The number of cells whose nearest positions are searched together. Such cells are in one
    /// row, so one thread computes all of them.
    static constexpr std::int64_t cells_at_once = 16;

    template <typename Number>
    void sense(const KernelArgumentsOf<Number>& arguments, const Patch& cells) const {
        const ColumnRange columns = cells.columns.within(arguments.layout.width);
        std::vector<double> of_others(cells_at_once * kept_size_, NAN);
        for (std::int64_t row = cells.rows.begin; row < cells.rows.end; ++row) {
            for (std::int64_t first = columns.begin; first < columns.end; first += cells_at_once) {
                sense_some(arguments, row, {first, std::min(first + cells_at_once, columns.end)},
                           of_others.data());
            }
        }
    }

    template <typename Number>
    void sense_some(const KernelArgumentsOf<Number>& arguments, std::int64_t row,
                    ColumnRange columns, double* of_others) const {
        const PlaneLayout& layout = arguments.layout;
        const auto count = static_cast<std::int64_t>(triangles_->before.size());
        std::array<double*, cells_at_once> sensed, unknown;
        std::array<Vector3d, cells_at_once> points;
        std::array<std::uint32_t, cells_at_once> from;
        std::array<NearPlace, cells_at_once> near;
        std::size_t looked_for = 0;
        for (std::int64_t column = columns.begin; column < columns.end; ++column) {
            const std::int64_t place = row * layout.width + column;
            const auto cell = static_cast<std::size_t>(std::min(place, count - 1));
            if (place + cells_at_once < count) {
                surroundings_->prepare(
                    triangles_->before[static_cast<std::size_t>(place + cells_at_once)]);
            }
            const auto lane = static_cast<std::size_t>(column - columns.begin);
            const bool is_kept = place < std::min(count, kept_count_);
            double* const own =
                is_kept ? kept_.data() + cell * kept_size_ : of_others + lane * kept_size_;
            const std::int64_t at = layout.row_start(row) + column;
            const Vector3d point = {arguments.fields[0][at], arguments.fields[1][at],
                                    arguments.fields[2][at]};
            sensed[lane] = own;
            const std::uint32_t triangle = triangles_->before[cell];
            const bool is_known =
                Vector3d{own[0], own[1], own[2]} == point && triangles_of(own).from == triangle;
            if (is_known) continue;
            points[looked_for] = point;
            from[looked_for] = triangle;
            unknown[looked_for++] = own;
        }
        surroundings_->near_all({points.data(), looked_for}, {from.data(), looked_for},
                                {near.data(), looked_for});
        for (std::size_t k = 0; k < looked_for; ++k) {
            keep(unknown[k], points[k], from[k], near[k]);
        }
        for (std::int64_t column = columns.begin; column < columns.end; ++column) {
            const double* const own = sensed[static_cast<std::size_t>(column - columns.begin)];
            const std::int64_t place = row * layout.width + column;
            if (place < count) {
                triangles_->now[static_cast<std::size_t>(place)] = triangles_of(own).found;
            }
            const std::int64_t at = layout.row_start(row) + column;
            for (std::size_t k = 0; k < senses_.size(); ++k) {
                arguments.results[k][at] = static_cast<Number>(own[key_size + k]);
            }
        }
    }

    /// Triangles of a search. The stored numbers of a cell are its position, these triangles, and
    /// the values that the cell senses.
    struct Triangles {
        std::uint32_t from = 0;   ///< The triangle at which the search began.
        std::uint32_t found = 0;  ///< The triangle at which the search ended.
    };
    static constexpr std::size_t key_size = 4;
    static Triangles triangles_of(const double* kept) { return std::bit_cast<Triangles>(kept[3]); }

    void keep(double* kept, Vector3d point, std::uint32_t from, const NearPlace& near) const {
        kept[0] = point.x;
        kept[1] = point.y;
        kept[2] = point.z;
        kept[3] = std::bit_cast<double>(Triangles{from, near.place.triangle});
        for (std::size_t k = 0; k < senses_.size(); ++k) {
            kept[key_size + k] = value_of(senses_[k], near);
        }
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
    std::int64_t kept_count_;
    std::size_t kept_size_;  ///< The number of stored numbers per cell, in `kept_`.
    mutable AlignedArray<double> kept_;
};

/// Two adjacent cells along an axis of a grid, and the weight of the second.
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
                                std::vector<Sense> senses, std::shared_ptr<NearTriangles> triangles,
                                std::int64_t kept) {
    return std::make_shared<SenseKernel>(std::move(surroundings), std::move(senses),
                                         std::move(triangles), kept);
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
        constexpr std::size_t usual_most = 32;
        std::vector<CellShare> shares;
        shares.reserve(usual_most);
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

// On grids, core/resample divides the cells. On models, values are interpolated along the surface.
// Let w be the weights of the cell filter around a position p, and x, f and g the positions, values
// and gradients of the cells. The value at p is then
//
//     Σ w f + ½ Σ w (g + Σ w g) · (p − x).
//
// The first sum alone would make the maxima of waves too low. Extrapolation from each cell along
// its gradient would make them too high by as much. In the mean of both, the errors by the
// curvature of f cancel. If the cells around p are not distributed evenly, the errors by the slope
// of f cancel, too.
#include "run/domain/cell_carrier.h"

#include "core/counted_cells.h"
#include "core/floating_point.h"
#include "core/resample.h"
#include "run/domain/field_values.h"
#include "surface/cell_filter.h"
#include "surface/cell_gradient.h"

#include <algorithm>
#include <vector>

namespace cascade {

namespace {

/// To divide a cell, values of other cells up to this distance, in cells, are needed. So values are
/// continued this far beyond the border of a mask.
constexpr int reach_beyond = 4;

/// Calls `visit(i, j, k)` for the neighbours of a cell along all axes.
template <typename Visit>
void visit_neighbours(const Grid& grid, std::int64_t i, std::int64_t j, std::int64_t k,
                      const Visit& visit) {
    const auto along = [](std::int64_t cell, std::int64_t cells, Boundary boundary,
                          const auto& take) {
        for (const std::int64_t next : {cell - 1, cell + 1}) {
            if (next >= 0 && next < cells) take(next);
            else if (boundary == Boundary::periodic) take((next + cells) % cells);
        }
    };
    along(i, grid.width, grid.boundary.x, [&](std::int64_t next) { visit(next, j, k); });
    along(j, grid.height, grid.boundary.y, [&](std::int64_t next) { visit(i, next, k); });
    along(k, grid.depth, grid.boundary.z, [&](std::int64_t next) { visit(i, j, next); });
}

template <typename Visit>
void visit_cells(const Grid& grid, const Visit& visit) {
    for (std::int64_t k = 0; k < grid.depth; ++k) {
        for (std::int64_t j = 0; j < grid.height; ++j) {
            for (std::int64_t i = 0; i < grid.width; ++i) visit(i, j, k);
        }
    }
}

/// Returns a copy of the plane in which cells just outside the mask have values, too. These cells
/// are filled in rounds, from the border outwards. Each cell gets the mean over its neighbours that
/// already have a value.
template <typename Number>
Plane<Number> continued(const Plane<Number>& plane, const Grid& grid, const Mask& inside) {
    Plane<Number> result = plane.clone();
    Mask known = inside.clone();
    for (int round = 0; round < reach_beyond; ++round) {
        Mask next = known.clone();
        visit_cells(grid, [&](std::int64_t i, std::int64_t j, std::int64_t k) {
            if (known.at(i, j, k)) return;
            double sum = 0;
            int count = 0;
            visit_neighbours(grid, i, j, k, [&](std::int64_t x, std::int64_t y, std::int64_t z) {
                if (!known.at(x, y, z)) return;
                sum += static_cast<double>(result.at(x, y, z));
                ++count;
            });
            if (count == 0) return;
            result.at(i, j, k) = static_cast<Number>(sum / count);
            next.at(i, j, k) = 1;
        });
        known = std::move(next);
    }
    return result;
}

/// Returns a smaller grid of the cells at one side of an axis, in the same order.
Grid face_of(const Grid& grid, std::size_t axis) {
    return {axis == 0 ? grid.height : grid.width, axis == 2 ? grid.height : grid.depth};
}

class FinerCarrier : public CellCarrier {
public:
    FinerCarrier(const Grid& grid, std::int64_t times, const DomainMask* mask,
                 const DomainMask* finer_mask, Crests crests)
        : grid_(grid), times_(times), mask_(mask), finer_mask_(finer_mask), crests_(crests) {}

    Field carried(const Field& values) const override {
        const FlushDenormals environment;
        const auto finer = [&](const auto& plane) {
            return Field(crests_ == Crests::levelled ? divided_in_range(plane, grid_, times_)
                                                     : divided(plane, grid_, times_));
        };
        Field result = values.visit([&](const auto& plane) {
            return mask_ == nullptr ? finer(plane) : finer(continued(plane, grid_, mask_->inside));
        });
        return finer_mask_ == nullptr ? std::move(result) : with_outside(result, *finer_mask_, 0);
    }

    Mask carried(const Mask& cells) const override {
        const Grid finer = finer_grid(grid_, times_);
        const auto cell = [&](std::int64_t of, std::int64_t cells_along) {
            return cells_along > 1 ? of / times_ : of;
        };
        Mask result{PlaneLayout(finer)};
        visit_cells(finer, [&](std::int64_t i, std::int64_t j, std::int64_t k) {
            result.at(i, j, k) =
                cells.at(cell(i, grid_.width), cell(j, grid_.height), cell(k, grid_.depth));
        });
        return result;
    }

    std::shared_ptr<const SideValues> carried(const SideValues& values,
                                              std::size_t side) const override {
        const Grid face = face_of(grid_, side / 2);
        const std::int64_t across = face.width > 1 ? times_ : 1,
                           down = face.height > 1 ? times_ : 1;
        SideValues result;
        for (std::int64_t j = 0; j < face.height * down; ++j) {
            for (std::int64_t i = 0; i < face.width * across; ++i) {
                result.numbers.push_back(values.at(j / down * face.width + i / across));
            }
        }
        return std::make_shared<const SideValues>(std::move(result));
    }

private:
    const Grid grid_;
    const std::int64_t times_;
    const DomainMask* mask_;
    const DomainMask* finer_mask_;
    const Crests crests_;
};

class WiderCarrier : public CellCarrier {
public:
    WiderCarrier(const Grid& grid, const Grid& wider) : grid_(grid), wider_(wider) {}

    Field carried(const Field& values) const override {
        return values.visit(
            [&](const auto& plane) { return Field(restricted(plane, grid_, wider_)); });
    }

    Mask carried(const Mask& cells) const override {
        const Field shares = carried(to_field(cells, Precision::single));
        Mask result{PlaneLayout(wider_)};
        for_each_cell([](std::uint8_t& to, float share) { to = share >= 0.5F ? 1 : 0; }, result,
                      shares.plane());
        return result;
    }

    std::shared_ptr<const SideValues> carried(const SideValues& values,
                                              std::size_t side) const override {
        const Grid face = face_of(grid_, side / 2), wider_face = face_of(wider_, side / 2);
        Plane<double> numbers{PlaneLayout(face)};
        visit_cells(face, [&](std::int64_t i, std::int64_t j, std::int64_t) {
            numbers.at(i, j) = values.at(j * face.width + i);
        });
        const Plane<double> result = restricted(numbers, face, wider_face);
        SideValues wider;
        visit_cells(wider_face, [&](std::int64_t i, std::int64_t j, std::int64_t) {
            wider.numbers.push_back(result.at(i, j));
        });
        return std::make_shared<const SideValues>(std::move(wider));
    }

private:
    const Grid grid_;
    const Grid wider_;
};

class ModelCarrier : public CellCarrier {
public:
    ModelCarrier(const ModelCells& from, const ModelCells& to, Team& team)
        : from_(from),
          to_(to),
          team_(team),
          filter_(from.mesh, from.spread().cells, team),
          gradient_weights_(
              cell_gradient_weights(from.mesh, from.spread().cells, team, never_cancelled)) {
        for (const SurfacePlace& place : from.spread().cells.places)
            places_.push_back(position_of(from.mesh, place));
    }

    Field carried(const Field& values) const override {
        const std::vector<double> numbers = cell_values(values, from_);
        const std::vector<Vector3d> slopes = gradients(numbers);
        const auto& places = to_.spread().cells.places;
        std::vector<double> result(places.size());
        team_.run([&](int thread) {
            const RowRange part =
                split_rows(static_cast<std::int64_t>(places.size()), thread, team_.size());
            std::vector<CellShare> shares;
            for (std::int64_t k = part.begin; k < part.end; ++k) {
                const SurfacePlace& place = places[static_cast<std::size_t>(k)];
                filter_.shares(place, shares);
                result[static_cast<std::size_t>(k)] = value_at(place, shares, numbers, slopes);
            }
        });
        return field_of_cells(result, to_, values.precision());
    }

    Mask carried(const Mask& cells) const override {
        const Grid& grid = from_.grid();
        std::vector<std::uint8_t> own(from_.count());
        for (std::int64_t k = 0; k < static_cast<std::int64_t>(own.size()); ++k)
            own[from_.cell_at(k)] = cells.row(k / grid.width)[k % grid.width];
        const auto& places = to_.spread().cells.places;
        Mask result{PlaneLayout(to_.grid())};
        std::vector<CellShare> shares;
        for (std::int64_t k = 0; k < to_.grid().cell_count(); ++k) {
            const std::int64_t last = static_cast<std::int64_t>(places.size()) - 1;
            filter_.shares(places[to_.cell_at(std::min(k, last))], shares);
            const auto nearest = std::max_element(shares.begin(), shares.end(),
                                                  [](const CellShare& a, const CellShare& b) {
                                                      return a.weight < b.weight;
                                                  });
            result.row(k / to_.grid().width)[k % to_.grid().width] = own[nearest->cell];
        }
        return result;
    }

    std::shared_ptr<const SideValues> carried(const SideValues&, std::size_t) const override {
        CHECK(false, "a model has no sides");
        return nullptr;
    }

private:
    std::vector<Vector3d> gradients(const std::vector<double>& numbers) const {
        const SurfaceCells& cells = from_.spread().cells;
        std::vector<Vector3d> result(numbers.size());
        std::size_t edge = 0;
        for (std::size_t cell = 0; cell < numbers.size(); ++cell) {
            for (; edge < cells.ends[cell]; ++edge) {
                const double rise = numbers[cells.edges[edge].neighbour] - numbers[cell];
                result[cell] = result[cell] + gradient_weights_[edge] * rise;
            }
        }
        return result;
    }

    double value_at(const SurfacePlace& place, const std::vector<CellShare>& shares,
                    const std::vector<double>& numbers, const std::vector<Vector3d>& slopes) const {
        const Vector3d point = position_of(from_.mesh, place);
        double low = numbers[shares[0].cell], high = low;
        Vector3d slope;
        for (const CellShare& share : shares) {
            slope = slope + slopes[share.cell] * static_cast<double>(share.weight);
            low = std::min(low, numbers[share.cell]);
            high = std::max(high, numbers[share.cell]);
        }
        double value = 0;
        for (const CellShare& share : shares) {
            const Vector3d way = point - places_[share.cell];
            value += static_cast<double>(share.weight) *
                     (numbers[share.cell] + dot(slopes[share.cell] + slope, way) / 2);
        }
        return std::clamp(value, low, high);
    }

    const ModelCells& from_;
    const ModelCells& to_;
    Team& team_;
    CellFilter filter_;
    std::vector<Vector3d> gradient_weights_;
    std::vector<Vector3d> places_;
};

}  // namespace

std::unique_ptr<CellCarrier> carrier_to_wider(const Grid& grid, const Grid& wider) {
    return std::make_unique<WiderCarrier>(grid, wider);
}

std::unique_ptr<CellCarrier> carrier_to_finer(const Grid& grid, std::int64_t times,
                                              const DomainMask* mask, const DomainMask* finer_mask,
                                              Crests crests) {
    return std::make_unique<FinerCarrier>(grid, times, mask, finer_mask, crests);
}

std::unique_ptr<CellCarrier> carrier_on_model(const ModelCells& from, const ModelCells& to,
                                              Team& team) {
    return std::make_unique<ModelCarrier>(from, to, team);
}

}  // namespace cascade

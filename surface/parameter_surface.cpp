// Computes the metric tensor by central differences of the function, and from it the planes that
// operators read.
#include "surface/parameter_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

namespace cascade {

namespace {

/// Half the width of a central difference. With this width, the truncation error and the rounding
/// error are both about 1e-10.
constexpr double difference = 1e-5;
/// A cell counts as degenerate if its area is less than this fraction of the mean area.
constexpr double degenerate_area = 1e-6;

/// The metric tensor JᵀJ of a cell. J holds the derivatives of the position by column and by row.
struct MetricTensor {
    double m11 = 0, m12 = 0, m22 = 0;
    double area() const { return std::sqrt(std::max(0.0, m11 * m22 - m12 * m12)); }
};

Position derivative(const Position& ahead, const Position& behind, double cells) {
    Position result{};
    for (std::size_t k = 0; k < 3; ++k) {
        result[k] = (ahead[k] - behind[k]) / (2 * difference * cells);
    }
    return result;
}

double dot(const Position& a, const Position& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

MetricTensor metric_at(const SurfaceFunction& surface, const Grid& grid, double sx, double sy) {
    const Position along_row =
        derivative(surface(sx + difference, sy), surface(sx - difference, sy),
                   static_cast<double>(grid.width));
    const Position along_column =
        derivative(surface(sx, sy + difference), surface(sx, sy - difference),
                   static_cast<double>(grid.height));
    return {dot(along_row, along_row), dot(along_row, along_column),
            dot(along_column, along_column)};
}

double centre(std::int64_t cell, std::int64_t side) {
    return (static_cast<double>(cell) + 0.5) / static_cast<double>(side);
}

std::string place_of(const Grid& grid, std::int64_t i, std::int64_t j) {
    return fmt::format("at sx = {:.6g}, sy = {:.6g} (column {}, row {})", centre(i, grid.width),
                       centre(j, grid.height), i, j);
}

}  // namespace

Result<SurfaceMetric> measure_surface(const SurfaceFunction& surface, const Grid& grid,
                                      std::optional<double> unit, Precision precision,
                                      std::int64_t detail) {
    std::vector<MetricTensor> tensors;
    tensors.reserve(static_cast<std::size_t>(grid.cell_count()));
    double whole = 0;
    for (std::int64_t j = 0; j < grid.height; ++j) {
        for (std::int64_t i = 0; i < grid.width; ++i) {
            const MetricTensor tensor =
                metric_at(surface, grid, centre(i, grid.width), centre(j, grid.height));
            if (!std::isfinite(tensor.m11 + tensor.m12 + tensor.m22)) {
                return failure("the surface is not finite " + place_of(grid, i, j));
            }
            whole += tensor.area();
            tensors.push_back(tensor);
        }
    }
    const double mean = whole / static_cast<double>(grid.cell_count());
    SurfaceMetric metric;
    const PlaneLayout layout(grid);
    for (Field* field : {&metric.inverse_11, &metric.inverse_12, &metric.inverse_22, &metric.area,
                         &metric.flow_11, &metric.flow_12, &metric.flow_22}) {
        *field = Field(layout, precision);
    }
    metric.unit = unit.value_or(std::sqrt(mean) * static_cast<double>(detail));
    for (std::int64_t j = 0; j < grid.height; ++j) {
        for (std::int64_t i = 0; i < grid.width; ++i) {
            const MetricTensor& tensor = tensors[static_cast<std::size_t>(j * grid.width + i)];
            const double area = tensor.area();
            // The condition is also true if all areas are 0, or if the two directions are nearly
            // parallel.
            if (!(area > degenerate_area * mean) ||
                !(area > degenerate_area * std::sqrt(tensor.m11 * tensor.m22))) {
                return failure("the surface has no area " + place_of(grid, i, j),
                               "its directions along sx and sy must not be zero or parallel; "
                               "leave out poles of the surface");
            }
            // Ṽ = [√m11, m12/√m11; 0, area/√m11] is upper triangular, and so is its inverse.
            const double row_length = std::sqrt(tensor.m11) / metric.unit;
            const double cell = area / (metric.unit * metric.unit);
            const double shear = tensor.m12 / (metric.unit * metric.unit);
            const auto set = [&](Field& field, double value) {
                field.visit([&](auto& plane) {
                    using Number = std::remove_reference_t<decltype(plane.at(i, j))>;
                    plane.at(i, j) = static_cast<Number>(value);
                });
            };
            set(metric.inverse_11, 1 / row_length);
            set(metric.inverse_12, -shear / (row_length * cell));
            set(metric.inverse_22, row_length / cell);
            set(metric.area, cell);
            set(metric.flow_11, tensor.m22 / area);
            set(metric.flow_12, -tensor.m12 / area);
            set(metric.flow_22, tensor.m11 / area);
        }
    }
    return metric;
}

}  // namespace cascade

// Compares the values of all cells in order. As soon as a value is NaN, the result is NaN.
#include "run/domain/field_values.h"

#include "core/check.h"
#include "core/counted_cells.h"
#include "core/floating_point.h"

#include <cmath>
#include <cstring>
#include <optional>

namespace cascade {

namespace {

/// Returns the value inside the mask for which beats(value, other) is true for every other value.
/// If several values are equal, returns the first of them. Returns NaN if a value is NaN.
template <typename Beats>
double extreme(const Field& field, const DomainMask* mask, const Beats& beats) {
    return field.visit([&](const auto& plane) -> double {
        std::optional<double> best;
        for (std::int64_t row = 0; row < plane.layout().row_count(); ++row) {
            for (std::int64_t i = 0; i < plane.layout().width; ++i) {
                if (mask && mask->inside.row(row)[i] == 0) continue;
                const double value = plane.row(row)[i];
                if (std::isnan(value)) return value;
                if (!best || beats(value, *best)) best = value;
            }
        }
        CHECK(best, "a domain has a cell");
        return *best;
    });
}

}  // namespace

Mask to_mask(const Field& field) {
    Mask mask(field.layout());
    const FlushDenormals environment;
    field.visit([&](const auto& plane) {
        for_each_cell([](std::uint8_t& is, auto value) { is = value != 0; }, mask, plane);
    });
    return mask;
}

Field to_field(const Mask& mask, Precision precision) {
    Field field(mask.layout(), precision);
    field.visit([&]<typename Number>(Plane<Number>& plane) {
        for_each_cell([](Number& value, bool is) { value = is ? 1 : 0; }, plane, mask);
    });
    return field;
}

double smallest(const Field& field, const DomainMask* mask) {
    return extreme(field, mask, [](double value, double least) { return value < least; });
}

double largest_value(const Field& field, const DomainMask* mask) {
    return extreme(field, mask, [](double value, double most) { return value > most; });
}

std::vector<double> first_values(std::span<const Field> fields) {
    std::vector<double> values;
    for (const Field& field : fields) values.push_back(field.number_at(0, 0));
    return values;
}

bool is_same_everywhere(const Field& field) {
    return field.visit([](const auto& plane) {
        const auto* first = plane.row(0);
        for (std::int64_t row = 0; row < plane.layout().row_count(); ++row) {
            for (std::int64_t i = 0; i < plane.layout().width; ++i) {
                if (std::memcmp(plane.row(row) + i, first, sizeof *first) != 0) return false;
            }
        }
        return true;
    });
}

}  // namespace cascade

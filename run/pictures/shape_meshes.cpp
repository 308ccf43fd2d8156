// Each part of a shape has its own functions. A function stores its values at the last point, and
// later calls for the same point reuse them.
#include "run/pictures/shape_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>

namespace cascade {

namespace {

constexpr double steps_of_range = 16;

/// Makes a function of a point. Copies of the function share stored values.
std::shared_ptr<ShapeFunction> function_of(const Formula& formula, std::span<const double> values,
                                           double part) {
    return std::make_shared<ShapeFunction>(formula, values, part);
}

SweptSurface surface_of(const ShapeForm& form, std::span<const double> values, double part) {
    if (!form.place.nodes.empty()) {
        return [place = function_of(form.place, values, part)](double t, double s) {
            return (*place)(t, s);
        };
    }
    Tube tube;
    tube.radius = [radius = function_of(form.radius, values, part)](double t, double s) {
        return (*radius)(t, s).x;
    };
    tube.middle = [](double t) { return Vector3d{0, t, 0}; };
    if (!form.middle.nodes.empty()) {
        tube.middle = [middle = function_of(form.middle, values, part)](double t) {
            return (*middle)(t, 0);
        };
    }
    return surface_of(std::move(tube));
}

/// Rounds the values of a quantity.
struct Rounding {
    double low = 0, high = 0, step = 0;

    double operator()(double value) const {
        value = std::clamp(value, low, high);
        if (!(step > 0)) return value;
        return std::min(low + std::round((value - low) / step) * step, high);
    }
};

Rounding rounding_of(const Quantity& quantity, std::span<const double> values) {
    if (const auto& range = quantity.range) {
        return {range->low, range->high,
                range->step.value_or((range->high - range->low) / steps_of_range)};
    }
    Rounding rounding;
    bool is_first = true;
    for (const double value : values) {
        if (!std::isfinite(value)) continue;
        rounding.low = is_first ? value : std::min(rounding.low, value);
        rounding.high = is_first ? value : std::max(rounding.high, value);
        is_first = false;
    }
    rounding.step = (rounding.high - rounding.low) / steps_of_range;
    return rounding;
}

}  // namespace

std::vector<ShapePart> parts_of(const ShapeForm& form, std::span<const double> values) {
    std::vector<ShapePart> parts;
    for (std::uint32_t k = 0; k < form.parts; ++k) {
        ShapePart part{surface_of(form, values, k), {}};
        if (!form.shade.nodes.empty()) {
            part.shade = [shade = function_of(form.shade, values, k)](double t, double s) {
                return (*shade)(t, s).x;
            };
        }
        parts.push_back(std::move(part));
    }
    return parts;
}

std::string fault_of(const ShapeForm& form, std::span<const double> values) {
    constexpr int tried = 12;
    for (const ShapePart& part : parts_of(form, values)) {
        for (int i = 0; i <= tried; ++i) {
            for (int j = 0; j < tried; ++j) {
                const double t = static_cast<double>(i) / tried;
                const double s = static_cast<double>(j) / tried;
                const Vector3d place = part.surface(t, s);
                const bool is_shaded = !part.shade || std::isfinite(part.shade(t, s));
                if (!is_finite(place) || !is_shaded) {
                    return fmt::format("is not finite at t = {:.3g}, s = {:.3g}", t, s);
                }
                if (length(place) > largest_of_shape) {
                    return fmt::format("reaches {:.3g} at t = {:.3g}, s = {:.3g}", length(place), t,
                                       s);
                }
            }
        }
        const auto made = swept_shape(part.surface, {tried, tried}, part.shade);
        if (!made) return "cannot be drawn: " + made.error().message;
    }
    return {};
}

SharedShapes share_shapes(const ShapeForm& form, std::span<const QuantityValues> values,
                          std::size_t cell_count, std::size_t most) {
    std::vector<Rounding> roundings;
    for (const QuantityValues& each : values) {
        roundings.push_back(rounding_of(form.quantities[each.quantity], each.of_cells));
    }
    SharedShapes shared;
    while (true) {
        std::map<std::vector<double>, std::uint32_t> known;
        shared.shapes.clear();
        shared.of_cells.assign(cell_count, SharedShapes::none);
        for (std::size_t cell = 0; cell < cell_count && known.size() <= most; ++cell) {
            std::vector<double> key;
            for (std::size_t k = 0; k < values.size(); ++k) {
                key.push_back(roundings[k](values[k].of_cells[cell]));
            }
            const auto is_finite = [](double value) { return std::isfinite(value); };
            if (!std::ranges::all_of(key, is_finite)) continue;
            const auto number = static_cast<std::uint32_t>(shared.shapes.size());
            const auto [shape, is_new] = known.try_emplace(key, number);
            shared.of_cells[cell] = shape->second;
            if (!is_new) continue;
            ShapeValues& made = shared.shapes.emplace_back(form.usual);
            for (std::size_t k = 0; k < values.size(); ++k) {
                made[values[k].quantity.index()] = key[k];
            }
        }
        if (known.size() <= most) return shared;
        for (Rounding& rounding : roundings) rounding.step *= 2;
    }
}

}  // namespace cascade

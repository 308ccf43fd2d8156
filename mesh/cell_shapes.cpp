// Each shape is a few closed surfaces over t, from root to tip, and s, around.
#include "mesh/cell_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace cascade {

namespace {

constexpr double pi = std::numbers::pi;

double mix(double a, double b, double part) { return a + (b - a) * part; }

/// 0 below `low`, 1 above `high`, smooth between them.
double rise(double low, double high, double x) {
    const double part = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return part * part * (3 - 2 * part);
}

/// A hump of height 1 and a width around 0.
double ridge(double x, double width) { return std::exp(-(x / width) * (x / width)); }

/// An arc from the origin upwards that bends by an angle towards z, and ends at height 1.
Vector3d arc(double angle, double t) {
    if (angle < 1e-3) return {0, t, 0};
    return Vector3d{0, std::sin(angle * t), 1 - std::cos(angle * t)} * (1 / std::sin(angle));
}

/// A bend of 0 … 1 as an angle that leaves some height to the arc.
double angle_of(double bend) { return 0.8 * bend * pi / 2; }

ShapePart ball() {
    return {surface_of({[](double t, double) { return std::sin(pi * t); },
                        [](double t) {
                            return Vector3d{0, -std::cos(pi * t), 0};
                        }}),
            {}};
}

/// A sheet of a thickness whose outline is given by half its width: t leads from the front to the
/// rear, and s around the sheet. `height(t, x)` is that of its middle.
template <typename Along, typename Width, typename Height>
SweptSurface sheet(Along along, Width width, Height height, double thickness) {
    return [=](double t, double s) {
        const double x = width(t) * std::cos(2 * pi * s);
        const double thick = thickness * std::sqrt(std::sin(pi * t)) * std::sin(2 * pi * s);
        return Vector3d{x, height(t, x) + thick, along(t)};
    };
}

ShapePart plate(double bend) {
    const double raised = mix(0.75, 0.25, bend);
    // Round in front: even steps of t² would leave gaps where the outline turns.
    const auto far = [](double t) { return t * (1.4 - 0.4 * t * t) * t * (2 - t); };
    const auto along = [far](double t) { return mix(-0.95, 1.5, far(t)); };
    const auto width = [far](double t) {
        const double u = std::clamp(far(t), 0.0, 1.0);
        return 2.42 * std::sqrt(u) * std::pow(1 - u, 0.75);
    };
    const auto height = [=](double t, double x) {
        const double u = far(t);
        return 0.02 + raised * std::pow(u, 1.3) + 0.18 * std::sin(pi * u) - 0.3 * x * x +
               0.07 * ridge(x, 0.16) * std::sin(pi * u);
    };
    const auto shade = [far](double t, double) { return mix(0.55, 1, rise(0.1, 0.8, far(t))); };
    return {sheet(along, width, height, 0.07), shade};
}

ShapePart thorn(double form, double bend) {
    const double angle = angle_of(bend) * form;
    const double height = mix(0.4, 1, form);
    const auto middle = [=](double t) {
        return arc(angle, mix(std::sin(pi / 2 * t), t, form)) * height;
    };
    const auto radius = [=](double t, double) {
        const double left = 1 - t;
        const double of_thorn = left * mix(0.5, 1, left * left * left * left);
        return mix(std::cos(pi / 2 * t), of_thorn, form);
    };
    const auto shade = [=](double t, double) {
        return mix(1, mix(0.45, 1, rise(0, 0.7, t)), form);
    };
    return {surface_of({radius, middle}), shade};
}

ShapePart blade(int number, int count, double bend) {
    // Fractions of the golden ratio's multiples and of others are spread evenly.
    const auto spread = [number](double ratio) { return std::fmod((number + 0.5) * ratio, 1.0); };
    const double far = 1.05 * std::sqrt((number + 0.5) / count), around = 2.4 * number;
    const Vector3d root{far * std::cos(around), -0.05, far * std::sin(around)};
    const double angle = angle_of(bend) * mix(0.8, 1.1, spread(0.7549));
    const double height = mix(0.75, 1.05, spread(0.6180)), side = mix(-0.35, 0.35, spread(0.5698));
    const auto middle = [=](double t) {
        // Tips come closer to each other than roots.
        const Vector3d drawn_in{-0.35 * root.x * t, 0, -0.25 * root.z * t};
        return root + arc(angle, t) * height + drawn_in + Vector3d{side * t * t, 0, 0};
    };
    const auto radius = [](double t, double) { return 0.16 * std::pow(1 - t, 0.8) * (0.6 + t); };
    const double tone = mix(0.7, 1, spread(0.4302));
    return {surface_of({radius, middle}),
            [tone](double t, double) { return tone * mix(0.35, 1, rise(0, 0.8, t)); }};
}

ShapePart feather(double bend) {
    constexpr double barbs = 16;  ///< On each side.
    const auto along = [](double t) { return mix(-0.35, 2.1, t); };
    const auto width = [](double t) {
        const double vane = rise(0.02, 0.3, t) * std::pow(1 - t, 0.45);
        const double comb = 1 + 0.06 * std::cos(2 * pi * barbs * t) * rise(0.2, 0.4, t);
        return 0.05 * rise(0, 0.05, t) * std::sqrt(1 - t) + 1.05 * vane * comb;
    };
    const double raised = mix(1.3, 0.7, bend), droop = mix(0.5, 0.6, bend);
    const auto height = [=](double t, double x) {
        const double out = std::abs(x);
        // Barbs lead outwards and to the tip.
        const double barb = std::cos(2 * pi * (barbs * t - 3 * out)) * rise(0.05, 0.3, out);
        return 0.05 + raised * t - droop * t * t - 0.25 * out * out - 0.1 * out + 0.016 * barb +
               0.05 * ridge(x, 0.1) * (1 - t);
    };
    const auto shade = [=](double t, double s) {
        const double x = width(t) * std::cos(2 * pi * s), out = std::abs(x);
        const double barb = std::cos(2 * pi * (barbs * t - 3 * out)) * rise(0.05, 0.3, out);
        const double vane = mix(0.5, 0.95, rise(0.1, 0.9, t)) + 0.05 * barb;
        return mix(vane, 1, 0.6 * ridge(x, 0.1));
    };
    return {sheet(along, width, height, 0.03), shade};
}

constexpr std::array<NamedCellShape, 5> all{{
    {"ball", CellShape::Kind::ball},
    {"plate", CellShape::Kind::plate},
    {"thorn", CellShape::Kind::thorn},
    {"hair", CellShape::Kind::hair},
    {"feather", CellShape::Kind::feather},
}};

}  // namespace

std::span<const NamedCellShape> cell_shapes() { return all; }

std::optional<CellShape::Kind> find_cell_shape(std::string_view name) {
    for (const NamedCellShape& each : all) {
        if (each.name == name) return each.kind;
    }
    return std::nullopt;
}

std::vector<ShapePart> parts_of(const CellShape& shape) {
    const double form = std::clamp(shape.form, 0.0, 1.0), bend = std::clamp(shape.bend, 0.0, 1.0);
    switch (shape.kind) {
        case CellShape::Kind::ball: return {ball()};
        case CellShape::Kind::plate: return {plate(bend)};
        case CellShape::Kind::thorn: return {thorn(form, bend)};
        case CellShape::Kind::feather: return {feather(bend)};
        case CellShape::Kind::hair: break;
    }
    constexpr int blades = 14;
    std::vector<ShapePart> parts;
    for (int k = 0; k < blades; ++k) parts.push_back(blade(k, blades, bend));
    return parts;
}

Result<TriangleMesh> mesh_of(std::span<const ShapePart> parts, const SweptDetail& detail) {
    TriangleMesh mesh;
    for (const ShapePart& part : parts) {
        const Result<SweptFacets> facets = facets_for(part.surface, detail);
        if (!facets) return tl::unexpected(facets.error());
        const Result<TriangleMesh> added = swept_shape(part.surface, *facets, part.shade);
        if (!added) return tl::unexpected(added.error());
        append(*added, mesh);
    }
    return mesh;
}

}  // namespace cascade

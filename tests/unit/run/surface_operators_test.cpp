// Operators on a surface, compared with calculus. The surface is the plane itself in bent
// coordinates,
//
//     X = sx + a sin 2π sy,   Y = sy + a sin 2π sx,
//
// stretched and sheared differently in every cell, on which every derivative is known.
#include "started_script.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

namespace cascade {
namespace {

using test::load;
using test::result_of;
using test::start;

using std::numbers::pi;
constexpr double bend = 0.06;

using Vector2 = std::array<double, 2>;
using OfPlace = std::function<double(double sx, double sy)>;
using FluxOfPlace = std::function<Vector2(double sx, double sy)>;

Vector2 place(double sx, double sy) {
    return {sx + bend * std::sin(2 * pi * sy), sy + bend * std::sin(2 * pi * sx)};
}
Vector2 along_sx(double sx, double) { return {1, 2 * pi * bend * std::cos(2 * pi * sx)}; }
Vector2 along_sy(double, double sy) { return {2 * pi * bend * std::cos(2 * pi * sy), 1}; }
double area(double sx, double sy) {
    const Vector2 a = along_sx(sx, sy), b = along_sy(sx, sy);
    return a[0] * b[1] - a[1] * b[0];
}
double dot(Vector2 a, Vector2 b) { return a[0] * b[0] + a[1] * b[1]; }

/// The unit vectors along a row of cells (first) and at a right angle to it (second).
Vector2 first(double sx, double sy) {
    const Vector2 a = along_sx(sx, sy);
    const double size = std::hypot(a[0], a[1]);
    return {a[0] / size, a[1] / size};
}
Vector2 second(double sx, double sy) {
    const Vector2 e = first(sx, sy);
    return {-e[1], e[0]};
}

double wave(double sx, double sy) {
    const Vector2 p = place(sx, sy);
    return std::sin(2 * pi * (p[0] + 2 * p[1]));
}
Vector2 slope(double sx, double sy) {
    const Vector2 p = place(sx, sy);
    const double c = 2 * pi * std::cos(2 * pi * (p[0] + 2 * p[1]));
    return {c, 2 * c};
}

/// The divergence in X and Y of a known flux, computed from the outflow of a small piece.
double divergence(const FluxOfPlace& flux, double sx, double sy) {
    constexpr double h = 1e-5;
    const auto through_x = [&](double u, double v) {
        const Vector2 f = flux(u, v), b = along_sy(u, v);
        return f[0] * b[1] - f[1] * b[0];
    };
    const auto through_y = [&](double u, double v) {
        const Vector2 f = flux(u, v), a = along_sx(u, v);
        return f[1] * a[0] - f[0] * a[1];
    };
    return ((through_x(sx + h, sy) - through_x(sx - h, sy)) +
            (through_y(sx, sy + h) - through_y(sx, sy - h))) /
           (2 * h * area(sx, sy));
}

constexpr const char* bent_plane = "sx + 0.06 * sin(2 * pi * sy), sy + 0.06 * sin(2 * pi * sx), 0";

std::string script_on_bent_plane(const std::string& operation, int side,
                                 const std::string& domain) {
    return fmt::format(
        "domain {{ grid: {}, {}; surface: {}; {} }}\n"
        "system s {{\n  u: 0\n  u' = 0 * u\n"
        "  f: sin(2*pi*(sx + 0.06*sin(2*pi*sy) + 2*sy + 0.12*sin(2*pi*sx)))\n"
        "  k: 2 + cos(2 * pi * sx)\n  r: {}\n}}\nstage only: s {{ iterations: 0 }}\n",
        side, side, bent_plane, domain, operation);
}

double largest_error(const std::string& operation, int side, const OfPlace& exact) {
    Script script = load(script_on_bent_plane(operation, side, "unit: 1"));
    const auto simulation = start(script);
    if (!simulation) return 1e300;
    const Field& found = result_of(*simulation, "r");
    double largest = 0;
    for (int j = 0; j < side; ++j) {
        for (int i = 0; i < side; ++i) {
            const double expected = exact((i + 0.5) / side, (j + 0.5) / side);
            largest = std::max(largest, std::abs(static_cast<double>(found.at(i, j)) - expected));
        }
    }
    return largest;
}

struct SurfaceOperatorOrder {
    std::string operation;
    double order;
    OfPlace exact;
};

TEST(SurfaceOperators, MeasureOnTheSurface) {
    const OfPlace k = [](double sx, double) { return 2 + std::cos(2 * pi * sx); };
    const double cosine = std::cos(0.6), sine = std::sin(0.6);
    /// A v, for a tensor A that is turned away from the direction along a row.
    const auto turned = [=](double a1, Vector2 v, double sx, double sy) {
        const Vector2 e = first(sx, sy), g = second(sx, sy);
        const double x = dot(v, e), y = dot(v, g);
        const double along = a1 * a1 * (cosine * x + sine * y);
        const double across = 0.25 * (cosine * y - sine * x);
        const double p = cosine * along - sine * across, q = sine * along + cosine * across;
        return Vector2{p * e[0] + q * g[0], p * e[1] + q * g[1]};
    };
    const auto scaled = [](Vector2 v, double by) { return Vector2{v[0] * by, v[1] * by}; };
    const auto of_flux = [](const FluxOfPlace& flux) {
        return [=](double sx, double sy) { return divergence(flux, sx, sy); };
    };
    const OfPlace laplacian = [](double sx, double sy) { return -20 * pi * pi * wave(sx, sy); };
    const std::vector<SurfaceOperatorOrder> cases{
        {"lap(f)", 2, laplacian},
        {"lap(3 * f)", 2, [=](double sx, double sy) { return 3 * laplacian(sx, sy); }},
        {"div(grad(f))", 2, laplacian},
        {"dx(f)", 2, [](double sx, double sy) { return dot(first(sx, sy), slope(sx, sy)); }},
        {"dy(f)", 2, [](double sx, double sy) { return dot(second(sx, sy), slope(sx, sy)); }},
        {"grad2(f)", 2, [](double sx, double sy) { return dot(slope(sx, sy), slope(sx, sy)); }},
        {"advect(0.7, -0.4, f)", 1,
         [](double sx, double sy) {
             return 0.7 * dot(first(sx, sy), slope(sx, sy)) -
                    0.4 * dot(second(sx, sy), slope(sx, sy));
         }},
        {"div(k * grad(f))", 2,
         of_flux([=](double sx, double sy) { return scaled(slope(sx, sy), k(sx, sy)); })},
        {"div(vector(k * f, f) / 2)", 2, of_flux([=](double sx, double sy) {
             const Vector2 e = first(sx, sy), g = second(sx, sy);
             const double f = wave(sx, sy) / 2;
             return Vector2{f * (k(sx, sy) * e[0] + g[0]), f * (k(sx, sy) * e[1] + g[1])};
         })},
        {"div(tensor(2, 0.5, 0.6) * grad(f))", 2,
         of_flux([=](double sx, double sy) { return turned(2, slope(sx, sy), sx, sy); })},
        {"div(tensor(k, 0.5, 0.6) * (grad(f) - vector(f, 0) * 3))", 2,
         of_flux([=](double sx, double sy) {
             const Vector2 s = slope(sx, sy), e = first(sx, sy);
             const double f = 3 * wave(sx, sy);
             return turned(k(sx, sy), {s[0] - f * e[0], s[1] - f * e[1]}, sx, sy);
         })},
    };
    for (const SurfaceOperatorOrder& each : cases) {
        const double coarse = largest_error(each.operation, 32, each.exact);
        const double fine = largest_error(each.operation, 64, each.exact);
        EXPECT_NEAR(std::log2(coarse / fine), each.order, 0.35)
            << each.operation << ": " << coarse << ", " << fine;
    }
}

TEST(SurfaceOperators, WithoutAMetricCellsAreSquares) {
    const auto on_surface = [](const std::string& domain) {
        Script script = load(script_on_bent_plane("lap(f)", 32, domain));
        const auto simulation = start(script);
        return result_of(*simulation, "r").clone();
    };
    const Field with = on_surface("metric: 1");
    const Field without = on_surface("metric: 0");
    Script plane = load(
        "domain { grid: 32, 32 }\nsystem s {\n  u: 0\n  u' = 0 * u\n"
        "  f: sin(2*pi*(sx + 0.06*sin(2*pi*sy) + 2*sy + 0.12*sin(2*pi*sx)))\n"
        "  r: lap(f)\n}\nstage only: s { iterations: 0 }\n");
    const auto simulation = start(plane);
    const Field& flat = result_of(*simulation, "r");
    double apart = 0;
    for (int j = 0; j < 32; ++j) {
        for (int i = 0; i < 32; ++i) {
            EXPECT_EQ(without.at(i, j), flat.at(i, j));
            apart = std::max(apart, std::abs(static_cast<double>(with.at(i, j) - flat.at(i, j))));
        }
    }
    EXPECT_GT(apart, 0.05);
}

TEST(SurfaceOperators, NothingIsLost) {
    // The sum of s · div is 0 up to rounding, also between sides that mirror.
    for (const char* boundary : {"periodic", "noflux"}) {
        Script script =
            load(script_on_bent_plane("div(tensor(k, 0.5, 0.6) * grad(f) + vector(f, 1))", 48,
                                      fmt::format("boundary: {}", boundary)));
        const auto simulation = start(script);
        const Field& flow = result_of(*simulation, "r");
        double sum = 0, size = 0;
        for (int j = 0; j < 48; ++j) {
            for (int i = 0; i < 48; ++i) {
                // The cells have the mean area 1.
                const double s = area((i + 0.5) / 48, (j + 0.5) / 48);
                sum += s * static_cast<double>(flow.at(i, j));
                size += std::abs(s * static_cast<double>(flow.at(i, j)));
            }
        }
        EXPECT_LT(std::abs(sum), 1e-5 * size) << boundary;
    }
}

TEST(SurfaceOperators, AggregatesCountAreas) {
    Script script = load(script_on_bent_plane("0 * f + sum(0 * f + 1 over domain)", 40, "unit: 1"));
    const auto simulation = start(script);
    EXPECT_NEAR(result_of(*simulation, "r").at(3, 3), 1, 1e-5);
    Script mean =
        load(script_on_bent_plane("0 * f + mean(if(sx < 0.5, 1, 0) * (1 + 0 * f) over domain)", 40,
                                  "unit: 1"));
    const auto second_run = start(mean);
    EXPECT_NEAR(result_of(*second_run, "r").at(3, 3), 0.5, 1e-5);
}

TEST(SurfaceOperators, SingularSurfacesAreRefusedBeforeTheFirstStep) {
    Script script = load(
        "domain { grid: 8, 4; surface: sx * sy, sx * sy, 2 * sx * sy }\n"
        "system_name: turing_spots\n");
    ASSERT_TRUE(script.program) << script.messages(false);
    const auto simulation = Simulation::create(script, {"interp", 0, 1});
    ASSERT_FALSE(simulation);
    EXPECT_THAT(simulation.error().message,
                ::testing::StartsWith("the surface has no area at sx = 0.0625"));
}

}  // namespace
}  // namespace cascade

// Surfaces for tests of files: shapes with texture coordinates and values at their points.
#pragma once

#include "export/channels.h"
#include "mesh/make_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace cascade::test {

inline SurfaceMesh mesh_of(PolygonSoup soup) {
    Result<MadeMesh> made = make_mesh(std::move(soup));
    EXPECT_TRUE(made.has_value()) << made.error().message;
    return std::move(made->mesh);
}

/// The square 0 … 1² at z = 0, cut into n × n squares. Texture coordinates are x and y.
inline SurfaceMesh flat_square(std::uint32_t n) {
    PolygonSoup soup;
    const auto along = [&](std::uint32_t k) { return static_cast<double>(k) / n; };
    for (std::uint32_t j = 0; j <= n; ++j) {
        for (std::uint32_t i = 0; i <= n; ++i) soup.points.push_back({along(i), along(j), 0});
    }
    for (std::uint32_t j = 0; j < n; ++j) {
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t corner = j * (n + 1) + i;
            for (const std::uint32_t point : {corner, corner + 1, corner + n + 2, corner + n + 1}) {
                soup.corners.push_back(point);
                soup.texture.push_back({static_cast<float>(soup.points[point].x),
                                        static_cast<float>(soup.points[point].y)});
            }
            soup.ends.push_back(soup.corners.size());
        }
    }
    return mesh_of(std::move(soup));
}

/// The unit sphere as `rows` bands of 2 · rows quadrilaterals. Texture coordinates are longitude
/// and latitude, with a seam at longitude 0.
inline SurfaceMesh sphere_with_texture(std::uint32_t rows) {
    PolygonSoup soup;
    const std::uint32_t columns = 2 * rows;
    const auto place = [&](std::uint32_t i, std::uint32_t j) {
        const double longitude = 2 * std::numbers::pi * (i % columns) / columns;
        const double latitude = std::numbers::pi * (static_cast<double>(j) / rows - 0.5);
        const bool is_pole = j == 0 || j == rows;
        const double ring = is_pole ? 0 : std::cos(latitude);
        return Vector3d{ring * std::cos(longitude), ring * std::sin(longitude),
                        is_pole ? (j == 0 ? -1.0 : 1.0) : std::sin(latitude)};
    };
    for (std::uint32_t j = 0; j < rows; ++j) {
        for (std::uint32_t i = 0; i < columns; ++i) {
            for (const auto& [a, b] : {std::pair{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}) {
                soup.corners.push_back(static_cast<std::uint32_t>(soup.points.size()));
                soup.points.push_back(place(a, b));
                soup.texture.push_back({static_cast<float>(a) / static_cast<float>(columns),
                                        static_cast<float>(b) / static_cast<float>(rows)});
            }
            soup.ends.push_back(soup.corners.size());
        }
    }
    return mesh_of(std::move(soup));
}

/// A channel with the coordinate x of each point.
inline Channel x_channel(const SurfaceMesh& mesh) {
    Channel channel{"u", {}};
    for (const Vector3d& p : mesh.points) channel.values.push_back(static_cast<float>(p.x));
    return channel;
}

/// Colours whose red grows with x, green with y and blue with z, each over −1 … 1.
inline std::vector<Colour> place_colours(const SurfaceMesh& mesh) {
    std::vector<Colour> colours;
    for (const Vector3d& p : mesh.points) {
        colours.push_back({static_cast<float>(0.5 + 0.5 * p.x), static_cast<float>(0.5 + 0.5 * p.y),
                           static_cast<float>(0.5 + 0.5 * p.z)});
    }
    return colours;
}

}  // namespace cascade::test

// Pictures of surfaces with known looks.
#include "render/draw.h"

#include "picture/srgb.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace cascade {
namespace {

/// Positions on a grid of the unit square, mapped by `place`.
template <typename Place>
TriangleMesh sheet(std::uint32_t columns, std::uint32_t rows, Place place) {
    TriangleMesh mesh;
    for (std::uint32_t j = 0; j <= rows; ++j) {
        for (std::uint32_t i = 0; i <= columns; ++i) {
            mesh.positions.push_back(place(static_cast<float>(i) / static_cast<float>(columns),
                                           static_cast<float>(j) / static_cast<float>(rows)));
        }
    }
    for (std::uint32_t j = 0; j < rows; ++j) {
        for (std::uint32_t i = 0; i < columns; ++i) {
            const std::uint32_t corner = j * (columns + 1) + i;
            mesh.triangles.push_back({corner, corner + 1, corner + columns + 2});
            mesh.triangles.push_back({corner, corner + columns + 2, corner + columns + 1});
        }
    }
    smooth_normals(mesh);
    return mesh;
}

TriangleMesh sphere(float radius) {
    return sheet(96, 48, [radius](float u, float v) {
        const float around = 2 * std::numbers::pi_v<float> * u;
        const float down = std::numbers::pi_v<float> * v;
        return Vector3{std::sin(down) * std::cos(around), std::sin(down) * std::sin(around),
                       std::cos(down)} *
               radius;
    });
}

Image picture_of(const TriangleMesh& mesh, const DrawOptions& options, const SurfaceColour& colour,
                 int threads = 1) {
    Team team(threads);
    return draw(mesh, colour, options, team);
}

Colour red(const Hit&) { return {0.8F, 0, 0}; }

bool is_red(const Colour& pixel) { return pixel[0] - pixel[1] > 0.1F; }

DrawOptions small_picture() {
    DrawOptions options;
    options.width = 160;
    options.height = 120;
    options.ground = false;
    return options;
}

TEST(Draw, ASphereIsADiscThatFillsThePicture) {
    for (const float radius : {0.01F, 1.0F, 4000.0F}) {
        const Image image = picture_of(sphere(radius), small_picture(), red);
        std::int64_t count = 0, left = 160, right = 0, top = 120, bottom = 0;
        for (std::int64_t y = 0; y < 120; ++y) {
            for (std::int64_t x = 0; x < 160; ++x) {
                if (!is_red(image.at(x, y))) continue;
                ++count;
                left = std::min(left, x);
                right = std::max(right, x);
                top = std::min(top, y);
                bottom = std::max(bottom, y);
            }
        }
        // The margin leaves 1/1.12 of the height.
        const double diameter = 120 / 1.12;
        EXPECT_NEAR(static_cast<double>(bottom - top + 1), diameter, 3) << radius;
        EXPECT_NEAR(static_cast<double>(right - left + 1), diameter, 3) << radius;
        EXPECT_NEAR(static_cast<double>(count), std::numbers::pi / 4 * diameter * diameter,
                    0.04 * diameter * diameter);
        EXPECT_NEAR(static_cast<double>(left + right) / 2, 79.5, 1.5);
    }
}

TEST(Draw, TheSunStandsBehindTheLeftShoulder) {
    const Image image = picture_of(sphere(1), small_picture(), red);
    EXPECT_GT(image.at(62, 40)[0], image.at(98, 80)[0] + 0.1F);
}

TEST(Draw, ColoursAreThoseOfTheTriangleThatIsSeen) {
    // A wall whose left half, seen from the front, is blue.
    const TriangleMesh wall = sheet(2, 1, [](float u, float v) {
        return Vector3{u - 0.5F, 0, 0.75F * (0.5F - v)};
    });
    DrawOptions options = small_picture();
    options.view.azimuth = 0;
    options.view.elevation = 0;
    const Image image = picture_of(wall, options, [](const Hit& hit) {
        return hit.triangle < 2 ? Colour{0, 0, 0.8F} : Colour{0.8F, 0, 0};
    });
    EXPECT_GT(image.at(50, 60)[2], 2 * image.at(50, 60)[0]);
    EXPECT_GT(image.at(110, 60)[0], 2 * image.at(110, 60)[2]);
    EXPECT_GT(image.at(2, 2)[1], 0.999F);
}

TEST(Draw, BarycentricPlacesInterpolate) {
    // The colour is the height along the wall, which increases linearly from left to right.
    const TriangleMesh wall = sheet(1, 1, [](float u, float v) {
        return Vector3{u, 0, 0.75F * (1 - v)};
    });
    DrawOptions options = small_picture();
    options.view = {0, 0, {0, 0, 1}};
    const auto across = [&](const Hit& hit) {
        const auto& [a, b, c] = wall.triangles[hit.triangle];
        const float x = wall.positions[a].x * (1 - hit.u - hit.v) + wall.positions[b].x * hit.u +
                        wall.positions[c].x * hit.v;
        return x < 0.25F ? Colour{0, 0, 0.8F} : Colour{0.8F, 0, 0};
    };
    const Image image = picture_of(wall, options, across);
    const double width = 160 / 1.12;
    const double edge = 80 - width / 2 + width / 4;
    const auto before = static_cast<std::int64_t>(edge - 4);
    EXPECT_GT(image.at(before, 60)[2], 0.2F);
    EXPECT_LT(image.at(before, 60)[0], 0.2F);
    EXPECT_GT(image.at(before + 8, 60)[0], 0.2F);
}

TEST(Draw, TheGroundHasAShadow) {
    DrawOptions options = small_picture();
    options.ground = true;
    const Image image = picture_of(sphere(1), options, red);
    std::int64_t grey = 0;
    for (const Colour& pixel : image.pixels) {
        if (pixel[0] < 0.95F && std::abs(pixel[0] - pixel[1]) < 0.01F) ++grey;
    }
    EXPECT_GT(grey, 200);
    EXPECT_GT(image.at(2, 2)[0], 0.98F);
}

TEST(Draw, ShadowsAreNotGrainy) {
    // On open surfaces, neighbouring pixels show close points and have similar light.
    DrawOptions options = small_picture();
    options.ground = true;
    options.width = 640;
    options.height = 480;
    const Image image = picture_of(sphere(1), options, red);
    double squares = 0, count = 0;
    for (std::int64_t y = 1; y + 1 < options.height; ++y) {
        for (std::int64_t x = 1; x + 1 < options.width; ++x) {
            const auto is_ground = [&](std::int64_t i, std::int64_t j) {
                const Colour& pixel = image.at(i, j);
                return pixel[0] < 0.95F && std::abs(pixel[0] - pixel[1]) < 0.01F;
            };
            if (!is_ground(x, y) || !is_ground(x - 1, y) || !is_ground(x + 1, y)) continue;
            const double bend = static_cast<double>(image.at(x - 1, y)[0] + image.at(x + 1, y)[0] -
                                                    2 * image.at(x, y)[0]);
            squares += bend * bend;
            ++count;
        }
    }
    ASSERT_GT(count, 200);
    RecordProperty("grain", std::to_string(std::sqrt(squares / count)));
    EXPECT_LT(std::sqrt(squares / count), 0.0075);
}

/// The mean of squares of side × side pixels, in linear light.
Image averaged(const Image& image, std::int64_t side) {
    Image small(image.width / side, image.height / side);
    std::fill(small.pixels.begin(), small.pixels.end(), Colour{0, 0, 0});
    for (std::int64_t y = 0; y < small.height * side; ++y) {
        for (std::int64_t x = 0; x < small.width * side; ++x) {
            for (std::size_t c = 0; c < 3; ++c) {
                small.at(x / side, y / side)[c] +=
                    light_of(image.at(x, y)[c]) / static_cast<float>(side * side);
            }
        }
    }
    for (Colour& pixel : small.pixels) pixel = stored_of(pixel);
    return small;
}

TEST(Draw, BetterQualityIsNearerToTheTruth) {
    // A ball with stripes. No light is hidden, so only rays through pixels matter.
    const TriangleMesh mesh = sphere(1);
    const auto striped = [&](const Hit& hit) -> Colour {
        const auto& [a, b, c] = mesh.triangles[hit.triangle];
        const float z = mesh.positions[a].z * (1 - hit.u - hit.v) + mesh.positions[b].z * hit.u +
                        mesh.positions[c].z * hit.v;
        return std::sin(40 * z) > 0 ? Colour{0.9F, 0.8F, 0.6F} : Colour{0.1F, 0.1F, 0.2F};
    };
    DrawOptions options = small_picture();
    const auto drawn = [&](Quality quality, std::int64_t scale) {
        DrawOptions larger = options;
        larger.quality = quality;
        larger.width *= scale;
        larger.height *= scale;
        return picture_of(mesh, larger, striped, 2);
    };
    const Image truth = averaged(drawn(Quality::fine, 6), 6);
    const auto error_of = [&](Quality quality) {
        const Image image = drawn(quality, 1);
        double squares = 0;
        for (std::size_t k = 0; k < image.pixels.size(); ++k) {
            for (std::size_t c = 0; c < 3; ++c) {
                const double off = static_cast<double>(image.pixels[k][c] - truth.pixels[k][c]);
                squares += off * off;
            }
        }
        return std::sqrt(squares / static_cast<double>(3 * image.pixels.size()));
    };
    const double draft = error_of(Quality::draft), normal = error_of(Quality::normal),
                 fine = error_of(Quality::fine);
    RecordProperty("errors", std::to_string(draft) + " " + std::to_string(normal) + " " +
                                 std::to_string(fine));
    EXPECT_LT(fine, 0.8 * normal);
    EXPECT_LT(normal, 0.9 * draft);
    EXPECT_LT(normal, 0.02);
}

TEST(Draw, ReportsHowFarItIs) {
    DrawOptions options = small_picture();
    options.width = 500;
    std::vector<double> parts;
    options.report = [&](double part) {
        parts.push_back(part);
        return true;
    };
    picture_of(sphere(1), options, red);
    EXPECT_GT(parts.size(), 4u);
    EXPECT_TRUE(std::is_sorted(parts.begin(), parts.end()));
    EXPECT_EQ(parts.back(), 1.0);
}

TEST(Draw, StopsWhenItIsTold) {
    DrawOptions options = small_picture();
    options.width = 1000;
    options.background = Colour{0, 0, 1};
    int reports = 0;
    options.report = [&](double) { return ++reports < 2; };
    const Image image = picture_of(sphere(1), options, red);
    EXPECT_EQ(reports, 2);
    EXPECT_EQ(image.pixels.front(), (Colour{0, 0, 1}));
    EXPECT_EQ(image.pixels.back(), pure_white);
}

TEST(Draw, ThreadsDoNotMatter) {
    const TriangleMesh mesh = sphere(1);
    DrawOptions options = small_picture();
    options.ground = true;
    const Image one = picture_of(mesh, options, red, 1);
    const Image three = picture_of(mesh, options, red, 3);
    EXPECT_TRUE(one.pixels == three.pixels);
}

TEST(Draw, ABackgroundHasAColour) {
    DrawOptions options = small_picture();
    const Colour blue{32.0F / 255, 64.0F / 255, 96.0F / 255};
    options.background = blue;
    const Image alone = picture_of(sphere(1), options, red);
    EXPECT_TRUE(alone.alpha.empty());
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(alone.at(0, 0)[c], blue[c], 1e-6F);
    options.ground = true;
    const Image shaded = picture_of(sphere(1), options, red);
    float darkest = 1;
    for (const Colour& pixel : shaded.pixels) {
        if (!is_red(pixel)) darkest = std::min(darkest, pixel[2]);
    }
    EXPECT_LT(darkest, 0.8F * blue[2]) << "a shadow darkens it";
    EXPECT_GT(darkest, 0.5F * blue[2]);
}

TEST(Draw, WithoutABackgroundEdgesKeepTheColourOfTheSurface) {
    DrawOptions options = small_picture();
    options.background = std::nullopt;
    for (const Quality quality : {Quality::draft, Quality::normal, Quality::fine}) {
        options.quality = quality;
        const Image image = picture_of(sphere(1), options, red);
        ASSERT_EQ(image.alpha.size(), image.pixels.size());
        float area = 0;
        std::int64_t partial = 0;
        for (std::int64_t y = 0; y < 120; ++y) {
            for (std::int64_t x = 0; x < 160; ++x) {
                const float opacity = image.opacity(x, y);
                area += opacity;
                if (opacity == 0) continue;
                if (opacity < 1) ++partial;
                // The sphere has white highlights, so there is some green, but not much.
                EXPECT_LT(image.at(x, y)[1], 0.35F) << x << ", " << y;
            }
        }
        EXPECT_TRUE(is_transparent(image.at(0, 0)));
        EXPECT_EQ(image.opacity(80, 60), 1.0F);
        EXPECT_GT(partial, 100) << "the outline";
        // The disc's diameter is 120 pixels without the margin of 12 %.
        const float radius = 60 / 1.12F;
        EXPECT_NEAR(area, std::numbers::pi_v<float> * radius * radius, 0.03F * area);
    }
}

TEST(Draw, WithoutABackgroundTheShadowIsBlackAndOverWhiteTheSame) {
    DrawOptions options = small_picture();
    options.ground = true;
    const Image on_white = picture_of(sphere(1), options, red);
    options.background = std::nullopt;
    const Image image = picture_of(sphere(1), options, red);
    std::int64_t in_shadow = 0;
    for (std::int64_t y = 0; y < 120; ++y) {
        for (std::int64_t x = 0; x < 160; ++x) {
            // Only pixels without the surface are compared, since edges are mixed in sRGB in one
            // picture and in linear light in the other.
            if (image.at(x, y)[0] > 0 && !is_transparent(image.at(x, y))) continue;
            const Colour over = image.over(pure_white, x, y);
            for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(over[c], on_white.at(x, y)[c], 1e-3F);
            if (image.opacity(x, y) < 0.05F) continue;
            ++in_shadow;
            EXPECT_LT(image.opacity(x, y), 0.5F);
        }
    }
    EXPECT_GT(in_shadow, 500);
}

/// A wall that fills most of the picture, seen from the front, with equal walls behind it.
TriangleMesh walls(int count) {
    TriangleMesh all;
    for (int wall = 0; wall < count; ++wall) {
        const float depth = 0.02F * static_cast<float>(wall);
        const TriangleMesh one = sheet(1, 1, [&](float u, float v) {
            return Vector3{u - 0.5F, depth, 0.75F * (0.5F - v)};
        });
        const auto before = static_cast<std::uint32_t>(all.positions.size());
        all.positions.insert(all.positions.end(), one.positions.begin(), one.positions.end());
        for (const auto& [a, b, c] : one.triangles) {
            all.triangles.push_back({before + a, before + b, before + c});
        }
    }
    smooth_normals(all);
    return all;
}

TEST(Draw, WhatIsBehindShowsThrough) {
    DrawOptions options = small_picture();
    options.view = {0, 0, {0, 0, 1}};
    options.background = std::nullopt;
    options.opacity = [](const Hit&) { return 0.5F; };
    for (int count = 1; count <= 3; ++count) {
        const Image image = picture_of(walls(count), options, red);
        EXPECT_NEAR(image.opacity(80, 60), 1 - std::pow(0.5F, static_cast<float>(count)), 1e-4F);
        EXPECT_TRUE(is_red(image.at(80, 60)));
    }
    // Opacities from 1 to 0. A pixel's opacity is the covered fraction.
    options.opacity = [](const Hit& hit) { return hit.triangle == 0 ? hit.u + hit.v : 1 - hit.u; };
    const Image slope = picture_of(walls(1), options, red, 2);
    EXPECT_TRUE(picture_of(walls(1), options, red, 1).alpha == slope.alpha);
    EXPECT_GT(*std::max_element(slope.alpha.begin(), slope.alpha.end()), 0.95F);
}

TEST(Draw, HolesAreSeenThrough) {
    DrawOptions options = small_picture();
    options.view = {0, 0, {0, 0, 1}};
    const auto colour = [](const Hit& hit) {
        return hit.triangle < 2 ? Colour{0.8F, 0, 0} : Colour{0, 0, 0.8F};
    };
    // The front wall is opaque above its diagonal only.
    options.opacity = [](const Hit& hit) { return hit.triangle == 1 ? 0.0F : 1.0F; };
    Team team(1);
    const Image image = draw(walls(2), colour, options, team);
    std::int64_t reds = 0, blues = 0;
    for (const Colour& pixel : image.pixels) {
        if (pixel[0] > 0.3F && pixel[2] < 0.3F) ++reds;
        if (pixel[2] > 0.3F && pixel[0] < 0.3F) ++blues;
    }
    EXPECT_GT(reds, 3000);
    EXPECT_NEAR(static_cast<double>(blues), static_cast<double>(reds),
                0.1 * static_cast<double>(reds));
    options.opacity = [](const Hit&) { return 0.0F; };
    options.ground = true;
    for (const Colour& pixel : picture_of(walls(2), options, red).pixels) {
        ASSERT_GT(pixel[1], 0.999F) << "neither a wall nor its shadow";
    }
}

TEST(Draw, ShadowsOfTranslucentSurfacesAreLighter) {
    DrawOptions options = small_picture();
    options.ground = true;
    options.quality = Quality::fine;
    // The light of the ground that the shadow takes away, over all pixels without the sphere.
    const auto missing = [&](float opacity) {
        options.opacity = [=](const Hit&) { return opacity; };
        const Image image = picture_of(sphere(1), options, [](const Hit&) { return pure_white; });
        double sum = 0;
        for (std::int64_t y = 0; y < 120; ++y) {
            for (std::int64_t x = 0; x < 160; ++x) {
                const double from_middle =
                    std::hypot(static_cast<double>(x) - 80, static_cast<double>(y) - 60);
                if (from_middle > 60) sum += 1 - static_cast<double>(light_of(image.at(x, y)[0]));
            }
        }
        return sum;
    };
    const double opaque = missing(1);
    // A ray crosses the sphere twice, so a quarter of the light passes if each crossing takes half.
    EXPECT_NEAR(missing(0.5F) / opaque, 0.75, 0.04);
    EXPECT_NEAR(missing(0.1F) / opaque, 0.19, 0.04);
}

TEST(Draw, ATiltTurnsTheLightAndFlipsOnTheBack) {
    // A wall seen from the front, with the sun at the upper left of the viewer.
    const auto place = [](float u, float v) { return Vector3{u - 0.5F, 0, 0.75F * (0.5F - v)}; };
    const auto brightness = [&](float azimuth, Vector3 tilt) {
        const TriangleMesh wall = sheet(1, 1, place);
        DrawOptions options = small_picture();
        options.view = {azimuth, 0, {0, 0, 1}};
        Team team(1);
        const Image image = draw(
            RayCaster(wall),
            [&](const Sight&) {
                return Look{{0.5F, 0.5F, 0.5F}, tilt};
            },
            options, team);
        float sum = 0;
        for (std::int64_t y = 50; y < 70; ++y) {
            for (std::int64_t x = 70; x < 90; ++x) sum += image.at(x, y)[0];
        }
        return sum / 400;
    };
    const float plain = brightness(0, {});
    // The outside of the wall faces y. Seen from outside, the sun is on the side of x, so a tilt of
    // the normal to x makes the wall brighter. Seen from the back, the sun is on the side of −x,
    // and this tilt turns the normal of the back to −x.
    for (const float azimuth : {180.0F, 0.0F}) {
        EXPECT_GT(brightness(azimuth, {0.5F, 0, 0}), plain + 0.02F);
        EXPECT_LT(brightness(azimuth, {-0.5F, 0, 0}), plain - 0.05F);
    }
}

TEST(Draw, ASightKnowsHowWideASampleIs) {
    const TriangleMesh wall = sheet(1, 1, [](float u, float v) {
        return Vector3{u - 0.5F, 0, 0.75F * (0.5F - v)};
    });
    DrawOptions options = small_picture();
    options.view = {0, 0, {0, 0, 1}};
    // A pixel where the picture is uniform takes one ray (two by two with the best quality), and a
    // pixel at the wall's edges takes more. `first` and `last` are the numbers of rays along its
    // side.
    for (const auto& [quality, first, last] :
         {std::tuple{Quality::draft, 1, 2}, {Quality::normal, 1, 4}, {Quality::fine, 2, 8}}) {
        options.quality = quality;
        float least = 1, most = 0;
        Team team(1);
        draw(
            RayCaster(wall),
            [&](const Sight& sight) {
                least = std::min(least, sight.width);
                most = std::max(most, sight.width);
                return Look{};
            },
            options, team);
        // The wall is 160 / 1.12 pixels wide.
        const float pixel = 1.12F / 160;
        EXPECT_NEAR(least, pixel / static_cast<float>(last), 1e-4F);
        EXPECT_NEAR(most, pixel / static_cast<float>(first), pixel / 10);
    }
}

TEST(RayCaster, FindsTheNearestTriangle) {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 2}, {4, 0, 2}, {0, 4, 2}};
    mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
    smooth_normals(mesh);
    const RayCaster caster(mesh);
    const auto hit = caster.nearest({{1, 2, 10}, {0, 0, -1}});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->triangle, 1u);
    EXPECT_FLOAT_EQ(hit->distance, 8);
    EXPECT_FLOAT_EQ(hit->u, 0.25F);
    EXPECT_FLOAT_EQ(hit->v, 0.5F);
    EXPECT_FALSE(caster.nearest({{5, 5, 10}, {0, 0, -1}}));
    EXPECT_TRUE(caster.is_blocked({{1, 2, 10}, {0, 0, -1}}, 9));
    EXPECT_FALSE(caster.is_blocked({{1, 2, 10}, {0, 0, -1}}, 7));
}

/// The bounding box of a sheet has no thickness, and rays along axes have components of 0 and −0.
TEST(RayCaster, MissesNothingOfASheet) {
    const auto place = [](float x, float y) { return Vector3{x, 0, y}; };
    const TriangleMesh mesh = sheet(3, 3, place);
    const RayCaster caster(mesh);
    for (int k = 1; k < 60; ++k) {
        for (const float side : {-1.0F, 1.0F}) {
            const float x = static_cast<float>(k) / 60, zero = 0 * side;
            const Vector3 straight = {zero, -side, zero};
            EXPECT_TRUE(caster.nearest({{x, 5 * side, 1 - x}, straight}));
            EXPECT_TRUE(caster.is_blocked({{x, 5 * side, 1 - x}, straight}, 5.001F));
            EXPECT_FALSE(caster.is_blocked({{x, 5 * side, 1 - x}, straight}, 4.999F));
            EXPECT_FALSE(caster.is_blocked({{x, 5 * side, 1 - x}, -straight}, INFINITY));
            const Vector3 from = {-3, 4 * side, 7}, there = {x, 0, 1 - x};
            EXPECT_TRUE(caster.nearest({from, unit(there - from)}));
        }
    }
}

TEST(Camera, EveryAxisCanPointUp) {
    const TriangleMesh mesh = sphere(2);
    for (const Vector3 up : {Vector3{1, 0, 0}, Vector3{0, 1, 0}, Vector3{0, 0, 1}}) {
        const Camera camera(mesh, {30, 25, up}, 100, 100);
        const Ray middle = camera.ray(50, 50);
        // The middle of the picture is the middle of the sphere.
        const Vector3 closest =
            middle.origin + middle.direction * -dot(middle.origin, middle.direction);
        EXPECT_LT(length(closest), 0.05F);
        EXPECT_NEAR(dot(camera.up(), up), std::cos(25 * std::numbers::pi / 180), 1e-5);
        EXPECT_NEAR(dot(camera.right(), up), 0, 1e-6);
    }
}

TEST(Camera, EveryFieldOfViewShowsTheWhole) {
    const TriangleMesh mesh = sphere(2);
    for (const auto& [width, height] : {std::pair{100, 100}, {320, 90}, {60, 200}}) {
        for (const float half_field : {0.02F, 0.22F, 1.7F}) {
            View view;
            view.half_field = half_field;
            const Camera camera(mesh, view, width, height);
            float most = 0;
            for (const Vector3& p : mesh.positions) {
                const Vector3 way = p - camera.eye();
                const float depth = -dot(way, camera.backward());
                ASSERT_GT(depth, 0);
                for (const Vector3& axis : {camera.right(), camera.up()}) {
                    most = std::max(most, std::abs(dot(way, axis)) / depth / camera.pixel());
                }
            }
            // The shorter side determines the size, since a ball is round.
            const auto smaller = static_cast<float>(std::min(width, height));
            EXPECT_NEAR(most, smaller / 2 / 1.12F, 0.03F * smaller) << width << ' ' << half_field;
        }
    }
}

TEST(Camera, AWholeTurnHasOneFrame) {
    // A long body away from the axis through the origin.
    TriangleMesh mesh = sphere(1);
    for (Vector3& p : mesh.positions) p = {3 * p.x + 7, p.y - 2, 0.5F * p.z};
    for (const float elevation : {-40.0F, 0.0F, 25.0F, 80.0F}) {
        const auto camera_at = [&](float azimuth) {
            View view{azimuth, elevation, {0, 0, 1}};
            view.is_turning = true;
            return Camera(mesh, view, 200, 100);
        };
        const Vector3 middle = bounds(mesh).centre();
        const float distance = length(camera_at(0).eye() - middle);
        float low = 1e9F, high = -1e9F;
        for (int k = 0; k < 36; ++k) {
            const auto azimuth = static_cast<float>(10 * k);
            const Camera camera = camera_at(azimuth);
            // The eye moves on a circle around the axis.
            EXPECT_NEAR(length(camera.eye() - middle), distance, 1e-4F * distance);
            EXPECT_NEAR(camera.eye().z, camera_at(0).eye().z, 1e-4F * distance);
            // The axis is in the middle of the picture.
            EXPECT_NEAR(dot(camera.eye() - middle, camera.right()), 0, 1e-4F * distance);
            for (const Vector3& p : mesh.positions) {
                const Vector3 way = p - camera.eye();
                const float depth = -dot(way, camera.backward());
                ASSERT_GT(depth, 0);
                const float x = dot(way, camera.right()) / depth / camera.pixel();
                const float y = dot(way, camera.up()) / depth / camera.pixel();
                EXPECT_LT(std::abs(x), 100 / 1.12F + 0.1F);
                low = std::min(low, y);
                high = std::max(high, y);
            }
        }
        EXPECT_GT(low, -50 / 1.12F - 0.1F);
        EXPECT_LT(high, 50 / 1.12F + 0.1F);
        // The eye is not farther away than necessary.
        if (elevation > 60) {
            EXPECT_GT(high, 44 / 1.12F);
        }
    }
}

}  // namespace
}  // namespace cascade

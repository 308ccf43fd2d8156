// Meshes of shapes that formulas describe, compared with the intended shapes.
#include "run/pictures/shape_meshes.h"

#include "lang/check/picture_shape.h"
#include "lang/library/library.h"
#include "picture/srgb.h"
#include "run/pictures/cells_from_outside.h"
#include "run/script/script.h"
#include "unit/export/example_surfaces.h"
#include "unit/mesh/closed.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cascade {
namespace {

using ::testing::HasSubstr;

using std::numbers::pi;

/// The shape `a` of a script.
ShapeForm shape_of(const std::string& blocks) {
    Script script =
        load_script("script.cascade",
                    blocks +
                        "\ncells c { p' += cling(1) }\ndomain { surface: sphere }\n"
                        "stage s: c { founders: 1; duration: 1 }\npicture { shape: a }\n",
                    {}, {});
    EXPECT_EQ(script.messages(false), "");
    return *picture_shape(script.tree, script.sources).form;
}

ShapeValues with(const ShapeForm& form, std::string_view quantity, double value) {
    ShapeValues values = form.usual;
    values[form.find(quantity)->index()] = value;
    return values;
}

Box box_of(const TriangleMesh& mesh) { return bounds(mesh); }

TEST(ShapeMeshes, AreTheFormulas) {
    const ShapeForm form = shape_of(
        "fn twice(v) = 2 * v\n"
        "shape a {\n"
        "  k: 0.5 in 0 .. 2\n"
        "  parts: 2\n"
        "  out = vector(cos(2 * pi * s), 0, sin(2 * pi * s))\n"
        "  up = unit(cross(vector(0, 0, 1), vector(1, 0, 0)))\n"
        "  place = mix(out, twice(out), k) * (1 - t) + part * up + t * dot(up, up) * up\n"
        "  shade = length(out) * t\n"
        "}");
    EXPECT_EQ(form.parts, 2u);
    const auto parts = parts_of(form, with(form, "k", 0.25));
    ASSERT_EQ(parts.size(), 2u);
    for (const double t : {0.0, 0.3, 1.0}) {
        for (const double s : {0.0, 0.1, 0.7}) {
            const double out = 1.25 * (1 - t);
            const Vector3d wanted{out * std::cos(2 * pi * s), 1 + t, out * std::sin(2 * pi * s)};
            EXPECT_LT(length(parts[1].surface(t, s) - wanted), 1e-12);
            EXPECT_NEAR(parts[1].shade(t, s), t, 1e-12);
        }
    }
    // Without a rule for it, the middle line is straight.
    const ShapeForm cone = shape_of("shape a { radius = 1 - t }");
    const auto mesh = mesh_of(parts_of(cone, cone.usual), {1, 0.002});
    ASSERT_TRUE(mesh);
    EXPECT_NEAR(test::volume_of(*mesh), pi / 3, 0.02);
}

TEST(ShapeMeshes, OfTheLibraryAreClosedAndStandOnTheirBase) {
    for (const LibraryText& text : library_shapes()) {
        const ShapeForm form = library_shape(text.system_name());
        for (const double part : {0.0, 0.5, 1.0}) {
            ShapeValues values = form.usual;
            for (const ItemId item : form.quantities.ids()) {
                const auto& range = form.quantities[item].range;
                if (range) values[item.index()] = range->low + part * (range->high - range->low);
            }
            EXPECT_EQ(fault_of(form, values), "");
            const auto mesh = mesh_of(parts_of(form, values), {1, 0.02});
            ASSERT_TRUE(mesh) << text.file_name << ": " << mesh.error().message;
            EXPECT_TRUE(test::is_closed(*mesh)) << text.file_name;
            EXPECT_GT(test::volume_of(*mesh), 0.01) << text.file_name;
            const Box box = box_of(*mesh);
            EXPECT_LT(std::abs(box.low.x + box.high.x), 0.3F) << text.file_name;
            EXPECT_GE(box.low.x, -1.2F) << text.file_name;
            EXPECT_LE(box.high.y, 1.3F) << text.file_name;
            // The shape extends at least as far in the direction ez as in the opposite direction.
            EXPECT_GE(box.high.z, -box.low.z - 1e-5F) << text.file_name;
        }
    }
}

TEST(ShapeMeshes, ABumpBecomesAThorn) {
    const ShapeForm thorn = library_shape("thorn");
    const auto made = [&](double form, double bend) {
        ShapeValues values = with(thorn, "form", form);
        values[thorn.find("bend")->index()] = bend;
        return *mesh_of(parts_of(thorn, values), {1, 0.005});
    };
    // Half an ellipsoid, and a pointed shape that is higher, slimmer and lighter.
    EXPECT_NEAR(test::volume_of(made(0, 0)), 2 * pi / 3 * 0.4, 0.02);
    EXPECT_NEAR(box_of(made(0, 0)).high.y, 0.4, 1e-5);
    EXPECT_NEAR(box_of(made(1, 0)).high.y, 1, 1e-5);
    EXPECT_LT(test::volume_of(made(1, 0)), test::volume_of(made(0, 0)));
    EXPECT_GT(box_of(made(1, 1)).high.z, 0.7F);
}

TEST(ShapeMeshes, ADerivedShapeChangesItsBase) {
    const ShapeForm form = shape_of("shape a: thorn { radius = 0.5 * (1 - t); bend: 0 in 0 .. 1 }");
    const auto mesh = mesh_of(parts_of(form, form.usual), {1, 0.002});
    ASSERT_TRUE(mesh);
    EXPECT_NEAR(test::volume_of(*mesh), pi / 12, 0.01);
}

TEST(ShapeMeshes, NameWhatIsNotFiniteOrTooLarge) {
    const ShapeForm form = shape_of("shape a { k: 1; radius = (1 - t) / k; shade = sqrt(k + 2) }");
    EXPECT_EQ(fault_of(form, form.usual), "");
    EXPECT_THAT(fault_of(form, with(form, "k", 0)), HasSubstr("is not finite at t = 0, s = 0"));
    EXPECT_THAT(fault_of(form, with(form, "k", 1e-5)), HasSubstr("reaches 1e+05 at t = 0"));
    EXPECT_THAT(fault_of(form, with(form, "k", -3)), HasSubstr("is not finite"));
    const ShapeForm flat = shape_of("shape a { place = vector(s, t, 0) }");
    EXPECT_THAT(fault_of(flat, flat.usual), HasSubstr("encloses no volume"));
}

TEST(ShapeMeshes, AreSharedByCells) {
    const ShapeForm form = shape_of(
        "shape a { k: 1 in 0 .. 1; n: 2 in 0 .. 8 step 1; free: 0; "
        "radius = (1 - t) * (k + n + free) }");
    const ItemId k = *form.find("k"), n = *form.find("n"), free = *form.find("free");
    const double nan = std::nan("");
    // Values are clamped and rounded to the nearest sixteenth. A value that is not finite gives no
    // shape.
    const SharedShapes by_k =
        share_shapes(form, std::vector<QuantityValues>{{k, {0.49, 0.51, 0, -1, 2, nan}}}, 6);
    EXPECT_THAT(by_k.of_cells, ::testing::ElementsAre(0, 0, 1, 1, 2, SharedShapes::none));
    EXPECT_EQ(by_k.shapes[0][k.index()], 0.5);
    EXPECT_EQ(by_k.shapes[2][k.index()], 1);
    EXPECT_EQ(by_k.shapes[0][n.index()], 2);
    const SharedShapes by_n =
        share_shapes(form, std::vector<QuantityValues>{{n, {2.6, 3.4, 7}}}, 3);
    EXPECT_THAT(by_n.of_cells, ::testing::ElementsAre(0, 0, 1));
    EXPECT_EQ(by_n.shapes[0][n.index()], 3);
    // A quantity without a range is rounded to sixteenths of the range of its values.
    const SharedShapes by_free =
        share_shapes(form, std::vector<QuantityValues>{{free, {100, 260, 109, 101}}}, 4);
    EXPECT_THAT(by_free.of_cells, ::testing::ElementsAre(0, 1, 2, 0));
    EXPECT_EQ(by_free.shapes[2][free.index()], 110);
    // If there are too many shapes, values are rounded more coarsely.
    std::vector<double> many;
    for (int i = 0; i <= 1000; ++i) many.push_back(i / 1000.0);
    EXPECT_EQ(share_shapes(form, std::vector<QuantityValues>{{k, many}}, 1001).shapes.size(), 17u);
    EXPECT_EQ(share_shapes(form, std::vector<QuantityValues>{{k, many}}, 1001, 10).shapes.size(),
              9u);
    // Cells without values of their own have the usual shape.
    const SharedShapes usual = share_shapes(form, {}, 3);
    EXPECT_THAT(usual.of_cells, ::testing::ElementsAre(0, 0, 0));
    EXPECT_EQ(usual.shapes.front(), form.usual);
}

/// A place on the square of test::flat_square(1).
SurfacePlace place_on(const SurfaceMesh& square, double x, double y) {
    for (std::uint32_t t = 0; t < square.triangles.size(); ++t) {
        const auto corner = [&](std::size_t k) { return square.points[square.triangles[t][k]]; };
        const auto doubled_area = [](Vector3d a, Vector3d b, Vector3d c) {
            return cross(b - a, c - a).z;
        };
        const Vector3d p{x, y, 0};
        const double whole = doubled_area(corner(0), corner(1), corner(2));
        const double a = doubled_area(p, corner(1), corner(2)) / whole;
        const double b = doubled_area(corner(0), p, corner(2)) / whole;
        if (a >= 0 && b >= 0 && a + b <= 1) return {t, {a, b, 1 - a - b}};
    }
    ADD_FAILURE() << "the place is not on the square";
    return {};
}

TEST(ShapeMeshes, PlatesOverlapLikeRoofTiles) {
    // Cells that touch six neighbours each, combed in any direction, with the sizes that pictures
    // have by default.
    constexpr double r = 0.04;
    const ShapeForm form = library_shape("plate");
    const SurfaceMesh square = test::flat_square(1);
    for (const double angle : {0.0, pi / 12, pi / 6}) {
        Instances plates;
        auto mesh = mesh_of(parts_of(form, form.usual), {10, 0.01});
        ASSERT_TRUE(mesh);
        plates.meshes = {*std::move(mesh)};
        const Vector3d along{std::cos(angle), std::sin(angle), 0}, normal{0, 0, 1};
        const auto number_of = [](double x, double y) {
            return static_cast<float>(std::fmod(17 * x + 29 * y, 1));
        };
        for (int row = -30; row < 30; ++row) {
            for (int column = -30; column < 30; ++column) {
                const double x = 0.5 + (2 * column + row % 2) * r;
                const double y = 0.5 + std::sqrt(3.0) * row * r;
                if (std::min(x, y) < 0.1 || std::max(x, y) > 0.9) continue;
                Placement each;
                each.place = {x, y, 0};
                each.turn = quaternion_of(cross(normal, along), normal, along);
                each.scale = {r, r, r};
                each.colour = {1, number_of(x, y), 0};
                plates.placements.push_back(each);
            }
        }
        const CellsFromOutside seen(square, plates);
        for (double x = 0.3; x < 0.7; x += 0.01) {
            for (double y = 0.3; y < 0.7; y += 0.01) {
                EXPECT_TRUE(seen.above(place_on(square, x, y))) << "a gap at " << x << ' ' << y;
            }
        }
        int tips = 0;
        for (const Placement& each : plates.placements) {
            const Vector3d tip = each.place + along * (1.7 * r);
            if (std::min(tip.x, tip.y) < 0.3 || std::max(tip.x, tip.y) > 0.7) continue;
            const auto top = seen.above(place_on(square, tip.x, tip.y));
            ASSERT_TRUE(top);
            const Colour light = light_of(each.colour);
            EXPECT_NEAR(top->light[1] / top->light[0], light[1] / light[0], 1e-3)
                << "another scale lies over the free end";
            ++tips;
        }
        EXPECT_GT(tips, 20);
    }
}

}  // namespace
}  // namespace cascade

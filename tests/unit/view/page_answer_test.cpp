// Answers to pages: positions of diagnostics, sliders, and the layout of snapshots.
#include "view/page_answer.h"

#include "run/session/session.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace cascade {
namespace {

using Json = nlohmann::json;

constexpr std::string_view waves = R"(domain { grid: 6, 4; mask: x < 0.5 }
system waves {
  u: x
  w: 2
  k: 0.1 in 0 .. 1 step 0.01   ## how fast "u" fades
  m: x in 0 .. 1
  u' = -k * u
  w' = m
}
stage one: waves { iterations: 5 }
stage two: waves { k: 0.5; iterations: 5 }
)";

SimulationOptions interpreted() {
    SimulationOptions options;
    options.backend = "interp";
    options.threads = 1;
    return options;
}

std::unique_ptr<LiveRun> begin(std::string_view text) {
    RunControl control;
    auto run = LiveRun::begin(load_script("waves.cascade", std::string(text), "."), interpreted(),
                              control);
    return run ? std::move(*run) : nullptr;
}

TEST(PageAnswer, ScriptWithItsSliders) {
    const auto run = begin(waves);
    ASSERT_TRUE(run);
    const Json script = Json::parse(print_script(*run));
    EXPECT_EQ(script["kind"], "script");
    EXPECT_EQ(script["name"], "waves.cascade");
    EXPECT_EQ(script["text"], waves);
    EXPECT_EQ(script["species"].size(), 2U);
    // A parameter that varies has no slider, and neither has a stage that has not begun.
    ASSERT_EQ(script["controls"].size(), 1U);
    const Json& slider = script["controls"][0];
    EXPECT_EQ(slider["name"], "one.k");
    EXPECT_EQ(slider["label"], "k");
    EXPECT_EQ(slider["stage"], 1);
    EXPECT_EQ(slider["doc"], "how fast \"u\" fades");
    EXPECT_EQ(slider["low"], 0);
    EXPECT_EQ(slider["high"], 1);
    EXPECT_EQ(slider["step"], 0.01);
    EXPECT_FLOAT_EQ(slider["value"].get<float>(), 0.1F);
}

TEST(PageAnswer, MessagesCarryTheirPlaceInTheText) {
    const auto run = begin(waves);
    ASSERT_TRUE(run);
    const std::string wrong =
        "# \xf0\x9f\x90\x86 \xc3\xa9\n# \xf0\x9f\x90\x86 \xc3\xa9\nstage one: wavez { }\n";
    RunControl control;
    const Json answer = Json::parse(print_answer(7, run->apply(SetText{wrong}, control), wrong));
    EXPECT_EQ(answer["kind"], "answer");
    EXPECT_EQ(answer["id"], 7);
    EXPECT_EQ(answer["is_done"], false);
    ASSERT_GE(answer["messages"].size(), 1U);
    const Json& message = answer["messages"][0];
    EXPECT_EQ(message["is_error"], true);
    EXPECT_THAT(message["message"].get<std::string>(), testing::HasSubstr("wavez"));
    EXPECT_EQ(message["from"], Json({3, 11}));
    EXPECT_EQ(message["to"], Json({3, 16}));

    // Columns are counted in UTF-16 units. The leopard takes two of them.
    const std::string text = "stage one: wave { } # \xf0\x9f\x90\x86\nstage \xf0\x9f\x90\x86 x";
    const Json other = Json::parse(print_answer(8, run->apply(SetText{text}, control), text));
    ASSERT_GE(other["messages"].size(), 1U);
    bool is_behind = false;
    for (const Json& each : other["messages"]) {
        is_behind = is_behind || (each.contains("to") && each["to"] == Json({2, 8}));
    }
    EXPECT_TRUE(is_behind) << other.dump(1);

    const Json done = Json::parse(print_answer(9, {}, ""));
    EXPECT_EQ(done,
              Json(
                  {{"kind", "answer"}, {"id", 9}, {"is_done", true}, {"messages", Json::array()}}));
    const Json failed = Json::parse(print_failure(0, {"it is no \xff text", "say more"}));
    EXPECT_EQ(failed["messages"][0]["message"], "it is no \xef\xbf\xbd text");
    EXPECT_EQ(failed["messages"][0]["hint"], "say more");
}

TEST(PageAnswer, Palettes) {
    const Json palettes = Json::parse(print_palettes());
    EXPECT_EQ(palettes["palettes"][0]["name"], "grey");
    EXPECT_EQ(palettes["palettes"][0]["stops"][0], Json({0.0, 0.0, 0.0}));
}

TEST(PageAnswer, SnapshotsAreAHeaderAndPlanes) {
    RunControl control;
    auto session = Session::begin(load_script("waves.cascade", std::string(waves), "."),
                                  interpreted(), control);
    ASSERT_TRUE(session.has_value());
    const auto snapshot = (*session)->newest();
    const std::string bytes = print_snapshot(*snapshot);
    std::uint32_t size = 0;
    std::memcpy(&size, bytes.data(), sizeof size);
    ASSERT_EQ(size % 4, 0U);
    ASSERT_EQ(bytes.size(), sizeof size + size + 6 * 4 * sizeof(float));
    const Json header = Json::parse(bytes.substr(sizeof size, size));
    EXPECT_EQ(header["number"], snapshot->number);
    EXPECT_EQ(header["columns"], 6);
    EXPECT_EQ(header["rows"], 4);
    EXPECT_EQ(header["fields"], 1);
    EXPECT_EQ(header["stage"], 1);
    EXPECT_EQ(header["steps"], 0);
    EXPECT_EQ(header["stages"][1]["name"], "two");
    EXPECT_EQ(header["stages"][1]["has_begun"], false);
    std::vector<float> cells(24);
    std::memcpy(cells.data(), bytes.data() + sizeof size + size, 24 * sizeof(float));
    for (std::int64_t row = 0; row < 4; ++row) {
        for (std::int64_t column = 0; column < 6; ++column) {
            const float seen = cells[static_cast<std::size_t>(6 * row + column)];
            const float held = snapshot->fields[0].row(row)[column];
            EXPECT_TRUE(seen == held || (std::isnan(seen) && std::isnan(held)));
            EXPECT_EQ(std::isnan(seen), column >= 3) << "outside of the mask";
        }
    }
    EXPECT_FLOAT_EQ(header["low"].get<float>(), cells[0]);
    EXPECT_FLOAT_EQ(header["high"].get<float>(), cells[2]);
    EXPECT_FALSE(header.contains("slice"));
}

TEST(PageAnswer, SurfacesAreAHeaderAndArrays) {
    ShownSurface surface;
    surface.up = Axis::z;
    surface.positions = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
    surface.normals = {{0, 0, 1}, {0, 0, 1}, {0, 1, 0}};
    surface.places = {{0, 0}, {0.5F, 0}, {0, 0.25F}};
    surface.triangles = {{0, 1, 2}};
    surface.ends = {1, 2, 4};
    surface.shares = {{7, 1}, {8, 1}, {7, 0.25F}, {9, 0.75F}};
    const std::string bytes = print_surface(surface, 12);
    std::uint32_t size = 0;
    std::memcpy(&size, bytes.data(), sizeof size);
    ASSERT_EQ(size % 4, 0U);
    const Json header = Json::parse(bytes.substr(sizeof size, size));
    EXPECT_EQ(header, Json({{"kind", "surface"},
                            {"number", 12},
                            {"up", "z"},
                            {"spacing", 0.0},
                            {"vertices", 3},
                            {"places", 3},
                            {"triangles", 1},
                            {"shares", 4}}));
    ASSERT_EQ(bytes.size(), sizeof size + size + 4 * (9 + 9 + 6 + 3 + 3 + 8));
    const char* const numbers = bytes.data() + sizeof size + size;
    float y = 0, weight = 0;
    std::uint32_t end = 0, cell = 0;
    std::memcpy(&y, numbers + 4 * 4, 4);
    std::memcpy(&end, numbers + 4 * (9 + 9 + 6 + 3 + 2), 4);
    std::memcpy(&cell, numbers + 4 * (30 + 6), 4);
    std::memcpy(&weight, numbers + 4 * (30 + 7), 4);
    EXPECT_EQ(y, 5);
    EXPECT_EQ(end, 4U);
    EXPECT_EQ(cell, 9U);
    EXPECT_EQ(weight, 0.75F);
}

TEST(PageAnswer, SnapshotsOfVolumesNameTheirSlice) {
    RunControl control;
    const std::string ball =
        "domain { grid: 6, 5, 4 }\nsystem s { u: x; u' = 0 }\nstage s: s { iterations: 9 }\n";
    auto session = Session::begin(load_script("ball.cascade", ball, "."), interpreted(), control);
    ASSERT_TRUE(session.has_value());
    const std::string bytes = print_snapshot(*(*session)->newest());
    std::uint32_t size = 0;
    std::memcpy(&size, bytes.data(), sizeof size);
    const Json header = Json::parse(bytes.substr(sizeof size, size));
    EXPECT_EQ(header["columns"], 6);
    EXPECT_EQ(header["rows"], 5);
    EXPECT_EQ(header["slice"], Json({{"axis", "z"}, {"number", 2}, {"sides", {6, 5, 4}}}));
}

/// The arrays that follow a header.
class Arrays {
public:
    explicit Arrays(std::string_view bytes) : bytes_(bytes) {}
    template <typename Element>
    std::vector<Element> take(std::size_t count) {
        std::vector<Element> elements(count);
        std::memcpy(elements.data(), bytes_.data(), count * sizeof(Element));
        bytes_.remove_prefix(count * sizeof(Element));
        return elements;
    }
    std::size_t rest() const { return bytes_.size(); }

private:
    std::string_view bytes_;
};

TEST(PageAnswer, SnapshotsOfCellsAreMeshesAndWhereTheirCopiesStand) {
    RunControl control;
    const std::string crowd =
        "cells crowd: solid { c: 0 }\ndomain { grid: 20, 10 }\n"
        "stage s: crowd { founders: 5; r: 0.03; c: if(x < 0.5, 1, 0); duration: 1; show: x }\n"
        "picture { shape: thorn; form: c; width: if(y < 0.05, 0, r) }\n";
    auto session = Session::begin(load_script("crowd.cascade", crowd, "."), interpreted(), control);
    ASSERT_TRUE(session.has_value());
    const auto snapshot = (*session)->newest();
    ASSERT_TRUE(snapshot->cells);
    const std::string bytes = print_snapshot(*snapshot);
    std::uint32_t size = 0;
    std::memcpy(&size, bytes.data(), sizeof size);
    ASSERT_EQ(size % 4, 0U);
    const Json header = Json::parse(bytes.substr(sizeof size, size));
    EXPECT_EQ(header["columns"], 5);
    EXPECT_EQ(header["stages"][0]["cells"], Json({{"count", 5}, {"births", 0}, {"deaths", 0}}));
    const Json& cells = header["cells"];
    EXPECT_EQ(cells["count"], 5);
    EXPECT_EQ(cells["extent"], Json({1.0, 0.5, 0.0}));
    const std::size_t shapes = cells["shapes"], vertices = cells["vertices"],
                      triangles = cells["triangles"], placements = cells["placements"];
    EXPECT_LE(shapes, 2U) << "two forms at most";

    Arrays arrays(std::string_view(bytes).substr(sizeof size + size));
    const auto values = arrays.take<float>(5);
    arrays.take<float>(3 * vertices);
    const auto normals = arrays.take<float>(3 * vertices);
    EXPECT_NEAR(std::hypot(normals[0], normals[1], normals[2]), 1, 1e-5);
    arrays.take<float>(vertices);
    const auto corners = arrays.take<std::uint32_t>(3 * triangles);
    EXPECT_LT(*std::ranges::max_element(corners), vertices);
    const auto triangle_ends = arrays.take<std::uint32_t>(shapes);
    const auto ends = arrays.take<std::uint32_t>(shapes);
    const auto shown = arrays.take<std::uint32_t>(placements);
    const auto numbers = arrays.take<float>(10 * placements);
    EXPECT_EQ(arrays.rest(), 0U);
    EXPECT_EQ(triangle_ends.back(), triangles);
    EXPECT_EQ(ends.back(), placements);
    for (std::size_t k = 0; k < placements; ++k) {
        // The cells show their x, and the second coordinate of all is 0.
        EXPECT_FLOAT_EQ(numbers[10 * k], values[shown[k]]);
        EXPECT_FLOAT_EQ(numbers[10 * k + 1], 0);
        EXPECT_GE(numbers[10 * k + 2], 0.05F) << "cells without a width are not drawn";
        EXPECT_FLOAT_EQ(numbers[10 * k + 7], 0.015F) << "half of the width";
    }
}

}  // namespace
}  // namespace cascade

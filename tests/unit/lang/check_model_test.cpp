// Domains that are models: control over their surface, directions of their cells, and what planes
// lack.
#include "check_helpers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cascade::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Faults of a domain with a model and one statement of a stage, those of the domain included.
std::vector<std::string> faults_on(const std::string& domain, const std::string& statement = "") {
    const auto checked =
        check_text("domain { " + domain + " }\nsystem_name: turing_spots\n" + statement + "\n");
    return checked->faults();
}

std::vector<std::string> faults(const std::string& statement) {
    return faults_on("surface: sphere", statement);
}

TEST(CheckModel, PointsComeInGroups) {
    EXPECT_THAT(faults("ka: distance(0, 1, 0)"), IsEmpty());
    EXPECT_THAT(faults("ka: distance(0, 1, 0, 1, 1/2, 0)"), IsEmpty());
    EXPECT_THAT(faults("ka: keys(0, 1, 0, 2, 1, 1, 0, 3)"), IsEmpty());
    EXPECT_THAT(faults("ka: keys(0, 1, 0, 2, 1, 1, 0, 3, 0.2)"), IsEmpty());
    EXPECT_THAT(
        faults("ka: distance(0, 1)"),
        ElementsAre(
            "3:5: distance takes groups of 3 values, not 2 | distance(x, y, z, …): how far it "
            "is along the surface to the nearest of the points, in 0..1 coordinates"));
    EXPECT_THAT(
        faults("ka: keys(0, 1, 0, 2, 1, 1)"),
        ElementsAre(
            "3:5: keys takes groups of 4 values, and perhaps one more, not 6 | keys(x, y, z, "
            "value, …, smoothing): the value of the nearest point along the surface, "
            "smoothed over that length"));
}

TEST(CheckModel, PointsAreKnownBeforeTheRun) {
    EXPECT_THAT(faults("ka: distance(0, x, 0)"),
                ElementsAre(
                    "3:17: distance takes numbers that are known before the run | the points stay "
                    "where they are"));
    EXPECT_THAT(
        faults("ka: keys(0, 1, 0, random(1, 1))"),
        ElementsAre(
            "3:19: keys takes numbers that are known before the run | the points stay where "
            "they are"));
    EXPECT_THAT(
        faults("ka: distance(0, 1e20, 0)"),
        ElementsAre(
            "3:17: this number is too large | coordinates are 0..1 along the longest side"));
    EXPECT_THAT(faults("ka: keys(0, 1, 0, 2, -0.1)"),
                ElementsAre("3:22: a length of smoothing is not below 0"));
    EXPECT_THAT(faults("iterations: distance(0, 1, 0)"),
                ElementsAre(
                    "3:13: iterations must be one number, but distance is varying by cell"));
}

TEST(CheckModel, EqualValuesAreOneAndPrintedAsWritten) {
    const auto checked = check_text(
        "domain { surface: sphere }\nsystem_name: turing_spots\nka: distance(0, 1, 1/2)\n"
        "beta: distance(0, 1, 0.5) + keys(0, 0, 0, 1)\n");
    ASSERT_TRUE(checked->program) << ::testing::PrintToString(checked->faults());
    ASSERT_EQ(checked->program->literals->surface_values().size(), 2u);
    const std::string text = print_program(*checked->program);
    EXPECT_NE(text.find("ka: distance(0, 1, 0.5)"), std::string::npos) << text;
    EXPECT_NE(text.find("distance(0, 1, 0.5) + keys(0, 0, 0, 1)"), std::string::npos) << text;
}

TEST(CheckModel, APlaneHasNoPlacesAlongIt) {
    EXPECT_THAT(
        faults_on("grid: 9, 9", "ka: distance(0, 1, 0)"),
        ElementsAre(
            "3:5: distance has a meaning on models only | domain { mesh: \"horse.ply\" } or "
            "{ surface: creature } is one"));
    EXPECT_THAT(faults_on("grid: 9, 9", "ka: attr(\"age\")"),
                ElementsAre(
                    "3:5: attr has a meaning on models only | domain { mesh: \"horse.ply\" } or "
                    "{ surface: creature } is one"));
    EXPECT_THAT(faults_on("grid: 9, 9; mask: keys(0, 0, 0, 1)"),
                ElementsAre(
                    "1:28: keys cannot stand here | a mask is that of a plane; it belongs to the "
                    "cells of a model"));
    EXPECT_THAT(faults_on("grid: 9, 9", "ka: 1 + curvature_gauss"), IsEmpty());
}

TEST(CheckModel, NamesInQuotesBelongInValues) {
    EXPECT_THAT(faults("ka: attr(\"age\") + uvimage(\"a.png\")"), IsEmpty());
    EXPECT_THAT(faults("ka: attr(age)"),
                ElementsAre("3:10: a text in quotes is expected here | \"age\""));
    EXPECT_THAT(faults("show: attr(\"age\")"),
                ElementsAre("3:7: attr cannot stand here | it belongs in values (name: …)"));
    EXPECT_THAT(faults("ka: image(\"a.png\")"),
                ElementsAre(
                    "3:5: image cannot be used on a model | rows and columns of a picture have no "
                    "meaning on a model; uvimage(\"f.png\") is a picture painted on it"));
}

TEST(CheckModel, DirectionsAndTheirNumbers) {
    const auto checked = check_text(
        "domain { surface: creature; directions: keys(0, 1, 0, 0, 0, 1, 0.3); stretch: 3/2 }\n"
        "system_name: turing_spots\n");
    ASSERT_TRUE(checked->program) << ::testing::PrintToString(checked->faults());
    const ModelSettings& model = *checked->program->domain.model;
    ASSERT_TRUE(model.directions);
    EXPECT_EQ(model.directions->kind, DirectionSettings::Kind::keys);
    EXPECT_THAT(model.directions->numbers, ElementsAre(0, 1, 0, 0, 0, 1));
    EXPECT_EQ(model.directions->smoothing, 0.3);
    EXPECT_EQ(model.stretch, 1.5);
    for (const char* right : {"axis(0, 1, 0)", "gradient(x^2 - y)", "curvature_high",
                              "curvature_low(0.1)", "keys(0, 1, 0, 0, 0, 1)"}) {
        EXPECT_THAT(faults_on(std::string("surface: creature; directions: ") + right), IsEmpty());
    }
}

TEST(CheckModel, WrongDirections) {
    const auto wrong = [](const std::string& directions) {
        return faults_on("surface: sphere; directions: " + directions);
    };
    EXPECT_THAT(
        wrong("axes(0, 1, 0)"),
        ElementsAre(
            "1:39: directions are axis, gradient, curvature_high, curvature_low or keys | did "
            "you mean 'axis'?"));
    EXPECT_THAT(wrong("axis"),
                ElementsAre("1:39: this is not how directions are written | directions: "
                            "axis(0, 1, 0)"));
    EXPECT_THAT(wrong("axis(0, 1)"),
                ElementsAre(
                    "1:39: this is not how directions are written | directions: axis(0, 1, 0)"));
    EXPECT_THAT(wrong("axis(0, 0, 0)"),
                ElementsAre(
                    "1:39: a vector of length 0 has no direction | directions: axis(0, 1, 0)"));
    EXPECT_THAT(wrong("curvature_low(-1)"),
                ElementsAre("1:53: a length of smoothing is not below 0"));
    EXPECT_THAT(wrong("axis(0, 1, 0); stretch: 0.5"),
                ElementsAre(
                    "1:63: stretch is from 1 to 100 | cells are so many times as long as wide"));
    EXPECT_THAT(
        wrong("axis(0, 1, 0); cells: faces"),
        ElementsAre(
            "1:39: only cells that are spread over a model can be stretched | cells: 20000, or "
            "--cells 20000"));
    EXPECT_THAT(faults_on("surface: sphere; stretch: 3"),
                ElementsAre(
                    "1:27: cells are stretched along directions | directions: axis(0, 1, 0)"));
    EXPECT_THAT(faults_on("grid: 9, 9; directions: axis(0, 1, 0)"),
                ElementsAre(
                    "1:22: only a domain with a model has this setting | mesh: \"horse.ply\", "
                    "surface: sphere or --mesh sphere makes it one"));
}

TEST(CheckModel, TheAxisThatPointsUpwards) {
    for (const Axis up : {Axis::x, Axis::y, Axis::z}) {
        const auto checked = check_text("domain { surface: box; up: " + std::string(name_of(up)) +
                                        " }\nsystem_name: turing_spots\n");
        ASSERT_TRUE(checked->program) << ::testing::PrintToString(checked->faults());
        EXPECT_EQ(checked->program->domain.model->up, up);
    }
    for (const char* wrong : {"w", "3", "-z", "\"z\"", "x + y", "axis(0, 0, 1)"}) {
        EXPECT_THAT(faults_on(std::string("surface: box; up: ") + wrong),
                    ElementsAre("1:28: the axis that points upwards is x, y or z"))
            << wrong;
    }
    EXPECT_EQ(faults_on("surface: box; up: x, z").size(), 1u);
    EXPECT_EQ(faults_on("surface: box; up: x; up: z").size(), 1u);
    EXPECT_THAT(faults_on("grid: 9, 9; up: z"),
                ElementsAre(
                    "1:22: only a domain with a model has this setting | mesh: \"horse.ply\", "
                    "surface: sphere or --mesh sphere makes it one"));
}

}  // namespace
}  // namespace cascade::testing

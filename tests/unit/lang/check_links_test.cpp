// Vectors and neighbours that are refused in systems of cells that crawl and in systems of fields.
#include "check_helpers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace cascade::test {
namespace {

/// The first message about a rate in a block of cells, without its position, or "" if there is
/// none.
std::string fault_of(const std::string& rate, const std::string& before = "") {
    const auto checked =
        check_text(before + "cells c {\n  k: 2; q: 0\n  v = 2 * p\n  q' = k * dot(v, v) + q + " +
                   rate + "\n}\nstage s: c { founders: 2; duration: 1 }\n");
    const auto faults = checked->faults();
    if (faults.empty()) return "";
    return faults[0].substr(faults[0].find(' ') + 1);
}

TEST(CheckLinks, VectorsAreNoNumbers) {
    EXPECT_EQ(fault_of("v"),
              "a number and a vector cannot be added | "
              "div(v), dot(v, w), length(v) and v.x are numbers");
    EXPECT_EQ(fault_of("tanh(v)"),
              "a vector is not a number | dot(a, b) and length(v) turn a vector into a number");
    EXPECT_EQ(fault_of("dot(k, v)"),
              "a vector is needed here | such as p, normal or vector(1, 0, 0)");
    EXPECT_EQ(fault_of("length(v * p)"),
              "a vector cannot be multiplied by a vector | write dot(a, b) or cross(a, b) for a "
              "product of two vectors");
    EXPECT_EQ(fault_of("length(if(k, v, q))"),
              "if needs two numbers, two vectors or two colours to choose from");
    EXPECT_EQ(fault_of("max(v over touching)"),
              "a vector is not a number | dot(a, b) and length(v) turn a vector into a number");
    EXPECT_EQ(fault_of("length(if(k, v, unit(mix(v, ez, 0.5))))"), "");
}

TEST(CheckLinks, ValuesOfTwoCellsAreKnownInside) {
    EXPECT_EQ(
        fault_of("contact"),
        "'contact' belongs to a pair of cells, so it can be used only in sums over neighbours | "
        "for example, sum(contact over touching)");
    EXPECT_EQ(
        fault_of("sum(own(contact) over touching)"),
        "'contact' belongs to a pair of cells, so it can be used only in sums over neighbours | "
        "for example, sum(contact over touching)");
    EXPECT_EQ(fault_of("own(q)"),
              "own(e) can be used only in sums over neighbours | leave own(…) out: outside of "
              "such sums, names already belong to the cell itself");
    EXPECT_EQ(
        fault_of("both(overlap)", "fn both(a) = a + sum(a over touching)\n"),
        "'overlap' belongs to a pair of cells, so it can be used only in sums over neighbours | "
        "for example, sum(overlap over touching)");
    EXPECT_EQ(fault_of("both(q)", "fn both(a) = a + sum(a * gap over touching)\n"), "");
    EXPECT_EQ(fault_of("sum(sum(distance over touching) over near(k))"), "");
}

TEST(CheckLinks, NearTakesOneDistance) {
    EXPECT_EQ(fault_of("sum(q over near)"),
              "'near' takes a distance | for example, sum(e over near(0.1))");
    EXPECT_EQ(fault_of("sum(q over near(1, 2))"),
              "'near' takes one distance | such as sum(e over near(0.1))");
    EXPECT_EQ(
        fault_of("sum(q over near(2 * q))"),
        "the distance of 'near' must be one number for all cells | only a number or a parameter "
        "can be used "
        "here");
    EXPECT_EQ(fault_of("product(q over touching)"),
              "product cannot be taken over neighbours | use mean, sum, min or max");
}

TEST(CheckLinks, CellsReadTheModelWhereTheyAre) {
    EXPECT_EQ(fault_of("attr(\"fur\")").find("attr can be used only on models"), 0u);
}

TEST(CheckLinks, FieldsHaveNoNeighboursAndCellsNoGrid) {
    const auto fault = [](const std::string& rate) {
        return check_text("system s { u: 0; u' = " + rate + " }\nstage t: s { }\n")->faults()[0];
    };
    EXPECT_THAT(fault("sum(u over touching)"),
                ::testing::EndsWith(
                    "there is no index 'touching' | only cells that crawl have neighbours"));
    EXPECT_THAT(fault("own(u)"), ::testing::EndsWith("use it in a block of cells that crawl"));
    EXPECT_THAT(fault("contact"),
                ::testing::EndsWith("'contact' can be used only by cells that crawl"));
    EXPECT_EQ(
        fault_of("dx(q)"),
        "dx cannot be used here | use lap(e) or sums over neighbours: cells that crawl have no "
        "grid");
}

}  // namespace
}  // namespace cascade::test

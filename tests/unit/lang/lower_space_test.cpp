// Lowering of values that depend on position: coordinates, shapes and random numbers.
#include "lower_helpers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace cascade::test {
namespace {

TEST(Lower, Coordinates) {
    for (const auto& [i, j] : {std::pair{0, 0}, {7, 3}, {2, 1}}) {
        EXPECT_FLOAT_EQ(FormulaValues(small_grid, "x").at(i, j),
                        (static_cast<float>(i) + 0.5f) / 8);
        EXPECT_FLOAT_EQ(FormulaValues(small_grid, "y").at(i, j),
                        (static_cast<float>(j) + 0.5f) / 8);
        EXPECT_FLOAT_EQ(FormulaValues(small_grid, "sx").at(i, j),
                        (static_cast<float>(i) + 0.5f) / 8);
        EXPECT_FLOAT_EQ(FormulaValues(small_grid, "sy").at(i, j),
                        (static_cast<float>(j) + 0.5f) / 4);
    }
}

/// The number of cells whose centre is within r of one of the nine nearest images of the disc.
std::size_t disc_cells(int width, int height, double x, double y, double r, bool periodic) {
    const double side = std::max(width, height);
    std::size_t count = 0;
    for (int j = 0; j < height; ++j) {
        for (int i = 0; i < width; ++i) {
            bool inside = false;
            for (int image = 0; image < 9; ++image) {
                if (!periodic && image != 4) continue;
                const double dx = (i + 0.5) / side - x + (image % 3 - 1) * width / side;
                const double dy = (j + 0.5) / side - y + (image / 3 - 1) * height / side;
                inside = inside || dx * dx + dy * dy < r * r;
            }
            count += inside;
        }
    }
    return count;
}

TEST(Lower, ShapesAreThoseOfGeometry) {
    const std::string grid = "domain { grid: 40, 20 }\n";
    const auto count = [&](const std::string& value) {
        return FormulaValues(grid, value).count_ones(40, 20);
    };
    EXPECT_EQ(count("ring(0.5, 0.25, 0.15, 0.1)"),
              disc_cells(40, 20, 0.5, 0.25, 0.2, true) - disc_cells(40, 20, 0.5, 0.25, 0.1, true));
    EXPECT_EQ(count("box(0.5, 0.25, 0.2, 0.1)"), 8u * 4u);
    EXPECT_EQ(count("box(0, 0.5, 0.2, 0.1)"), 8u * 4u) << "across periodic sides";
    EXPECT_EQ(count("box(0.5, 0.1, 2, 0.1)"), 40u * 4u) << "a band";
    EXPECT_EQ(count("stripe(0.5, 0.2)"), 8u * 20u);
    EXPECT_EQ(count("stripe(-0.05, 0.2)"), 8u * 20u);
    EXPECT_EQ(count("stripe(0.25, 0.1, pi/2)"), 40u * 4u);
    EXPECT_EQ(count("stripe(0.5, 0.1, 0)"), 4u * 20u);
    EXPECT_EQ(count("disc(0.5, 0.25, 0.7, 0.113)"), count("disc(0.5, 0.25, 0.113)"))
        << "a plane has no depth";
    EXPECT_EQ(count("ring(0.5, 0.25, 0.7, 0.15, 0.1)"), count("ring(0.5, 0.25, 0.15, 0.1)"));
    EXPECT_EQ(count("box(0.5, 0.25, 9, 0.2, 0.1, 0.01)"), 8u * 4u);
    EXPECT_EQ(FormulaValues("domain { grid: 40, 20; boundary: noflux }\n", "box(0, 0.5, 0.2, 0.1)")
                  .count_ones(40, 20),
              4u * 2u);
    const double dx = 0.4125 - 0.5, dy = 0.0875 - 0.4 + 0.5;
    EXPECT_NEAR(FormulaValues(grid, "gauss(0.5, 0.4, 0.1)").at(16, 3),
                std::exp(-(dx * dx + dy * dy) / 0.02), 1e-6);
}

TEST(Lower, ShapesInSpace) {
    const std::string grid = "domain { grid: 20, 16, 12 }\n";
    FormulaValues ball(grid, "disc(0.5, 0.4, 0.1, 0.24)");
    FormulaValues cylinder(grid, "disc(0.5, 0.4, 0.24)");
    for (int k = 0; k < 12; ++k) {
        for (int j = 0; j < 16; ++j) {
            for (int i = 0; i < 20; ++i) {
                const double dx = (i + 0.5) / 20 - 0.5, dy = (j + 0.5) / 20 - 0.4;
                double dz = (k + 0.5) / 20 - 0.1;
                if (dz > 0.3) dz -= 0.6;
                const double across = dx * dx + dy * dy;
                EXPECT_EQ(cylinder.at(i, j, k), across < 0.0576 ? 1 : 0) << i << " " << j;
                EXPECT_EQ(ball.at(i, j, k), across + dz * dz < 0.0576 ? 1 : 0) << i << " " << j;
            }
        }
    }
    FormulaValues draws(grid, "random(0, 1)");
    FormulaValues plane("domain { grid: 20, 16 }\n", "random(0, 1)");
    EXPECT_EQ(draws.at(7, 3, 0), plane.at(7, 3)) << "the first slice is the plane";
    EXPECT_NE(draws.at(7, 3, 1), plane.at(7, 3));
}

TEST(Lower, RandomFunctionsOfOneExpressionAreTold) {
    // Of two equal calls, the first draws the same numbers as a single call would, and the second
    // draws others.
    const std::string grid = "domain { grid: 8, 4; seed: 5 }\n";
    EXPECT_EQ(FormulaValues(grid, "normal(0, 1) + 0 * normal(0, 1)").at(3, 2),
              FormulaValues(grid, "normal(0, 1)").at(3, 2));
    EXPECT_NE(FormulaValues(grid, "0 * random(0, 1) + normal(0, 1)").at(3, 2),
              FormulaValues(grid, "normal(0, 1)").at(3, 2));
    EXPECT_NE(FormulaValues(grid, "0 * lattice(0.5, 0.1) + noise(0.3)").at(3, 2),
              FormulaValues(grid, "noise(0.3)").at(3, 2));
}

TEST(Lower, WhiteNoiseDoesNotDependOnTheStep) {
    for (const std::string speed : {"1", "0.25", "0.01"}) {
        const auto checked = check_text(
            "domain { grid: 64, 64 }\nsystem s { u: 0; k: 3; u' = white(k) }\n"
            "stage one: s { speed: " +
            speed + "; iterations: 1 }\n");
        ASSERT_TRUE(checked->program) << ::testing::PrintToString(checked->faults());
        ScriptRun run(*checked->program);
        run.start(0);
        const Field rate = run.rates(0)[0].clone();
        double squares = 0;
        for (int k = 0; k < 4096; ++k) squares += std::pow(rate.at(k % 64, k / 64), 2) / 4096;
        // The noise of one unit of time has the variance k², within five standard deviations.
        EXPECT_NEAR(squares * std::stod(speed), 9, 9 * 5 * std::sqrt(2.0 / 4096)) << speed;
    }
}

TEST(Lower, Discs) {
    const std::string grid = "domain { grid: 40, 20 }\n";
    const std::string closed = "domain { grid: 40, 20; boundary: noflux }\n";
    EXPECT_EQ(FormulaValues(grid, "disc(0.5, 0.25, 0.113)").count_ones(40, 20),
              disc_cells(40, 20, 0.5, 0.25, 0.113, true));
    EXPECT_EQ(FormulaValues(grid, "disc(0.03, 0.48, 0.113)").count_ones(40, 20),
              disc_cells(40, 20, 0.03, 0.48, 0.113, true));
    EXPECT_EQ(FormulaValues(grid, "disc(3.03, -1.02, 0.113)").count_ones(40, 20),
              disc_cells(40, 20, 0.03, 0.48, 0.113, true))
        << "whole periods make no difference";
    EXPECT_EQ(FormulaValues(closed, "disc(0.03, 0.48, 0.113)").count_ones(40, 20),
              disc_cells(40, 20, 0.03, 0.48, 0.113, false));
    EXPECT_EQ(FormulaValues("domain { grid: 40 }\n", "disc(0.5, 0.5, 0.1)").count_ones(40, 1), 8u)
        << "an interval on a line";
}

TEST(Lower, RandomNumbers) {
    FormulaValues first("domain { grid: 64, 64 }\n", "random(12, 3)");
    double sum = 0, squares = 0;
    std::set<float> different;
    for (int j = 0; j < 64; ++j) {
        for (int i = 0; i < 64; ++i) {
            const double value = first.at(i, j);
            EXPECT_LT(std::abs(value - 12), 3.00001);
            sum += value - 12;
            squares += (value - 12) * (value - 12);
            different.insert(first.at(i, j));
        }
    }
    // The mean is 0 and the variance s²/3, within five standard errors of 4096 draws.
    EXPECT_LT(std::abs(sum / 4096), 5 * 3 / std::sqrt(3.0 * 4096));
    EXPECT_NEAR(squares / 4096, 3.0, 5 * 3 * 0.298 * 3 / 64);
    EXPECT_GT(different.size(), 4000u);
}

TEST(Lower, RandomNumbersDependOnTheirPlaceInTheScriptOnly) {
    const auto value = [](const std::string& text, const std::string& name) {
        const auto checked = check_text("domain { grid: 8, 8; seed: 3 }\n" + text);
        EXPECT_TRUE(checked->program) << ::testing::PrintToString(checked->faults());
        ScriptRun run(*checked->program);
        run.start(0);
        return run.field(0, name).at(5, 2);
    };
    const std::string one = "stage one: turing_spots { beta: random(1, 0.5) }";
    const float beta = value(one, "beta");
    EXPECT_EQ(value("stage one: turing_spots { a: random(3, 1); beta: random(1, 0.5) }", "beta"),
              beta);
    EXPECT_NE(value("stage two: turing_spots { beta: random(1, 0.5) }", "beta"), beta);
    EXPECT_NE(value("stage one: turing_spots { ka: random(1, 0.5) }", "ka"), beta);
    EXPECT_NE(value("stage one: turing_spots { beta: 0 * random(1, 0.5) + random(1, 0.5) }",
                    "beta"),
              beta);
    EXPECT_EQ(value("stage one: turing_spots { beta: random(1, 0.5) + 0 * random(1, 0.5) }",
                    "beta"),
              beta);
}

}  // namespace
}  // namespace cascade::test

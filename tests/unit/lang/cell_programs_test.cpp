// The library's blocks of cells, compared with the programs of K. W. Fleischer, D. H. Laidlaw, B.
// L. Currin, A. H. Barr, "Cellular Texture Generation", SIGGRAPH 1995, table 1, row by row. The
// programs are loops over all pairs of cells in double precision, without formulas, kernels and
// links.
#include "pairs_of_cells.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace cascade::test {
namespace {

constexpr std::size_t cell_count = 50;

/// φ(a, b) of the paper: a soft comparison, 1 if b is far above a.
double phi(double a, double b) { return (std::tanh(b - a) + 1) / 2; }

/// ω of table 1, row 3: the rotation from one direction to another.
Vector3d rotation(const Vector3d& from, const Vector3d& to) {
    const Vector3d axis = cross(from, to);
    const double cosine = std::clamp(dot(from, to) / (length(from) * length(to)), -1.0, 1.0);
    return length(axis) > 0 ? (std::acos(cosine) / length(axis)) * axis : Vector3d{0, 0, 0};
}

class CellPrograms : public ::testing::Test {
protected:
    /// Cells that follow one block of the library, with any frames, radii and normals.
    static HandMadeTissue cells_of(const std::string& block) {
        HandMadeTissue tissue("domain { surface: sphere; precision: double }\nstage s: " + block +
                                  " { founders: 2; duration: 1 }\n",
                              random_places(cell_count, 21));
        tissue.values("p.x")[1] = 3;  // Touches no other cell.
        turn_at_random(tissue, 22);
        RandomStream random(23);
        const auto number = [&] { return static_cast<double>(random.symmetric()); };
        for (std::size_t cell = 0; cell < cell_count; ++cell) {
            tissue.values("r")[cell] = 0.12 + 0.04 * number();
            const Vector3d any{number(), number(), number()};
            const Vector3d normal = (1 / length(any)) * any;
            tissue.sensed(ModelPlane::nx)[cell] = normal.x;
            tissue.sensed(ModelPlane::ny)[cell] = normal.y;
            tissue.sensed(ModelPlane::nz)[cell] = normal.z;
            tissue.sensed(ModelPlane::off)[cell] = 0.1 * number();
            tissue.sensed(ModelPlane::feature)[cell] = 0.03 * (1 + number());
        }
        return tissue;
    }
    /// Cells that follow one block, with these values of its parameters.
    static HandMadeTissue cells_of(const std::string& block,
                                   const std::map<std::string, double>& parameters) {
        HandMadeTissue tissue = cells_of(block);
        for (const auto& [name, value] : parameters) tissue.values(name).assign(cell_count, value);
        return tissue;
    }
    static Vector3d normal(HandMadeTissue& tissue, std::size_t cell) {
        return {tissue.sensed(ModelPlane::nx)[cell], tissue.sensed(ModelPlane::ny)[cell],
                tissue.sensed(ModelPlane::nz)[cell]};
    }
    static void fill(Values& values, std::uint64_t seed, double middle, double width) {
        RandomStream random(seed);
        for (double& value : values) {
            value = middle + width * static_cast<double>(random.symmetric());
        }
    }
    static Values touching(HandMadeTissue& tissue, const Term& term) {
        return summed(tissue, default_reach, term);
    }
    static void expect_rates(HandMadeTissue& tissue, const std::string& vector,
                             const std::vector<Vector3d>& expected) {
        std::array<Values, 3> parts;
        for (const Vector3d& each : expected) {
            parts[0].push_back(each.x);
            parts[1].push_back(each.y);
            parts[2].push_back(each.z);
        }
        expect_near(tissue.rate(vector + ".x"), parts[0]);
        expect_near(tissue.rate(vector + ".y"), parts[1]);
        expect_near(tissue.rate(vector + ".z"), parts[2]);
    }
    /// q' = ½ ω q + (1 − q·q) q: rows 3 to 6, with 4k = 1.
    static void expect_turning(HandMadeTissue& tissue, const std::vector<Vector3d>& turns) {
        Values scalars;
        std::vector<Vector3d> vectors;
        for (std::size_t cell = 0; cell < cell_count; ++cell) {
            const double w = tissue.values("frame.w")[cell];
            const Vector3d v = tissue.vector("frame", cell);
            const double rest = 1 - (w * w + dot(v, v));
            const Vector3d& turn = turns[cell];
            scalars.push_back(-0.5 * dot(turn, v) + rest * w);
            vectors.push_back(0.5 * (w * turn + cross(turn, v)) + rest * v);
        }
        expect_near(tissue.rate("frame.w"), scalars);
        expect_rates(tissue, "frame", vectors);
    }
};

TEST_F(CellPrograms, GoToASurface) {
    HandMadeTissue tissue = cells_of("on_surface", {{"hold", 4}});
    std::vector<Vector3d> expected;
    for (std::size_t cell = 0; cell < cell_count; ++cell) {
        expected.push_back((-4 * tissue.sensed(ModelPlane::off)[cell]) * normal(tissue, cell));
    }
    expect_rates(tissue, "p", expected);
}

TEST_F(CellPrograms, DieFarFromASurface) {
    HandMadeTissue tissue = cells_of("on_surface", {{"hold", 4}});
    const Formula& die = tissue.program().system_of(tissue.stage()).cells->die;
    const Values dies = tissue.run(plan_view(tissue.program(), die, tissue.stage()))[0];
    int deaths = 0;
    for (std::size_t cell = 0; cell < cell_count; ++cell) {
        const bool is_far =
            std::abs(tissue.sensed(ModelPlane::off)[cell]) > tissue.values("r")[cell] / 5;
        EXPECT_EQ(dies[cell] != 0, is_far) << cell;
        deaths += is_far ? 1 : 0;
    }
    EXPECT_GT(deaths, 5);
    EXPECT_LT(deaths, 45);
}

TEST_F(CellPrograms, AlignAnAxisWithAField) {
    HandMadeTissue tissue = cells_of("upright");
    std::vector<Vector3d> turns;
    for (std::size_t cell = 0; cell < cell_count; ++cell) {
        turns.push_back(4.0 * rotation(axis_of(tissue, cell, {0, 1, 0}), normal(tissue, cell)));
    }
    expect_turning(tissue, turns);
}

TEST_F(CellPrograms, AlignAnAxisWithNeighbours) {
    HandMadeTissue tissue = cells_of("combed", {{"combing", 1}});
    const auto turn = [&](std::size_t i, std::size_t j) {
        return rotation(axis_of(tissue, i, {0, 0, 1}), axis_of(tissue, j, {0, 0, 1}));
    };
    const Values x = touching(tissue, [&](auto i, auto j) { return turn(i, j).x; });
    const Values y = touching(tissue, [&](auto i, auto j) { return turn(i, j).y; });
    const Values z = touching(tissue, [&](auto i, auto j) { return turn(i, j).z; });
    const Values around = touching(tissue, [](auto, auto) { return 1; });
    std::vector<Vector3d> turns;
    for (std::size_t cell = 0; cell < cell_count; ++cell) {
        turns.push_back((1 / std::max(around[cell], 1.0)) * Vector3d{x[cell], y[cell], z[cell]});
    }
    expect_turning(tissue, turns);
}

/// Collision of section 4.2, k xₒⁿ with n = 1, and adhesion, of row 7.
TEST_F(CellPrograms, CollideAndAdhere) {
    HandMadeTissue tissue = cells_of("solid", {{"stiffness", 10}, {"grip", 0.2}});
    std::vector<Vector3d> expected(cell_count);
    for (std::size_t i = 0; i < cell_count; ++i) {
        for (std::size_t j = 0; j < cell_count; ++j) {
            if (i == j) continue;
            const Vector3d way = tissue.vector("p", j) - tissue.vector("p", i);
            const double radii = tissue.values("r")[i] + tissue.values("r")[j];
            const double gap = length(way) - radii;
            double pull = 0;
            if (gap < 0) pull = 10 * gap;
            else if (length(way) < default_reach * radii) pull = 0.2 * gap;
            expected[i] = expected[i] + (pull / length(way)) * way;
        }
    }
    expect_rates(tissue, "p", expected);
}

TEST_F(CellPrograms, DivideUntilTheSurfaceIsCovered) {
    HandMadeTissue tissue = cells_of("covering", {{"full", 4}});
    fill(tissue.values("ripe"), 24, 1, 1);
    const Values crowd = touching(tissue, [&](auto i, auto j) {
        const double radii = tissue.values("r")[i] + tissue.values("r")[j];
        const double overlap = std::max(0.0, radii - distance_of(tissue, i, j));
        return contact_of(tissue, i, j) + 2 * overlap / tissue.values("r")[j];
    });
    Values expected;
    for (std::size_t cell = 0; cell < cell_count; ++cell) {
        expected.push_back(2 * (1 - phi(4, crowd[cell])) - tissue.values("ripe")[cell]);
    }
    expect_near(tissue.rate("ripe"), expected);
    const Formula& divide = tissue.program().system_of(tissue.stage()).cells->divide;
    const Values divides = tissue.run(plan_view(tissue.program(), divide, tissue.stage()))[0];
    for (std::size_t cell = 0; cell < cell_count; ++cell) {
        EXPECT_EQ(divides[cell] != 0, tissue.values("ripe")[cell] > 1) << cell;
    }
}

TEST_F(CellPrograms, TakeTheSizeOfFeatures) {
    HandMadeTissue tissue = cells_of("sized", {{"scale", 1}, {"least", 0.005}, {"most", 0.05}});
    Values expected;
    for (std::size_t cell = 0; cell < cell_count; ++cell) {
        const double feature = tissue.sensed(ModelPlane::feature)[cell];
        expected.push_back(std::min(0.05, std::max(0.005, feature)) - tissue.values("r")[cell]);
    }
    expect_near(tissue.rate("r"), expected);
}

TEST_F(CellPrograms, BecomeOneOfTwoKinds) {
    HandMadeTissue tissue = cells_of("switching");
    fill(tissue.values("a0"), 25, 0.5, 0.5);
    fill(tissue.values("a1"), 26, 0.5, 0.5);
    fill(tissue.values("a2"), 27, 1, 0.5);
    fill(tissue.values("c0"), 28, 5, 5);
    const auto value = [&](const char* name, std::size_t cell) {
        return tissue.values(name)[cell];
    };
    // The bound amounts: Λ of a0 with a1, and of a2 with a2.
    const Values of_a0 = touching(tissue, [&](auto i, auto j) {
        return contact_of(tissue, i, j) * value("a0", i) * value("a1", j);
    });
    const Values of_a2 = touching(tissue, [&](auto i, auto j) {
        return contact_of(tissue, i, j) * value("a2", i) * value("a2", j);
    });
    Values c0, a0, a1, a2;
    for (std::size_t cell = 0; cell < cell_count; ++cell) {
        const double heard = of_a0[cell] / std::max(of_a2[cell], 0.01), c = value("c0", cell);
        c0.push_back(-20 * heard + 10 * c * c / (1 + c * c) - 0.5 * c + 13);
        a1.push_back(0.95 * heard + phi(3, c) * c - value("a1", cell));
        a0.push_back(0.3 - value("a0", cell));
        a2.push_back(1 - value("a2", cell));
    }
    expect_near(tissue.rate("c0"), c0, 1e-11);
    expect_near(tissue.rate("a1"), a1, 1e-11);
    expect_near(tissue.rate("a0"), a0);
    expect_near(tissue.rate("a2"), a2);
}

}  // namespace
}  // namespace cascade::test

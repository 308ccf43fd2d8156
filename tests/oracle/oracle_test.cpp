// Compares the program with the oracle: a hundred steps of every system from the program's own
// starting values, on planes and lines, with both kinds of sides, with varying parameters and
// frozen cells.
#include "tests/oracle/oracle.h"
#include "tests/oracle/test_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace cascade {
namespace {

using Solver = void (*)(const oracle::Surface&, oracle::State&, int);

/// A system of the oracle.
struct KnownSystem {
    const char* name;
    Solver solve;
};

constexpr KnownSystem known_systems[] = {{"turing_spots", oracle::turing_spots},
                                         {"autocatalysis", oracle::autocatalysis},
                                         {"stripes", oracle::stripes},
                                         {"gray_scott", oracle::gray_scott}};

Solver solver_of(const std::string& system) {
    for (const KnownSystem& known : known_systems) {
        if (known.name == system) return known.solve;
    }
    return nullptr;
}

oracle::State state_of(const TestRun& run, std::uint32_t stage) {
    oracle::State state;
    const System& system = run.program().system_of(stage);
    for (const ItemId item : system.items()) {
        const std::string name(system.item_name(item));
        state[name] = run.values(stage, name);
    }
    return state;
}

/// The largest difference divided by the range of the expected values. The rounding errors of a
/// nearly flat field are in proportion to its values, so the range counts as at least a tenth of
/// the largest magnitude.
double relative_difference(const std::vector<double>& actual, const std::vector<double>& expected) {
    double largest = 0, magnitude = 0;
    for (std::size_t cell = 0; cell < expected.size(); ++cell) {
        const double difference = std::abs(actual[cell] - expected[cell]);
        if (!(difference <= largest)) largest = difference;  // A difference of NaN is kept.
        magnitude = std::max(magnitude, std::abs(expected[cell]));
    }
    const auto [low, high] = std::minmax_element(expected.begin(), expected.end());
    return largest / std::max(*high - *low, 0.1 * magnitude);
}

/// The oracle computes in binary64. In single precision the program rounds in each of the hundred
/// steps.
double tolerance(Precision precision) { return precision == Precision::single ? 1e-4 : 1e-12; }

/// Starts and finishes a stage, and compares it with the oracle's result for the same start.
void compare_stage(TestRun& run, std::uint32_t stage, const std::string& what) {
    run.start(stage);
    ASSERT_TRUE(run.ok()) << what;
    const Grid& grid = run.program().domain.grid;
    const oracle::Surface surface{run.width(), run.height(), grid.boundary == Boundary::periodic};
    const System& system = run.program().system_of(stage);
    const auto steps = static_cast<int>(run.program().stages[stage].iterations);
    oracle::State expected = state_of(run, stage);
    const oracle::State start = expected;
    solver_of(system.name)(surface, expected, steps);
    run.finish(stage);
    ASSERT_TRUE(run.ok()) << what;
    for (const Quantity& quantity : system.quantities) {
        if (!quantity.is_species) continue;
        const std::vector<double> actual = run.values(stage, quantity.name);
        EXPECT_LT(relative_difference(actual, expected.at(quantity.name)),
                  tolerance(run.program().domain.precision))
            << what << ", stage " << stage + 1 << ", " << quantity.name;
        if (steps > 0) {
            EXPECT_NE(start.at(quantity.name), expected.at(quantity.name))
                << what << " stood still";
        }
    }
}

constexpr const char* turing_stage = R"(
stage test: turing_spots {
  iterations: 100
  frozen: disc(0.3, 0.4, 0.2)
  speed: 0.5
  a: random(4, 3)
  b: random(2, 2)
  diff_a: random(1/4, 1/16)
  diff_b: 1/32 + 1/32 * x
  beta: random(12, 3)
  ka: 1/40 + 1/40 * y
}
)";

constexpr const char* autocatalysis_stage = R"(
stage test: autocatalysis {
  iterations: 100
  frozen: random(0, 1) > 0.9
  speed: random(0.8, 0.2)
  p3: 0.001 * x
  a: random([p2] / [p1], 0.5)
  b: random(0.4, 0.1)
  diff1: 0.01 + 0.02 * x
  s: 0.3 + x
}
)";

constexpr const char* stripes_stage = R"(
stage test: stripes {
  iterations: 100
  frozen: x > 0.7 and x < 0.8
  a: random(0.75, 0.3)
  b: random(0.75, 0.3)
  c: random(0.15, 0.05)
  d: random(0.75, 0.1)
  e: [d]
  ai: random(1, 0.2)
  diff1: 0.04
  diff2: 0.06 + 0.02 * y
}
)";

constexpr const char* gray_scott_stage = R"(
system gray_scott {
  u: 1 - 0.5 * disc(0.5, 0.5, 0.2)
  v: 0.25 * disc(0.5, 0.5, 0.2) + random(0.05, 0.05)
  feed: 0.02 + 0.03 * x
  kill: 0.06
  diff_u: 0.16
  diff_v: 0.08
  rate = u * v^2
  u' = diff_u * lap(u) - rate + feed * (1 - u)
  v' = diff_v * lap(v) + rate - (feed + kill) * v
}
stage test: gray_scott {
  iterations: 100
  frozen: disc(0.9, 0.1, 0.15)
}
)";

class OracleTest : public testing::TestWithParam<std::string_view> {
protected:
    void SetUp() override {
        if (GetParam() == "jit" && !is_available("jit")) GTEST_SKIP() << "built without a JIT";
    }
    SimulationOptions options() const {
        SimulationOptions options;
        options.backend = GetParam();
        options.threads = 2;
        return options;
    }
    void compare_on(const std::string& grid, const std::string& boundary, Precision precision,
                    const std::string& stage) {
        const std::string domain = "domain { " + grid + "; boundary: " + boundary +
                                   "; seed: 5; precision: " + std::string(name_of(precision)) +
                                   " }\n";
        TestRun run("test.cascade", domain + stage, {}, options());
        if (run.ok()) compare_stage(run, 0, domain);
    }
    void compare(const std::string& stage) {
        for (const Precision precision : {Precision::single, Precision::binary64}) {
            for (const char* grid : {"grid: 40, 27", "grid: 75", "grid: 1, 33"}) {
                for (const char* boundary : {"periodic", "noflux"}) {
                    compare_on(grid, boundary, precision, stage);
                }
            }
        }
    }
};

TEST_P(OracleTest, TuringSpots) { compare(turing_stage); }
TEST_P(OracleTest, Autocatalysis) { compare(autocatalysis_stage); }
TEST_P(OracleTest, Stripes) { compare(stripes_stage); }
TEST_P(OracleTest, GrayScott) { compare(gray_scott_stage); }

TEST_P(OracleTest, AHundredStepsOfEveryRecipe) {
    for (const char* name :
         {"autocatalytic_spots", "broken_lines", "bumpy_stripes", "cheetah", "eroded_stripes",
          "honeycomb", "leopard", "lionfish", "mixed_spots", "plates", "small_spots", "squirrel",
          "thin_lines", "vary_spots", "wide_spots"}) {
        Overrides overrides;
        overrides.steps = 100;
        const std::string file = std::string("examples/") + name + ".cascade";
        TestRun run(file, source_file(file), overrides, options());
        for (std::uint32_t stage = 0; run.ok() && stage < run.program().stages.size(); ++stage) {
            compare_stage(run, stage, name);
        }
    }
}

/// The number u of spec/random.md, in (−1, 1).
double symmetric_number(const std::string& key_text, std::uint32_t column, std::uint32_t row,
                        std::uint32_t draw) {
    std::uint64_t key = 0xcbf29ce484222325;
    for (const char byte : key_text) {
        key = (key ^ static_cast<unsigned char>(byte)) * 0x100000001b3;
    }
    std::uint32_t x = column, y = row;
    std::uint32_t z = draw ^ static_cast<std::uint32_t>(key >> 32);
    std::uint32_t w = static_cast<std::uint32_t>(key);
    for (std::uint32_t* word : {&x, &y, &z, &w}) *word = *word * 1664525 + 1013904223;
    for (const bool last : {false, true}) {
        x += y * w;
        y += z * x;
        z += x * y;
        w += y * z;
        if (last) break;
        for (std::uint32_t* word : {&x, &y, &z, &w}) *word ^= *word >> 16;
    }
    return (static_cast<double>(x >> 9) + 0.5) / (1 << 22) - 1;
}

TEST(RandomNumbers, AreThoseOfTheSpecification) {
    const char* script = R"(
domain { grid: 9, 7; seed: 12 }
system noisy {
  c: random(1, 0.5) * 0
  kick = 0 * random(0, 1) + random(0, 1)
  c' = kick
}
stage first: noisy { iterations: 2 }
system_name: turing_spots
iterations: 0
beta: random(12, random(0, 2)) + random(0, 3)
)";
    TestRun run("noisy.cascade", script, {}, on_fastest_backend());
    run.finish_all();
    ASSERT_TRUE(run.ok());
    const auto kicked = run.values(0, "c"), beta = run.values(1, "beta");
    for (std::uint32_t j = 0; j < 7; ++j) {
        for (std::uint32_t i = 0; i < 9; ++i) {
            const auto u = [&](const char* occurrence, std::uint32_t draw = 0) {
                return symmetric_number(occurrence, i, j, draw);
            };
            const std::size_t cell = j * 9 + i;
            const std::uint32_t one = 0x3f800000;  // The second step has the number 1.0f.
            EXPECT_NEAR(kicked[cell], u("12\nfirst\nkick\n2\n") + u("12\nfirst\nkick\n2\n", one),
                        1e-6);
            EXPECT_NEAR(beta[cell],
                        12 + 2 * u("12\nstage2\nbeta\n1\n") * u("12\nstage2\nbeta\n2\n") +
                            3 * u("12\nstage2\nbeta\n3\n"),
                        2e-6);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Backends, OracleTest, testing::Values("interp", "jit"),
                         [](const auto& parameter) {
                             return parameter.param == "jit" ? "jit" : "interpreter";
                         });

}  // namespace
}  // namespace cascade

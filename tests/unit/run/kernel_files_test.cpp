// Kernels of convolutions that come from files.
#include "run_fixture.h"

#include "run/simulation/simulation.h"
#include "support/kernel_comparison.h"

#include <array>
#include <cmath>

namespace cascade::test {
namespace {

constexpr const char* lags =
    "fn lag_x() = distance * direction.x\nfn lag_y() = distance * direction.y\n"
    "fn stencil(n) = field(\"k.npy\", 0.5 + lag_x() / n, 0.5 + lag_y() / n)\n";

class KernelFiles : public RunTest {
protected:
    /// Writes an array whose elements are value(column, row).
    template <typename Value>
    void write(const std::string& name, std::int64_t columns, std::int64_t rows, Value value) {
        Field field{PlaneLayout(Grid{columns, rows})};
        for (std::int64_t j = 0; j < rows; ++j) {
            for (std::int64_t i = 0; i < columns; ++i)
                field.row(j)[i] =
                    static_cast<float>(value(static_cast<double>(i), static_cast<double>(j)));
        }
        EXPECT_TRUE(write_file(path(name), encode_npy(field)));
    }

    struct Grown {
        Script script;
        std::unique_ptr<Simulation> simulation;
        const Field& species(std::size_t number) const {
            return simulation->state(0).species()[number];
        }
    };

    /// Runs the first stage.
    std::unique_ptr<Grown> grown(const std::string& text, std::string_view backend = "interp") {
        auto result = std::make_unique<Grown>(Grown{load(text), nullptr});
        EXPECT_TRUE(result->script.program) << result->script.messages(false);
        if (!result->script.program) return nullptr;
        auto made = Simulation::create(result->script, {backend, 0, 1});
        EXPECT_TRUE(made) << result->script.messages(false);
        if (!made) return nullptr;
        result->simulation = std::move(*made);
        RunControl control;
        EXPECT_TRUE(result->simulation->start_stage(0));
        const std::int64_t last = result->script.program->stages[0].iterations;
        EXPECT_TRUE(result->simulation->advance_stage(0, last, control, {}));
        return result;
    }

    static double largest_difference(const Field& a, const Field& b) {
        double largest = 0;
        for (std::int64_t j = 0; j < a.layout().height; ++j) {
            for (std::int64_t i = 0; i < a.layout().width; ++i)
                largest = std::max(largest, std::abs(a.number_at(i, j) - b.number_at(i, j)));
        }
        return largest;
    }

    std::string said(const std::string& text) {
        Script script = load(text);
        const auto made = Simulation::create(script, {"interp", 0, 1});
        return made ? "" : made.error().message + "\n" + script.messages(false);
    }
};

TEST_F(KernelFiles, AnElementWeightsTheCellOnWhichItLies) {
    const std::array<std::array<double, 3>, 3> weights{{{1, 2, 4}, {8, 16, 32}, {64, 128, 256}}};
    write("k.npy", 3, 3, [&](double i, double j) {
        return weights[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)];
    });
    const auto run = grown(std::string(lags) +
                           "system s { u: if(disc(0.5, 0.5, 0.05) > 0, 1, 0)\n"
                           "  w: 0\n  u' = 0\n  w' = convolve(stencil(3), u, 1.5) }\n"
                           "domain { grid: 9, 9 }\nstage a: s { iterations: 1 }\n");
    ASSERT_TRUE(run);
    EXPECT_EQ(run->species(0).number_at(4, 4), 1);
    // One cell has a value. The cell to the left of it finds this value to its right.
    for (std::int64_t j = 0; j < 3; ++j) {
        for (std::int64_t i = 0; i < 3; ++i) {
            EXPECT_NEAR(run->species(1).number_at(5 - i, 5 - j),
                        weights[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)], 1e-3);
        }
    }
    EXPECT_NEAR(run->species(1).number_at(2, 4), 0, 1e-4);
}

TEST_F(KernelFiles, ATableOverTheDistanceIsAsGoodAsItsFormula) {
    write("k.npy", 400, 1,
          [](double i, double) { return std::exp(-std::pow((i + 0.5) / 40, 2) / 8); });
    const auto run = grown(
        "system s { u: random(1, 0.5)\n  v: 0\n  w: 0\n  reach: 10\n  u' = 0\n"
        "  v' = convolve(field(\"k.npy\", distance / 10, 0.5), u, reach)\n"
        "  w' = convolve(exp(-distance^2 / 8), u, reach) }\n"
        "domain { grid: 48, 40; boundary: noflux; spacing: 1/2 }\nstage a: s { iterations: 1 }\n");
    ASSERT_TRUE(run);
    EXPECT_GT(run->species(2).number_at(24, 20), 10);
    EXPECT_LT(largest_difference(run->species(1), run->species(2)), 5e-3);
}

TEST_F(KernelFiles, AreTheSameInWiderCellsAndInNativeCode) {
    write("k.npy", 41, 41, [](double i, double j) {
        return std::exp(-(std::pow(i - 20, 2) + 2 * std::pow(j - 20, 2)) / 72);
    });
    const std::string system = std::string(lags) +
                               "system s { u: 1 + 0.5 * sin(2 * pi * sx)\n  u' = 0.002 * "
                               "convolve(stencil(41), u, 20) - 0.1 * u }\n";
    const std::string plain =
        system + "domain { grid: 64, 32 }\nstage a: s { iterations: 4; speed: 0.1 }\n";
    const auto expected = grown(plain);
    const auto native = grown(plain, fastest_backend().name);
    const auto wide = grown(system +
                            "domain { grid: 128, 64; spacing: 1/2 }\n"
                            "stage a: s { grid: coarse(2); iterations: 4; speed: 0.1 }\n");
    ASSERT_TRUE(expected && native && wide);
    EXPECT_EQ(same_bits(expected->simulation->state(0).species(),
                        native->simulation->state(0).species()),
              "");
    EXPECT_EQ(same_bits(expected->simulation->state(0).species(),
                        wide->simulation->state(0).species()),
              "");
}

TEST_F(KernelFiles, FaultsAreSaidAtTheText) {
    const std::string text =
        "system s { u: 1; u' = convolve(field(\"k.npy\", distance, 0.5), u) }\n"
        "domain { grid: 16, 16 }\nstage a: s { iterations: 1 }\n";
    EXPECT_NE(said(text).find("'k.npy'"), std::string::npos);
    write_file(path("k.npy"), "no array");
    EXPECT_NE(said(text).find("cannot read 'k.npy'"), std::string::npos);
    const Script sized = load(text + "stage b: s { size: 8 }\n");
    EXPECT_NE(sized.messages(false).find("has a kernel from a file"), std::string::npos);
}

}  // namespace
}  // namespace cascade::test

// Runs in double precision: what they have in common with runs in single precision, and what single
// precision is too coarse to show.
#include "resumed_run.h"

#include "run/simulation/simulation.h"
#include "run/stage/memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cascade {
namespace {

/// A script run to its end.
class Finished {
public:
    Finished(const std::string& text, Precision precision, std::string_view backend = "interp") {
        Overrides overrides;
        overrides.precision = precision;
        script_ = load_script("test", text, ".", overrides);
        EXPECT_TRUE(script_.program) << script_.messages(false) << text;
        simulation_ = Simulation::create(script_, {backend, 0, 2}).value();
        RunControl control;
        for (std::uint32_t k = 0; k < script_.program->stages.size(); ++k) {
            EXPECT_TRUE(simulation_->start_stage(k)) << text;
            const auto end = simulation_->advance_stage(k, script_.program->stages[k].iterations,
                                                        control, nullptr);
            EXPECT_TRUE(end) << (end ? "" : end.error().message);
        }
    }

    /// The first species of the last stage.
    std::vector<double> species() const {
        const auto last = static_cast<std::uint32_t>(script_.program->stages.size() - 1);
        std::vector<double> values;
        simulation_->state(last).species()[0].visit([&](const auto& plane) {
            for (std::int64_t j = 0; j < plane.layout().row_count(); ++j) {
                values.insert(values.end(), plane.row(j), plane.row(j) + plane.layout().width);
            }
        });
        return values;
    }
    double sum() const {
        double sum = 0;
        for (const double value : species()) sum += value;
        return sum;
    }
    const Program& program() const { return *script_.program; }
    const Simulation& simulation() const { return *simulation_; }

private:
    Script script_;
    std::unique_ptr<Simulation> simulation_;
};

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double largest = 0;
    for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, std::abs(a[k] - b[k]));
    return largest;
}

TEST(Precision, DoubleGrowsThePatternOfSingle) {
    const std::string text = R"(
domain { grid: 40, 30 }
stage spots: turing_spots { iterations: 100; a: random(4, 1); beta: random(12, 0.1) }
)";
    const auto rough = Finished(text, Precision::single).species();
    const auto fine = Finished(text, Precision::binary64).species();
    EXPECT_LT(largest_difference(rough, fine), 1e-3);
    EXPECT_GT(largest_difference(rough, fine), 0);
    const auto has_more_digits = [](double value) { return static_cast<float>(value) != value; };
    EXPECT_GT(std::count_if(fine.begin(), fine.end(), has_more_digits), 1000);
}

TEST(Precision, NoiseOfStepsIsThatOfSingle) {
    const std::string text = R"(
domain { grid: 30, 20, 4; boundary: noflux }
system noisy {
  u: noise(0.3, 2) + lattice(0.2, 0.05, 0.03)
  u' = 0.1 * lap(u) + white(0.01) + random(0, 0.1) + normal(0, 0.1)
}
stage one: noisy { iterations: 5 }
)";
    EXPECT_LT(largest_difference(Finished(text, Precision::single).species(),
                                 Finished(text, Precision::binary64).species()),
              1e-5);
}

/// The error in the decay of a cosine in a row of cells, whose factor per unit of time is known.
double error_of_decay(const char* solver, int steps) {
    const std::string text = fmt::format(R"(
domain {{ grid: 32; precision: double }}
system heat {{
  u: cos(2 * pi * sx)
  u' = 0.3 * lap(u)
}}
stage one: heat {{ solver: {}; speed: 8 / {}; iterations: {} }}
)",
                                         solver, steps, steps);
    const Finished run(text, Precision::binary64);
    const double rate = 0.3 * (2 * std::cos(2 * std::numbers::pi / 32) - 2);
    const double exact = std::exp(8 * rate) * std::cos(2 * std::numbers::pi * 0.5 / 32);
    return std::abs(run.species()[0] - exact);
}

// In single precision the error of rk4 would be lost in rounding at once.
TEST(Precision, OrdersOfSolversDownToTheLastDigits) {
    EXPECT_NEAR(std::log2(error_of_decay("euler", 64) / error_of_decay("euler", 128)), 1, 0.02);
    EXPECT_NEAR(std::log2(error_of_decay("rk2", 64) / error_of_decay("rk2", 128)), 2, 0.02);
    const double coarse = error_of_decay("rk4", 16), fine = error_of_decay("rk4", 32);
    EXPECT_NEAR(std::log2(coarse / fine), 4, 0.1);
    EXPECT_LT(fine, 1e-9);
    EXPECT_LT(error_of_decay("rk4", 512), 1e-13);
}

TEST(Precision, SidesAndFluxesKeepWhatTheyKeep) {
    const std::string text = R"(
domain { grid: 40, 30; boundary: noflux; precision: double }
system phases {
  c: random(0, 0.5)
  c' = lap(c^3 - c - 0.5 * lap(c)) + div((1 + c^2) * grad(c)) * 0.1
}
stage one: phases { iterations: 400; speed: 0.02 }
)";
    std::string before = text;
    before.replace(before.find("400"), 3, "0");
    const double sum = Finished(before, Precision::binary64).sum();
    EXPECT_NEAR(Finished(text, Precision::binary64).sum(), sum, 1e-11);
    // A fixed value at the left and a flux at the right: u = 1 + 0.25 x at rest.
    const Finished rest(R"(
domain { grid: 16; precision: double }
system heat {
  u: 1
  u' = 0.4 * lap(u)
  u.left: fixed(1)
  u.right: slope(0.25)
}
stage one: heat { iterations: 20000 }
)",
                        Precision::binary64);
    const auto values = rest.species();
    for (std::size_t i = 0; i < values.size(); ++i) {
        EXPECT_NEAR(values[i], 1 + 0.25 * (static_cast<double>(i) + 0.5), 1e-11);
    }
}

TEST(Precision, TakesTwiceTheMemory) {
    const std::string text = "domain { grid: 64, 64 }\nstage s: turing_spots { iterations: 0 }\n";
    EXPECT_EQ(memory_of(Finished(text, Precision::binary64).program()),
              2 * memory_of(Finished(text, Precision::single).program()));
}

#if CASCADE_HAS_JIT
TEST(Precision, NativeCodeComputesTheBitsOfTheInterpreter) {
    const std::string text = R"(
domain { grid: 53, 21; boundary: noflux }
stage one: turing_spots {
  iterations: 60
  frozen: disc(0.5, 0.2, 0.1)
  a: random(4, 1)
  beta: 12 + exp(-x) * sin(20 * y) + 0.1 * x^0.3
}
)";
    EXPECT_EQ(Finished(text, Precision::binary64).species(),
              Finished(text, Precision::binary64, "jit").species());
}
#endif

class PrecisionTest : public ResumedRunTest {};

TEST_F(PrecisionTest, ASavedRunGoesOnWithTheSameBits) {
    Overrides overrides;
    overrides.precision = Precision::binary64;
    run_whole(two_stages, overrides);
    run_in_two_parts(two_stages, "small", 77, overrides);
    EXPECT_NE(bytes("whole/small.b.npy").find("'<f8'"), std::string::npos);
    EXPECT_EQ(bytes("whole/small.b.npy"), bytes("rest/small.b.npy"));
    EXPECT_EQ(bytes("whole/large.beta.npy"), bytes("rest/large.beta.npy"));
    overrides.precision = Precision::single;
    EXPECT_FALSE(load_saved_script(path("part"), overrides));
}

TEST_F(PrecisionTest, FilesAreReadWithAllTheirDigits) {
    Plane<double> plane{PlaneLayout(Grid{4, 3})};
    for (std::int64_t j = 0; j < 3; ++j) {
        for (std::int64_t i = 0; i < 4; ++i) {
            plane.at(i, j) = 1 + 0x1p-40 * static_cast<double>(4 * j + i);
        }
    }
    ASSERT_TRUE(write_npy(path("start.npy"), Field(std::move(plane))));
    Script script = load(R"(
domain { grid: 4, 3; precision: double }
system still { u: field("start.npy"); u' = 0 }
stage one: still { iterations: 1 }
)");
    RunRequest wanted = request();
    wanted.save = path("saved");
    wanted.log.expressions = {"max(u over domain)"};
    wanted.log.file = path("log.csv");
    run_well(script, wanted);
    EXPECT_EQ(array<double>("saved/one.u.npy"), array<double>("start.npy"));
    EXPECT_NE(bytes("log.csv").find("1.00000000001"), std::string::npos) << bytes("log.csv");
}

TEST_F(PrecisionTest, PicturesCarryTheirPrecision) {
    Overrides overrides;
    overrides.precision = Precision::binary64;
    Script script = load(two_stages, overrides);
    run_well(script, request());
    const auto again = load_script_file(path("picture.png"));
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->script.program->domain.precision, Precision::binary64);
}

}  // namespace
}  // namespace cascade

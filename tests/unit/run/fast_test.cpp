// Runs with --fast: their bits differ from the bits of other runs, but are the same with any number
// of threads and after the run was resumed.
#include "resumed_run.h"

#include "ir/multiply_add.h"
#include "run/script/embedded_script.h"

#include <algorithm>
#include <cmath>

namespace cascade {
namespace {

/// A script with products and sums, a division by a value that is the same in all cells, functions,
/// a direction that no step changes, and an operator inside another.
constexpr const char* mixed = R"(
system mixed {
  speed: 0.05
  u: 0.5 + random(0.2, 0.1)
  v: 0.3 + 0.1 * sin(9 * sx)
  size: 0.7
  turn: sx * sy
  u' = div(tensor(1, 0.3, turn) * grad(u)) + v * u - u^3 / size + 0.1 * exp(-u / size)
  v' = lap(v * u - 0.2 * lap(v)) / 5 + sin(turn) * (u - v) - 0.3 * v
}
domain { grid: 37, 29; seed: 3 }
stage only: mixed { iterations: 60; interval: 20 }
)";

class FastTest : public ResumedRunTest {
protected:
    void SetUp() override {
        RunTest::SetUp();
        if (!has_multiply_add()) GTEST_SKIP() << "this processor has no multiply-add";
        fast_.fast = true;
    }

    /// Runs the script, and saves the run in a folder of the test.
    void save(const std::string& name, const Overrides& overrides,
              const SimulationOptions& simulation = {"interp", 0, 1}) {
        Script script = load(mixed, overrides);
        RunRequest wanted = request();
        wanted.simulation = simulation;
        wanted.save = path(name);
        run_well(script, wanted);
    }

    void expect_same(const std::string& first, const std::string& second) {
        for (const char* name : {"/only.u.npy", "/only.v.npy"}) {
            ASSERT_FALSE(bytes(first + name).empty());
            EXPECT_EQ(bytes(first + name), bytes(second + name)) << second << name;
        }
    }

    Overrides fast_;
};

TEST_F(FastTest, RoundsOtherwiseAndStaysNear) {
    save("strict", {});
    save("fast", fast_);
    for (const char* name : {"/only.u.npy", "/only.v.npy"}) {
        const std::vector<float> strict = array(std::string("strict") + name),
                                 fast = array(std::string("fast") + name);
        ASSERT_EQ(strict.size(), fast.size());
        float largest = 0;
        for (std::size_t k = 0; k < fast.size(); ++k) {
            largest = std::max(largest, std::fabs(strict[k] - fast[k]));
        }
        EXPECT_GT(largest, 0) << name;
        EXPECT_LT(largest, 1e-5f) << name;
    }
}

TEST_F(FastTest, BeginsAtTheSameValues) {
    Overrides none;
    none.steps = fast_.steps = 0;
    save("strict", none);
    save("fast", fast_);
    expect_same("strict", "fast");
}

TEST_F(FastTest, HasTheSameBitsHoweverItIsComputed) {
    for (const Precision precision : {Precision::single, Precision::binary64}) {
        fast_.precision = precision;
        save("one", fast_);
        save("two", fast_, {"interp", 0, 2});
        expect_same("one", "two");
        if (!is_available("jit")) continue;
        for (const int lanes : {4, 8, 16}) {
            for (const int threads : {1, 2}) {
                save("native", fast_, {"jit", lanes, threads});
                expect_same("one", "native");
            }
        }
    }
}

TEST_F(FastTest, GoesOnWhenItIsResumed) {
    run_whole(mixed, fast_);
    run_in_two_parts(mixed, "only", 31, fast_);
    expect_same("whole", "rest");
    EXPECT_FALSE(load_saved_script(path("part"), fast_)) << "a resumed run keeps its rounding";
}

TEST_F(FastTest, TravelsInPictures) {
    EXPECT_EQ(overrides_from_json(overrides_to_json(fast_)).value(), fast_);
    EXPECT_EQ(overrides_to_json({}).find("fast"), std::string::npos);
    EXPECT_TRUE(merge(fast_, {}).fast);
    EXPECT_TRUE(merge({}, fast_).fast);
}

}  // namespace
}  // namespace cascade

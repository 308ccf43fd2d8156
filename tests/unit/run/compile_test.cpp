// `cascade compile`: a C program that links the object file gets the bits of `cascade run`.

#include "run_fixture.h"

#include "ir/multiply_add.h"
#include "run/emit_c/compile.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <cstring>

#if CASCADE_HAS_JIT

namespace cascade {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A C program that starts the stage `$`, takes argv[1] steps and writes all species. SET is
/// replaced by what the program sets before the start.
constexpr const char* c_program = R"(
#include "step.h"
#include <stdio.h>
#include <stdlib.h>

static void load(float *plane, const char *name) {
    /* The data of an .npy file are its last numbers. */
    FILE *file = fopen(name, "rb");
    int j;
    if (!file || fseek(file, -(long)($$_WIDTH * $$_HEIGHT * sizeof(float)), SEEK_END)) exit(1);
    for (j = 0; j < $$_HEIGHT; ++j)
        if (fread(plane + $_at(0, j, 0), sizeof(float), $$_WIDTH, file) != $$_WIDTH) exit(1);
    fclose(file);
}

int main(int argc, char **argv) {
    struct $ s;
    void *memory = malloc($$_BYTES);
    size_t species;
    int j, k;
    if (argc < 2 || !memory) return 1;
    $_init(&s, memory);
    (void)load;
    SET
    $_start(&s);
    $_run(&s, atoi(argv[1]));
    for (species = 0; species < sizeof s.species / sizeof *s.species; ++species)
        for (k = 0; k < $$_DEPTH; ++k)
            for (j = 0; j < $$_HEIGHT; ++j)
                fwrite(s.species[species] + $_at(0, j, k), sizeof(float), $$_WIDTH, stdout);
    free(memory);
    return 0;
}
)";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size()) {
        text.replace(at, what.size(), by);
    }
    return text;
}

class CompileTest : public RunTest {
protected:
    /// Compiles a stage and the program around it.
    void build(const std::string& text, const CompileRequest& request, const std::string& set = "",
               const std::string& flags = "-std=c99 -pedantic") {
        Script script = load(text, overrides_);
        const auto step = compile_step(script, request);
        ASSERT_TRUE(step) << step.error().message << script.messages(false);
        ASSERT_TRUE(write_file(path("step.o"), {reinterpret_cast<const char*>(step->object.data()),
                                                step->object.size()}));
        ASSERT_TRUE(write_file(path("step.h"), step->header));
        const std::string stage = request.stage.value_or("only");
        std::string program =
            replaced(c_program, "$$", "TEST_" + std::string(stage == "only" ? "ONLY" : "SMALL"));
        program = replaced(replaced(program, "$", "test_" + stage), "SET", set);
        ASSERT_TRUE(write_file(path("main.c"), program));
        ASSERT_EQ(command("cc -Wall -Wextra -Werror -O1 " + flags + " main.c step.o -o program"),
                  0);
    }

    int command(const std::string& text) {
        return std::system(("cd '" + folder_.string() + "' && " + text).c_str());
    }

    void save_stopped_at(const std::string& text, const std::string& stage, std::int64_t step,
                         const std::string& name) {
        Script script = load(text, overrides_);
        RunRequest wanted = request();
        wanted.save = path(name);
        wanted.stop_at = StopAt{stage, step};
        run_well(script, wanted);
    }

    /// Runs the program, and expects the bits of the run that was saved in "end".
    void expect_same_bits(const std::string& stage, const std::vector<std::string>& species,
                          const std::string& steps) {
        ASSERT_EQ(command("./program " + steps + " > out.raw"), 0);
        const std::string raw = bytes("out.raw");
        std::vector<float> expected;
        for (const std::string& name : species) {
            const auto values = array("end/" + stage + "." + name + ".npy");
            expected.insert(expected.end(), values.begin(), values.end());
        }
        ASSERT_EQ(raw.size(), expected.size() * sizeof(float));
        EXPECT_EQ(std::memcmp(raw.data(), expected.data(), raw.size()), 0);
    }

    /// Compares the program with a run. The script has one stage, `only`, whose program has to set
    /// nothing.
    void expect_bits_of_run(const std::string& text, const std::vector<std::string>& species,
                            std::optional<std::uint32_t> stages = {}) {
        save_stopped_at(text, "only", 23, "end");
        CompileRequest wanted;
        wanted.stages = stages;
        build(text, wanted);
        if (!HasFatalFailure()) expect_same_bits("only", species, "23");
    }

    Overrides overrides_;

    Failure refused(const std::string& text, const CompileRequest& request = {}) {
        Script script = load(text, overrides_);
        const auto step = compile_step(script, request);
        EXPECT_FALSE(step);
        return step ? Failure{} : step.error();
    }
};

/// C code that sets the values which the second stage of two_stages reads from the first one.
constexpr const char* load_large = R"(
    load(s.planes[TEST_SMALL_PLANE_LARGE_A], "start/large.a.npy");
    load(s.planes[TEST_SMALL_PLANE_LARGE_B], "start/large.b.npy");
    load(s.planes[TEST_SMALL_PLANE_LARGE_BETA], "start/large.beta.npy");
)";

TEST_F(CompileTest, ASecondStageGoesOnFromGivenPlanes) {
    save_stopped_at(two_stages, "small", 0, "start");
    save_stopped_at(two_stages, "small", 77, "end");
    std::vector<std::string> targets{"", "x86-64", "x86-64-v2"};
    if (__builtin_cpu_supports("avx2")) targets.emplace_back("x86-64-v3");
    if (__builtin_cpu_supports("avx512vl")) targets.emplace_back("x86-64-v4");
    for (const std::string& target : targets) {
        SCOPED_TRACE(target);
        CompileRequest wanted;
        wanted.stage = "small";
        wanted.target = target;
        build(two_stages, wanted, load_large);
        expect_same_bits("small", {"a", "b"}, "77");
    }
}

TEST_F(CompileTest, ThreadsOfOpenMpChangeNoBit) {
    save_stopped_at(two_stages, "small", 0, "start");
    save_stopped_at(two_stages, "small", 40, "end");
    CompileRequest wanted;
    wanted.stage = "small";
    build(two_stages, wanted, load_large, "-std=c99 -fopenmp");
    ASSERT_EQ(setenv("OMP_NUM_THREADS", "3", 1), 0);
    expect_same_bits("small", {"a", "b"}, "40");
    unsetenv("OMP_NUM_THREADS");
}

TEST_F(CompileTest, TwoPassesOfCahnHilliard) {
    expect_bits_of_run(R"(
system cahn_hilliard {
  c: random(0, 0.1)
  gamma: 0.5
  mu = c^3 - c - gamma * lap(c)
  c' = lap(mu)
}
domain { grid: 37, 20 }
stage only: cahn_hilliard { speed: 0.02 }
)",
                       {"c"});
}

TEST_F(CompileTest, FluxesOfChemotaxis) {
    expect_bits_of_run(R"(
system chemotaxis {
  cells: random(1, 0.01)
  bait: 1
  chi: 5
  cells' = lap(cells) - div(chi * cells * grad(bait))
  bait'  = 10 * lap(bait) + cells / (1 + cells) - bait
}
domain { grid: 21, 34; boundary: noflux }
stage only: chemotaxis { speed: 0.02 }
)",
                       {"cells", "bait"});
}

TEST_F(CompileTest, AggregatesAtTheStartAndInSteps) {
    expect_bits_of_run(R"(
system kept {
  u: random(0, 1) - 0.3 * x
  v: u * top
  top: max(u over domain)
  low: min(u over domain) + mean(u^2 over domain)
  u' = lap(u) - u^3 + mean(u^3 over domain) + 0.01 * low * sum(v over domain) / 1000
  v' = lap(v) - v * max(u over domain)
}
domain { grid: 29, 13 }
stage only: kept { speed: 0.1 }
)",
                       {"u", "v"});
}

TEST_F(CompileTest, GrayScottInThreeDimensions) {
    expect_bits_of_run(R"(
system gray_scott_3 {
  u: 1 - 0.5 * disc(0.5, 0.5, 0.5, 0.2)
  v: 0.25 * disc(0.5, 0.5, 0.5, 0.2) + random(0.01, 0.01)
  u' = 0.1 * lap(u) - u * v^2 + 0.037 * (1 - u)
  v' = 0.05 * lap(v) + u * v^2 - 0.097 * v
}
domain { grid: 18, 11, 7; boundary: periodic, noflux, noflux }
stage only: gray_scott_3 { speed: 1 }
)",
                       {"u", "v"});
}

TEST_F(CompileTest, ValuesAndFluxesAtSides) {
    expect_bits_of_run(R"(
system heat {
  begin: 0.1 * x
  u: begin
  v: 1
  hot: 1
  u' = 0.2 * lap(u) + 0.01 * v
  v' = 0.2 * lap(v) - 0.01 * u
  u.sides: noflux
  u.left: fixed(hot)
}
domain { grid: 19, 14; boundary: noflux; spacing: 1.3; right: fixed(0.25) }
stage only: heat { hot: 2; u.top: slope(0.1 * sx); v.bottom: fixed([begin] + 0.5); v.left: flux(0.1 * lap([begin] + x)) }
)",
                       {"u", "v"});
}

TEST_F(CompileTest, SidesOfVolumes) {
    expect_bits_of_run(R"(
system heat {
  u: 0.1 * x
  u' = 0.1 * lap(u)
}
domain { grid: 9, 7, 5; boundary: noflux }
stage only: heat { u.front: slope(0.1 * sy); u.back: fixed(sx); u.top: fixed(1); u.left: flux(-0.02) }
)",
                       {"u"});
}

/// A script whose diffusion has coefficients for each cell that no step changes.
constexpr const char* spots_on_torus = R"(
domain {
  grid: 36, 12
  surface: (3 + cos(2*pi*sy)) * cos(2*pi*sx), (3 + cos(2*pi*sy)) * sin(2*pi*sx), sin(2*pi*sy)
}
stage only: turing_spots { speed: 0.5; ka: 1/60 }
)";

// Values that no step changes are kept by a run, and computed again by a compiled stage.
TEST_F(CompileTest, FastSteps) {
    if (!has_multiply_add()) GTEST_SKIP() << "this processor has no multiply-add";
    overrides_.fast = true;
    expect_bits_of_run(R"(
system smear {
  c: random(0, 1)
  size: 0.7
  turn: sx * sy
  c' = div(tensor(1, 0.3, turn) * grad(c)) + lap(sin(turn) * c) - c^3 / size + exp(-turn^2) * c
}
domain { grid: 21, 34 }
stage only: smear { speed: 0.05 }
)",
                       {"c"});
    expect_bits_of_run(spots_on_torus, {"a", "b"});
    CompileRequest old;
    old.target = "x86-64";
    EXPECT_EQ(refused("stage only: turing_spots { }", old).message,
              "the processor x86-64 cannot multiply and add with one rounding, as --fast requires");
}

TEST_F(CompileTest, TheMetricOfASurface) { expect_bits_of_run(spots_on_torus, {"a", "b"}); }

constexpr const char* timed_rates = R"(
system timed {
  u: random(1, 0.2)
  v: 0.5
  u' = 0.2 * lap(u) + v * sin(t) - 0.1 * u^3
  v' = 0.1 * lap(v) + 0.01 * u - 0.001 * step * v
  u >= 0.9
}
domain { grid: 16, 12 }
stage only: timed { speed: 0.3; SOLVER }
)";

TEST_F(CompileTest, SolversOfSeveralSweeps) {
    for (const std::string solver : {"rk2", "rk4", "symplectic", "euler"}) {
        SCOPED_TRACE(solver);
        expect_bits_of_run(replaced(timed_rates, "SOLVER", "solver: " + solver), {"u", "v"});
    }
}

TEST_F(CompileTest, FrozenCellsKeepTheirValues) {
    expect_bits_of_run(replaced(timed_rates, "SOLVER", "frozen: x < 0.3; solver: rk4"), {"u", "v"});
}

// With diffusion alone, a run chooses the same number of stages throughout.
TEST_F(CompileTest, StagesOfStabilisedSolvers) {
    const std::string text = R"(
system spread {
  u: random(1, 0.2)
  k: 1 + x
  u' = k * lap(u) - 0.1 * u
}
domain { grid: 32, 24; boundary: noflux }
stage only: spread { speed: 1.5; solver: SOLVER }
)";
    for (const std::string solver : {"rkl1", "rkl2"}) {
        SCOPED_TRACE(solver);
        // The bound is (8 · 2 + 0.1) · 1.5 = 24.15. With 5 stages, rkl1 is stable up to 30, but
        // rkl2 only up to 14.
        expect_bits_of_run(replaced(text, "SOLVER", solver), {"u"}, solver == "rkl1" ? 5 : 7);
    }
}

TEST_F(CompileTest, SpeedMayVaryByCell) {
    expect_bits_of_run(
        "domain { grid: 20, 9 }\n"
        "stage only: turing_spots { speed: 0.5 + 0.4 * sx; ka: 1/80 }\n",
        {"a", "b"});
}

TEST_F(CompileTest, FilesAreInTheObject) {
    Field field(PlaneLayout(Grid{8, 4}));
    for (std::int64_t row = 0; row < 4; ++row) {
        for (std::int64_t i = 0; i < 8; ++i) field.row(row)[i] = 0.1F * static_cast<float>(i * row);
    }
    ASSERT_TRUE(write_npy(path("field.npy"), field));
    expect_bits_of_run(R"(
system fed { u: field("field.npy") * x; feed: field("field.npy"); u' = 0.1 * lap(u) + feed - u }
domain { grid: 8, 4 }
stage only: fed { speed: 0.1 }
)",
                       {"u"});
}

TEST_F(CompileTest, TheHeaderIsAlsoCxx) {
    build(two_stages, {.stage = "small"}, load_large);
    EXPECT_EQ(command("echo '#include \"step.h\"' > use.cpp && "
                      "c++ -std=c++11 -Wall -Wextra -Werror -fsyntax-only use.cpp"),
              0);
}

TEST_F(CompileTest, AParameterCanBecomeAPlane) {
    Script script = load(two_stages);
    CompileRequest wanted;
    wanted.stage = "small";
    wanted.per_cell = {"ka"};
    const auto step = compile_step(script, wanted);
    ASSERT_TRUE(step) << step.error().message;
    EXPECT_THAT(step->header, HasSubstr("    TEST_SMALL_PLANE_KA"));
    EXPECT_THAT(step->header, Not(HasSubstr("TEST_SMALL_NUMBER_KA")));
}

TEST_F(CompileTest, WrongRequestsAreRefusedInWords) {
    EXPECT_EQ(refused(two_stages, {.stage = "smal"}).message, "no stage is called 'smal'");
    EXPECT_EQ(refused(two_stages, {.stage = "2", .per_cell = {"kaa"}}).hint, "did you mean 'ka'?");
    EXPECT_NE(refused(two_stages, {.target = "pentium-of-sorts"}).message, "");
}

TEST_F(CompileTest, ModelsAreRefused) {
    EXPECT_EQ(refused("domain { surface: sphere; cells: 50 }\nstage one: turing_spots { }").message,
              "a stage on a model cannot be compiled to an object file");
}

TEST_F(CompileTest, SidesOfAnotherStageAreRefused) {
    const std::string text =
        "system s { u: x; u' = lap(u); u.left: fixed(1) }\n"
        "stage one: s { speed: 0.1 }\n"
        "domain { grid: 8, 4; boundary: noflux }\n";
    EXPECT_EQ(refused(text + "stage two: s { u: lap(one.u) }", {.stage = "two"}).message,
              "stage 'two' reads u of stage 'one' in neighbouring cells, but the sides of that "
              "stage cannot be compiled with this one");
}

TEST_F(CompileTest, StepsOfChosenLengthAreRefused) {
    const auto message = [&](const std::string& statements, const CompileRequest& wanted = {}) {
        return refused("stage only: turing_spots { " + statements + " }", wanted).message;
    };
    EXPECT_EQ(message("solver: rk23; duration: 10"),
              "stage 'only' is solved by rk23, which chooses its steps during the run, but all "
              "compiled steps have the same length");
    EXPECT_EQ(message("speed: auto; duration: 10"),
              "stage 'only' chooses its steps during the run, but all compiled steps have the same "
              "length");
    EXPECT_EQ(message("solver: rkl1; duration: 10"),
              "stage 'only' is solved by rkl1, which chooses the number of its stages as it "
              "runs, but a compiled step has a fixed number");
    EXPECT_EQ(message("", {.stages = 5}),
              "--stages: euler has no stages to choose; only rkl1 and rkl2 have stages");
}

}  // namespace
}  // namespace cascade

#endif

// The command line: how arguments are parsed, and messages about wrong arguments.
#include "app/options.h"

#include "app/exit_status.h"
#include "app/option_values.h"
#include "core/version.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace cascade {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

Options parsed(const std::vector<std::string>& arguments) {
    auto result = parse_options("cascade", arguments);
    if (const auto* leave = std::get_if<Leave>(&result)) {
        ADD_FAILURE() << leave->text;
        return {};
    }
    return std::get<Options>(std::move(result));
}

Leave left(const std::vector<std::string>& arguments) {
    auto result = parse_options("cascade", arguments);
    if (auto* leave = std::get_if<Leave>(&result)) return *leave;
    ADD_FAILURE() << "was taken for right";
    return {};
}

TEST(Options, sweep_takes_everything) {
    const Options options = parsed({"sweep",     "a.cascade",
                                    "--vary",    "gs.feed=0..1:3",
                                    "--vary",    "seed=1,2",
                                    "-o",        "all",
                                    "--tile",    "64",
                                    "--fields",  "--force",
                                    "--show",    "v",
                                    "--palette", "viridis",
                                    "--range",   "0,1",
                                    "--depth",   "16",
                                    "--threads", "3",
                                    "--lanes",   "4",
                                    "--backend", "interp",
                                    "-q",        "--set",
                                    "ka=1",      "--grid",
                                    "32x16",     "--limit-time",
                                    "1.5h",      "--limit-memory",
                                    "1.5GiB"});
    EXPECT_EQ(options.command, Command::sweep);
    EXPECT_THAT(options.scripts, ElementsAre("a.cascade"));
    ASSERT_EQ(options.sweep.varied.size(), 2U);
    EXPECT_EQ(options.sweep.varied[0].name, "gs.feed");
    EXPECT_THAT(options.sweep.varied[0].values, ElementsAre("0", "0.5", "1"));
    EXPECT_THAT(options.sweep.varied[1].values, ElementsAre("1", "2"));
    EXPECT_EQ(options.sweep.folder, "all");
    EXPECT_EQ(options.sweep.tile_side, 64);
    EXPECT_TRUE(options.sweep.fields && options.sweep.force && options.quiet);
    EXPECT_EQ(options.picture.show, "v");
    EXPECT_EQ(options.run.simulation.threads, 3);
    EXPECT_EQ(options.run.simulation.memory_limit, 1610612736U);
    EXPECT_EQ(options.limit_seconds, 5400);
    EXPECT_THAT(options.overrides.sets, ElementsAre("ka=1"));
    EXPECT_THAT(left({"sweep", "a.cascade", "--vary", "a=0..1"}).text,
                HasSubstr("the number of values"));
    EXPECT_THAT(left({"sweep", "a.cascade", "--vary", "a=1", "--scale", "2"}).text,
                HasSubstr("there is no option --scale"));
}

TEST(Options, run_takes_logs_and_limits) {
    const Options options = parsed({"run", "a.cascade", "--log", "mean(u over domain)", "--log",
                                    "t", "--log-every", "25", "--log-file", "t.csv", "--features",
                                    "--limit-time", "90", "--limit-memory", "500MB"});
    EXPECT_THAT(options.run.log.expressions, ElementsAre("mean(u over domain)", "t"));
    EXPECT_EQ(options.run.log.every, 25);
    EXPECT_EQ(options.run.log.file, "t.csv");
    EXPECT_TRUE(options.run.features);
    EXPECT_EQ(options.limit_seconds, 90);
    EXPECT_EQ(options.run.simulation.memory_limit, 500000000U);
    for (const char* wrong : {"", "0", "-1s", "5x", "1e3", "s", "99999d", "1 h"}) {
        EXPECT_EQ(left({"run", "a.cascade", "--limit-time", wrong}).status, exit_status::wrong_use)
            << wrong;
    }
    for (const char* wrong : {"", "12", "-1GB", "5gb", "GB", "1..5GB", "999999999TB"}) {
        EXPECT_EQ(left({"run", "a.cascade", "--limit-memory", wrong}).status,
                  exit_status::wrong_use)
            << wrong;
    }
    EXPECT_EQ(left({"run", "a.cascade", "--log-every", "0"}).status, exit_status::wrong_use);
}

TEST(Options, run_takes_what_models_have) {
    const Options options = parsed(
        {"run",     "a.cascade", "--mesh",  "sphere",   "--cells",     "500",         "-o",
         "a.png",   "-o",        "b.PLY",   "--output", "c.cells.vtp", "--retile",    "--bake",
         "256",     "--bump",    "-0.02",   "--up",     "z",           "--turntable", "12",
         "--cache", "kept",      "--merge", "--facing", "-x"});
    EXPECT_THAT(options.run.outputs, ElementsAre("a.png", "b.PLY", "c.cells.vtp"));
    EXPECT_TRUE(options.run.model_files.retile);
    EXPECT_TRUE(options.run.model_files.merge);
    EXPECT_EQ(options.run.model_files.bake, 256);
    EXPECT_EQ(options.run.turntable, 12);
    EXPECT_EQ(options.run.simulation.cell_cache, "kept");
    const PictureRequest picture = apply(options.picture, {});
    EXPECT_EQ(picture.bump, -0.02F);
    EXPECT_EQ(options.overrides.up, Axis::z);
    EXPECT_EQ(options.overrides.facing, (Heading{Axis::x, true}));
}

TEST(Options, pictures_of_surfaces_have_a_size_a_quality_and_a_camera) {
    const Options options =
        parsed({"run", "a.cascade", "--size", "1920x1080", "--quality", "fine", "--fov", "40",
                "--ground", "no", "--background", "none", "--light", "studio", "--displace"});
    const PictureRequest picture = apply(options.picture, {});
    EXPECT_EQ(picture.size, (PictureSize{1920, 1080}));
    EXPECT_EQ(picture.quality, Quality::fine);
    EXPECT_EQ(picture.lighting, Lighting::studio);
    EXPECT_TRUE(picture.displace);
    EXPECT_EQ(picture.fov, 40.0F);
    EXPECT_FALSE(picture.ground);
    EXPECT_FALSE(picture.background);
    const PictureRequest coloured =
        apply(parsed({"run", "a.cascade", "--background", "#00f"}).picture, picture);
    EXPECT_EQ(coloured.background, (Colour{0, 0, 1}));
    const PictureRequest stored = apply(parsed({"run", "a.png"}).picture, picture);
    EXPECT_EQ(stored.size, picture.size);
    EXPECT_EQ(stored.quality, Quality::fine);
    EXPECT_FALSE(stored.ground);
    EXPECT_FALSE(stored.background);
}

TEST(Options, run_takes_everything) {
    const Options options =
        parsed({"run",       "a.cascade", "-o",      "out.png",   "--grid",
                "32x16",     "--seed",    "7",       "--set",     "ka=1/80",
                "--set",     "s.b=2",     "--steps", "100",       "--until-stage",
                "large",     "--show",    "b - a",   "--palette", "viridis",
                "--range",   "-1,2.5",    "--scale", "4",         "--depth",
                "16",        "--threads", "3",       "--lanes",   "8",
                "--backend", "interp",    "--save",  "kept",      "--frames",
                "film",      "--sheet",   "all.png", "--stop-at", "s:50",
                "--quiet"});
    EXPECT_EQ(options.command, Command::run);
    EXPECT_THAT(options.scripts, ElementsAre("a.cascade"));
    EXPECT_THAT(options.run.outputs, ElementsAre("out.png"));
    EXPECT_EQ(options.overrides.grid, (GridSize{32, 16}));
    EXPECT_EQ(options.overrides.seed, 7U);
    EXPECT_THAT(options.overrides.sets, ElementsAre("ka=1/80", "s.b=2"));
    EXPECT_EQ(options.overrides.steps, 100);
    EXPECT_EQ(options.overrides.until_stage, "large");
    EXPECT_EQ(options.picture.show, "b - a");
    EXPECT_EQ(options.picture.palette, "viridis");
    EXPECT_EQ(apply(options.picture, {}).range, (ValueRange{-1, 2.5F}));
    EXPECT_EQ(options.picture.scale, 4);
    EXPECT_EQ(options.picture.depth, 16);
    EXPECT_EQ(options.run.simulation.threads, 3);
    EXPECT_EQ(options.run.simulation.lanes, 8);
    EXPECT_EQ(options.run.simulation.backend, "interp");
    EXPECT_EQ(options.run.save, "kept");
    EXPECT_EQ(options.run.frames, "film");
    EXPECT_EQ(options.run.sheet, "all.png");
    ASSERT_TRUE(options.run.stop_at);
    EXPECT_EQ(options.run.stop_at->stage, "s");
    EXPECT_EQ(options.run.stop_at->step, 50);
    EXPECT_TRUE(options.quiet);
}

TEST(Options, set_takes_one_value_and_leaves_the_script) {
    const Options options = parsed({"run", "--set", "ka=1/80", "a.cascade"});
    EXPECT_THAT(options.overrides.sets, ElementsAre("ka=1/80"));
    EXPECT_THAT(options.scripts, ElementsAre("a.cascade"));
}

TEST(Options, values_of_expressions_may_begin_with_a_minus) {
    EXPECT_EQ(parsed({"run", "a.cascade", "--show", "-b"}).picture.show, "-b");
    EXPECT_EQ(parsed({"run", "a.cascade", "--show=-b"}).picture.show, "-b");
}

TEST(Options, standard_input_is_a_script) {
    EXPECT_THAT(parsed({"run", "-"}).scripts, ElementsAre("-"));
}

TEST(Options, a_tiling_is_forced_where_nobody_sees_it) {
    EXPECT_EQ(parsed({"run", "a.cascade", "--tiling", "4,2"}).run.simulation.tiling,
              (Tiling{4, 2}));
    EXPECT_FALSE(parsed({"run", "a.cascade"}).run.simulation.tiling);
}

TEST(Options, a_hint_for_a_number_is_one_that_the_option_takes) {
    EXPECT_EQ(parse_whole("1e3", 1, 1024).error().hint, "write 1000");
    EXPECT_EQ(parse_whole("70000", 1, 1024).error().hint, "");
    EXPECT_EQ(parse_whole("2e3", 1, 1024).error().hint, "");
}

TEST(Options, two_hyphens_end_the_options) {
    EXPECT_THAT(parsed({"run", "--", "a.cascade"}).scripts, ElementsAre("a.cascade"));
    EXPECT_THAT(parsed({"check", "--dump", "ast", "--", "-a.cascade", "-"}).scripts,
                ElementsAre("./-a.cascade", "-"));
}

TEST(Options, what_was_not_given_leaves_a_stored_picture_alone) {
    PictureRequest stored;
    stored.palette = "magma";
    stored.scale = 3;
    stored.detail = 2;
    const PictureRequest request = apply(parsed({"run", "a.png", "--scale", "5"}).picture, stored);
    EXPECT_EQ(request.palette, "magma");
    EXPECT_EQ(request.scale, 5);
    EXPECT_EQ(request.detail, 2);
    EXPECT_EQ(apply(parsed({"run", "a.png", "--detail", "1"}).picture, stored).detail, 1);
}

TEST(Options, check_takes_many_scripts) {
    const Options options = parsed({"check", "a.cascade", "b.cascade", "--dump", "ast"});
    EXPECT_EQ(options.command, Command::check);
    EXPECT_THAT(options.scripts, ElementsAre("a.cascade", "b.cascade"));
    EXPECT_EQ(options.dump, "ast");
}

TEST(Options, compile) {
    const Options options = parsed({"compile", "a.cascade", "--stage", "2", "--per-cell", "beta,ka",
                                    "--target", "x86-64-v3", "-o", "step.o", "--header", "step.h"});
    EXPECT_EQ(options.command, Command::compile);
    EXPECT_EQ(options.compile.stage, "2");
    EXPECT_THAT(options.compile.per_cell, ElementsAre("beta", "ka"));
    EXPECT_EQ(options.compile.target, "x86-64-v3");
    EXPECT_EQ(options.object, "step.o");
    EXPECT_EQ(options.header, "step.h");
}

TEST(Options, resume_needs_no_script) {
    EXPECT_EQ(parsed({"run", "--resume", "kept"}).run.resume, "kept");
}

TEST(Options, help_goes_to_standard_output) {
    const Leave top = left({"--help"});
    EXPECT_EQ(top.status, exit_status::success);
    for (const char* command : {"run", "check", "compile", "systems", "repl"}) {
        EXPECT_THAT(top.text, HasSubstr(command));
    }
    EXPECT_THAT(top.text, HasSubstr("cascade run examples/leopard.cascade"));
    const Leave run = left({"run", "--help"});
    EXPECT_EQ(run.status, exit_status::success);
    EXPECT_THAT(run.text, HasSubstr("Usage: cascade run SCRIPT [options]"));
    EXPECT_THAT(run.text, HasSubstr("--until-stage NAME"));
    EXPECT_THAT(run.text, Not(HasSubstr("OPTIONS")));
}

TEST(Options, version) {
    const Leave version = left({"--version"});
    EXPECT_EQ(version.status, exit_status::success);
    EXPECT_THAT(version.text, testing::StartsWith(fmt::format("cascade {}\n", cascade::version())));
}

struct WrongUse {
    std::vector<std::string> arguments;
    std::string message;
};

class WrongUses : public testing::TestWithParam<WrongUse> {};

TEST_P(WrongUses, is_64_with_a_hint) {
    const Leave leave = left(GetParam().arguments);
    EXPECT_EQ(leave.status, exit_status::wrong_use);
    EXPECT_THAT(leave.text, HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    Options, WrongUses,
    testing::Values(
        WrongUse{{}, "Usage: cascade COMMAND"},
        WrongUse{{"rnu", "a.cascade"}, "no command 'rnu'; did you mean 'cascade run'?"},
        WrongUse{{"a.cascade"}, "no command 'a.cascade'; did you mean 'cascade run a.cascade'?"},
        WrongUse{{"fly"},
                 "the commands are run, sweep, continue, check, analyze, bench, compile, systems, "
                 "examples, new, "
                 "import, palettes, fmt, mesh, "
                 "repl, export, view"},
        WrongUse{{"run"}, "cascade run: a script is missing"},
        WrongUse{{"check"}, "cascade check: a script is missing"},
        WrongUse{{"run", "a", "--pallete", "tan"}, "no option --pallete; did you mean --palette?"},
        WrongUse{{"run", "a", "--gird=4x4"}, "no option --gird=4x4; did you mean --grid?"},
        WrongUse{{"run", "a", "b"}, "'b' is one argument too many"},
        WrongUse{{"run", "a", "b.png"}, "'b.png' is one argument too many; did you mean -o b.png?"},
        WrongUse{
            {"run", "a", "-o", "b.mov"},
            "'b.mov' is a film in a format that Cascade cannot write (the endings of films are "},
        WrongUse{{"run", "a", "--fps", "61"}, "'61' is not a number of frames in a second"},
        WrongUse{{"run", "a", "--seconds", "0"}, "'0' is not the length of a film"},
        WrongUse{{"run", "a", "--fps", "5", "--seconds", "2"}, "--fps excludes --seconds"},
        WrongUse{{"run", "a", "-o"}, "--output needs a value"},
        WrongUse{{"run", "a", "--gird", "3"}, "there is no option --gird; did you mean --grid?"},
        WrongUse{{"run", "a", "--grid", "4y4"},
                 "--grid: '4y4' is not a grid (write columns x rows"},
        WrongUse{{"run", "a", "--grid", "-4x4"}, "is not a grid"},
        WrongUse{{"run", "a", "--seed", "-1"}, "whole number from 0 to 4294967295"},
        WrongUse{{"run", "a", "--seed", "4294967296"}, "whole number from 0 to 4294967295"},
        WrongUse{{"run", "a", "--steps", "1e3"}, "'1e3' is not a whole number"},
        WrongUse{{"run", "a", "--scale", "65"}, "whole number from 1 to 64"},
        WrongUse{{"run", "a", "--detail", "9"}, "whole number from 1 to 8"},
        WrongUse{{"run", "a", "--palette", "viridi"}, "did you mean 'viridis'?"},
        WrongUse{{"run", "a", "--backend", "gpu"}, "'gpu' is not one of"},
        WrongUse{{"run", "a", "--range", "3"}, "'3' is not a range"},
        WrongUse{{"run", "a", "--range", "3,3"}, "'3,3' is not a range"},
        WrongUse{{"run", "a", "--range", "nan,1"}, "'nan,1' is not a range"},
        WrongUse{{"run", "a", "-o", "a.jpg"}, "'a.jpg' has an ending that Cascade cannot write"},
        WrongUse{{"run", "a", "-o", "a.png", "-o", "a.xyz"}, ".npz and .cells.vtp their cells"},
        WrongUse{{"run", "a", "-o", "a.vdb"}, "use --volume a.vdb"},
        WrongUse{{"run", "a", "--volume", "a.vtk"}, "'a.vtk' does not end in .vti or .vdb"},
        WrongUse{{"run", "a", "--bump", "-1.5"}, "'-1.5' is not a number from -1 to 1"},
        WrongUse{{"run", "a", "--up", "xy"}, "'xy' is not one of x, y, z"},
        WrongUse{{"run", "a", "--turntable", "0"}, "whole number from 1 to 9999"},
        WrongUse{{"run", "a", "--stop-at", "9"}, "'9' is not a place to stop at"},
        WrongUse{{"run", "a", "--dump", "irr"}, "did you mean 'ir'?"},
        WrongUse{{"run", "a", "--save", ""}, "--save: it must not be empty"},
        WrongUse{{"run", "a", "--save", "a.npz"}, "'a.npz' has the ending of a file"},
        WrongUse{{"run", "a", "--save", "a.txt"}, "write a, or a.txt/ for a folder"},
        WrongUse{{"run", "a", "-o"}, "output"},
        WrongUse{{"compile", "a", "--per-cell", "a,,b"}, "'a,,b' is not a list of names"}));

}  // namespace
}  // namespace cascade

// Errors that can be found without the cells of a model are reported before these cells are made.
#include "run/commands/run.h"
#include "run/script/script.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

namespace cascade {
namespace {

struct Refusal {
    std::string messages;
    bool made_cells = false;
};

Refusal refusal_of(const std::string& start, const std::function<void(RunRequest&)>& ask,
                   const std::string& surface = "surface: implicit(1 - x^2 - y^2 - z^2, 2)") {
    const std::string text = "domain { " + surface + "; cells: 50 }\nsystem s { u: " + start +
                             "\n u' = lap(u) }\nstage one: s { iterations: 1 }\n";
    Script script = load_script("test", text, ".", {});
    Refusal refusal;
    RunControl control;
    control.report = [&](const Progress& progress) {
        refusal.made_cells |= progress.doing.starts_with("spreading");
    };
    RunRequest request;
    request.simulation.backend = "interp";
    request.outputs = {std::filesystem::temp_directory_path() / "early_errors.npz"};
    ask(request);
    const auto report = run(script, request, control);
    EXPECT_FALSE(report);
    refusal.messages = script.messages(false);
    if (!report) refusal.messages += report.error().message;
    return refusal;
}

void expect_early(const Refusal& refusal, const std::string& message) {
    EXPECT_FALSE(refusal.made_cells) << message;
    EXPECT_NE(refusal.messages.find(message), std::string::npos) << refusal.messages;
}

TEST(EarlyErrors, ComeBeforeCellsAreMade) {
    expect_early(refusal_of("1", [](RunRequest& r) { r.frames = "/proc/frames"; }),
                 "/proc/frames cannot be made");
    expect_early(refusal_of("1", [](RunRequest& r) { r.save = "/proc/saved"; }),
                 "/proc/saved cannot be made");
    expect_early(refusal_of("1", [](RunRequest& r) { r.log.expressions = {"mean(u over"}; }),
                 "<--log>");
    expect_early(refusal_of("attr(\"weight\")", [](RunRequest&) {}),
                 "the model's points have no attribute 'weight'");
}

TEST(EarlyErrors, OfTextureCoordinates) {
    // A square whose texture repeats a tile a hundred times.
    const char* const name = "early_errors.obj";
    std::ofstream(name) << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                           "vt 0 0\nvt 10 0\nvt 10 10\nvt 0 10\nf 1/1 2/2 3/3 4/4\n";
    const auto bake = [](RunRequest& r) {
        r.model_files.bake = 64;
        r.outputs[0].replace_extension(".glb");
    };
    expect_early(refusal_of("1", bake, std::string("mesh: \"") + name + "\""),
                 "cover the texture 100 times over");
    std::filesystem::remove(name);
}

TEST(EarlyErrors, LeaveNoFolders) {
    const auto folder = std::filesystem::temp_directory_path() / "cascade_early" / "saved";
    std::filesystem::remove_all(folder.parent_path());
    const Refusal refusal = refusal_of("attr(\"weight\")", [&](RunRequest& r) { r.save = folder; });
    expect_early(refusal, "have no attribute 'weight'");
    EXPECT_FALSE(std::filesystem::exists(folder.parent_path()));
}

}  // namespace
}  // namespace cascade

// cascade_front_end_bench: how many scripts per second the front end processes on one core. Cases
// are parsing, checking, lowering, formatting, and refusing with a message.
//
// All flags of Google Benchmark work. `small` is a stage of a system of the library, `system` a
// script with its own equations. `examples` are all scripts of examples/, one after another.
// `wrong` are the same scripts, each with a part left out.
#include "core/check.h"
#include "core/file.h"
#include "lang/check/check.h"
#include "lang/format/format_script.h"
#include "lang/lower/lower.h"
#include "lang/syntax/parse.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cascade::bench {
namespace {

using Scripts = std::vector<std::string>;

const Scripts& small() {
    static const Scripts all = {"stage spots: turing_spots { iterations: 4000 }\n"};
    return all;
}

const Scripts& own_system() {
    static const Scripts all = {
        "domain { grid: 256; boundary: periodic }\n"
        "system gray_scott_here {\n"
        "    F: 0.037 in 0..0.1; k: 0.06 in 0..0.1\n"
        "    u: 1; v: if(random(0, 1) > 0.9, 0.5, 0)\n"
        "    u' = 0.2 * lap(u) - u*v^2 + F*(1 - u)\n"
        "    v' = 0.1 * lap(v) + u*v^2 - (F + k)*v\n"
        "}\n"
        "stage grow: gray_scott_here { iterations: 4000; show: v }\n"};
    return all;
}

const Scripts& examples() {
    static const Scripts all = [] {
        std::vector<std::filesystem::path> paths;
        const std::filesystem::path root = CASCADE_SOURCE_DIR;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root / "examples")) {
            if (entry.path().extension() == ".cascade") paths.push_back(entry.path());
        }
        std::ranges::sort(paths);
        Scripts texts;
        for (const auto& path : paths) texts.push_back(read_file(path, 1 << 20).value());
        return texts;
    }();
    return all;
}

const Scripts& wrong() {
    static const Scripts all = [] {
        Scripts texts = examples();
        for (std::string& text : texts) text.erase(text.size() / 2, 7);
        return texts;
    }();
    return all;
}

struct Read {
    Sources sources;
    Diagnostics diagnostics;
    ast::Script tree;

    explicit Read(const std::string& text) {
        tree = parse(sources.add("script.cascade", text), sources, diagnostics);
    }
};

void parsed(const std::string& text) {
    const Read script(text);
    benchmark::DoNotOptimize(&script.tree);
}

void checked(const std::string& text) {
    Read script(text);
    const auto program = check(script.tree, script.sources, script.diagnostics);
    benchmark::DoNotOptimize(&program);
    benchmark::DoNotOptimize(render(script.diagnostics, script.sources, {.colour = true}));
}

void lowered(const std::string& text) {
    Read script(text);
    const auto program = check(script.tree, script.sources, script.diagnostics);
    CHECK(program && !script.diagnostics.has_errors(), "the scripts are programs");
    for (std::uint32_t stage = 0; stage < program->stages.size(); ++stage) {
        benchmark::DoNotOptimize(plan_start(*program, stage));
        benchmark::DoNotOptimize(plan_step(*program, stage));
        benchmark::DoNotOptimize(plan_view(*program, program->stages[stage].show, stage));
    }
}

void formatted(const std::string& text) {
    Sources sources;
    Diagnostics diagnostics;
    const SourceId source = sources.add("script.cascade", text);
    benchmark::DoNotOptimize(
        format_script(source, sources, diagnostics, ScriptNotation::as_written));
}

void scripts(benchmark::State& state, const Scripts& (*texts)(), void (*work)(const std::string&)) {
    std::int64_t bytes = 0;
    for (const std::string& text : texts()) bytes += static_cast<std::int64_t>(text.size());
    for (auto turn : state) {
        for (const std::string& text : texts()) work(text);
    }
    const auto count = static_cast<std::int64_t>(texts().size());
    state.SetItemsProcessed(state.iterations() * count);
    state.counters["bytes"] = static_cast<double>(bytes / count);
}

BENCHMARK_CAPTURE(scripts, small_parsed, small, parsed);
BENCHMARK_CAPTURE(scripts, small_checked, small, checked);
BENCHMARK_CAPTURE(scripts, small_lowered, small, lowered);
BENCHMARK_CAPTURE(scripts, small_formatted, small, formatted);
BENCHMARK_CAPTURE(scripts, system_parsed, own_system, parsed);
BENCHMARK_CAPTURE(scripts, system_checked, own_system, checked);
BENCHMARK_CAPTURE(scripts, system_lowered, own_system, lowered);
BENCHMARK_CAPTURE(scripts, system_formatted, own_system, formatted);
BENCHMARK_CAPTURE(scripts, examples_parsed, examples, parsed);
BENCHMARK_CAPTURE(scripts, examples_checked, examples, checked);
BENCHMARK_CAPTURE(scripts, examples_lowered, examples, lowered);
BENCHMARK_CAPTURE(scripts, examples_formatted, examples, formatted);
BENCHMARK_CAPTURE(scripts, wrong_checked, wrong, checked);

}  // namespace
}  // namespace cascade::bench

BENCHMARK_MAIN();

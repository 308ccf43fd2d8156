// Formats the results of run/commands/bench.h as a table and as a row of CSV.
#include "app/bench_table.h"

#include "core/counted.h"
#include "core/quantities.h"
#include "core/with_commas.h"
#include "run/stage/memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace cascade {

namespace {

std::string sides_of(const StageBench& bench) {
    const Grid& grid = bench.grid;
    if (bench.is_of_cells()) {
        return counted(static_cast<std::int64_t>(std::round(bench.mean_cells)), "cell") +
               " that crawl on average";
    }
    if (grid.linked) return fmt::format("{} cells of a model", with_commas(grid.cell_count()));
    return describe_sides(grid) + " cells";
}

/// Formats a number with at most one decimal. Every number here is an integer, except the mean
/// number of links per cell of a model.
std::string number(double value) {
    return std::abs(value - std::round(value)) < 0.05 ? fmt::format("{:.0f}", value)
                                                      : fmt::format("{:.1f}", value);
}

std::string amount(const Bound& bound, double value) {
    switch (bound.kind) {
        case Bound::Kind::operations:
        case Bound::Kind::divisions: return with_unit(value, "op/s");
        case Bound::Kind::nearest:
        case Bound::Kind::tiles:
        case Bound::Kind::home: return with_unit(value, "B/s");
        case Bound::Kind::meetings: return with_unit(value, "/s");
    }
    return "";
}

std::string line(std::string_view name, const std::string& text) {
    return fmt::format("  {:<17} {}\n", name, text);
}

/// Formats a count per cell. The count may be a mean, such as the mean number of loaded links.
std::string mean_count(double count, std::string_view one, std::string_view many) {
    const std::string text = number(count);
    return fmt::format("{} {}", text, text == "1" ? one : many);
}

std::string work_lines(const StageBench& bench) {
    const StepWork& work = bench.work;
    std::string text = mean_count(work.cost.operations, "operation", "operations");
    if (work.cost.divisions > 0) {
        text += fmt::format(" ({})", mean_count(work.cost.divisions, "division or root",
                                                "divisions or roots"));
    }
    text += ", " + mean_count(work.cost.loads, "load", "loads");
    text += ", " + mean_count(work.cost.stores, "store", "stores");
    if (work.links > 0) text += fmt::format(", {:.2f} links", work.links);
    text += ", in " + counted(work.passes, "pass");
    std::string lines = line("work a cell-step", text);
    lines += line("planes", fmt::format("{} bytes a cell-step; {} in all", number(work.bytes),
                                        with_unit(work.working_set, "B")));
    if (bench.stepping.sweeps_at_once > 1) {
        const double at_once = bench.stepping.sweeps_at_once;
        lines +=
            line("tiles", fmt::format("{} sweeps at once, {:.2g} of those bytes through memory; "
                                      "{} in use",
                                      number(at_once), work.bytes / at_once,
                                      with_unit(bench.stepping.bytes_in_use, "B")));
    }
    if (work.has_waves) {
        lines += line("", "the filtering of waves is not counted");
    }
    return lines;
}

std::string limit_lines(const StageBench& bench) {
    const auto bounds = bounds_of(bench);
    std::string lines =
        fmt::format("\n  {:<36}{:>14}{:>16}{:>9}\n", "limit", "reached", "peak, measured", "share");
    for (const Bound& bound : bounds) {
        lines += fmt::format("  {:<36}{:>14}{:>16}{:>7.0f} %\n", bound.name,
                             amount(bound, bound.reached), amount(bound, bound.most),
                             100 * bound.share());
    }
    for (const auto& memory : bench.limits->memories) {
        const bool is_listed = std::any_of(bounds.begin(), bounds.end(), [&](const Bound& bound) {
            return bound.name.ends_with(", " + memory.name);
        });
        if (is_listed) continue;
        lines += fmt::format("  {:<36}{:>14}{:>16}\n", memory.name, "",
                             with_unit(memory.bytes_per_second, "B/s"));
    }
    const Roof roof = *attainable(bench);
    lines += line("roofline",
                  fmt::format("{} cell-steps/s by {}, of which {:.0f} % are reached",
                              with_prefix(roof.cell_steps_per_second), roof.name,
                              100 * bench.cell_steps_per_second() / roof.cell_steps_per_second));
    return lines;
}

}  // namespace

std::string bound_sentence(const StageBench& bench) {
    const auto bounds = bounds_of(bench);
    if (bounds.empty()) return "";
    const Bound& bound = tightest(bounds);
    constexpr double near = 0.5;
    const std::string figures =
        bound.kind == Bound::Kind::meetings
            ? fmt::format("{:.0f} % of a step's {}", 100 * bound.share(),
                          with_unit(bench.step, "s"))
            : fmt::format("{} of {}, {:.0f} %", amount(bound, bound.reached),
                          amount(bound, bound.most), 100 * bound.share());
    std::string text =
        bound.share() >= near
            ? fmt::format("{}: {}", bound.name, figures)
            : fmt::format("no limit is near; the nearest is {}: {}", bound.name, figures);
    for (const Bound& other : bounds) {
        if (is_outdone(other)) {
            text += fmt::format("; {}: {:.0f} %, since part of it stays nearer", other.name,
                                100 * other.share());
        }
    }
    if (bench.threads < bench.most_threads) {
        text +=
            fmt::format("; {} of {} threads took the steps: {}", bench.threads, bench.most_threads,
                        bench.cells() < 65536 ? sides_of(bench) + " are few"
                                              : "the machine is busy, or more are no faster");
    }
    if (!bench.is_native) {
        text =
            "steps are interpreted, native code is far faster (limits are those of native "
            "code); " +
            text;
    }
    return text;
}

std::string bench_table(const std::string& script, const StageBench& bench) {
    std::string text =
        fmt::format("{}, stage '{}': {}, {}, {}, {}{}\n", script, bench.stage, bench.solver,
                    sides_of(bench), name_of(bench.precision), bench.fast ? "fast, " : "",
                    bench.is_native ? "native code" : "interpreted");
    if (!bench.nothing.empty()) return text + line("nothing", bench.nothing) + "\n";
    text += line("speed", fmt::format("{} cell-steps/s, {} a step",
                                      with_prefix(bench.cell_steps_per_second()),
                                      with_unit(bench.step, "s")));
    const auto batches = static_cast<std::int64_t>(bench.batches);
    const std::string how =
        bench.is_of_cells()
            ? fmt::format("the mean, {}", counted(bench.threads, "thread"))
            : fmt::format("the median of {}, {}; {}", counted(batches, "batch", "batches"),
                          counted(bench.threads, "thread"), bench.stepping.in_words());
    text += line("measured", fmt::format("{} steps, {}", with_commas(bench.steps), how));
    text +=
        line("before", fmt::format("starting values {}, first step {}, compiling {} in all",
                                   with_unit(bench.starting, "s"), with_unit(bench.first_step, "s"),
                                   with_unit(bench.compiling, "s")));
    if (!bench.is_of_cells()) text += work_lines(bench);
    if (bench.limits) {
        text += limit_lines(bench);
        text += line("bound by", bound_sentence(bench));
    } else if (!bench.is_native) {
        text += line("bound by", "the interpreter");
    }
    return text + "\n";
}

std::string bench_csv_header() {
    return "script,stage,solver,width,height,depth,precision,backend,threads,steps,seconds_per_"
           "step,"
           "cell_steps_per_second,operations,loads,stores,bytes,starting_seconds,compiling_seconds,"
           "first_step_seconds,fast\n";
}

std::string bench_csv_row(const std::string& script, const StageBench& bench) {
    std::string name = script;
    for (char& c : name) {
        if (c == ',' || c == '"' || c == '\n') c = '_';
    }
    const Grid row_of_cells{static_cast<std::int64_t>(std::round(bench.mean_cells)), 1};
    const Grid& grid = bench.is_of_cells() ? row_of_cells : bench.grid;
    std::string row = fmt::format("{},{},{},{},{},{},{},{}", name, bench.stage, bench.solver,
                                  grid.width, grid.height, grid.depth, name_of(bench.precision),
                                  bench.is_native ? "jit" : "interp");
    if (!bench.nothing.empty()) return row + fmt::format(",,0,,,,,,,,,,{:d}\n", bench.fast);
    const StepWork& work = bench.work;
    return row + fmt::format(
                     ",{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.4g},{:.4g},{:.4g},{:d}\n",
                     bench.threads, bench.steps, bench.step, bench.cell_steps_per_second(),
                     work.cost.operations, work.cost.loads, work.cost.stores, work.bytes,
                     bench.starting, bench.compiling, bench.first_step, bench.fast);
}

}  // namespace cascade

// Reads each time only once, before drawing, because the measured times grow while the table is
// made.
#include "app/time_table.h"

#include "core/counted.h"
#include "core/quantities.h"
#include "core/with_commas.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <string_view>
#include <vector>

namespace cascade {

namespace {

struct Part {
    Spent what;
    std::string_view name;
};
constexpr std::array<Part, spent_count> parts = {{
    {Spent::reading, "read and check"},
    {Spent::cells, "cells of the model"},
    {Spent::starting, "starting values"},
    {Spent::compiling, "compile"},
    {Spent::stepping, "steps"},
    {Spent::drawing, "pictures and files"},
    {Spent::rest, "the rest"},
}};

constexpr int bar_columns = 20;

class Table {
public:
    Table(double everything, bool bars) : everything_(everything), bars_(bars) {}

    void line(const std::string& name, double seconds, const std::string& remark = "") {
        const bool is_long = everything_ >= 10;
        const double share = everything_ > 0 ? seconds / everything_ : 0;
        std::string line =
            fmt::format("{:<24}{:>10.{}f} {:<2}{:>8.1f} %", name, is_long ? seconds : 1e3 * seconds,
                        is_long ? 3 : 1, is_long ? "s" : "ms", 100 * share);
        if (bars_) {
            const int width = static_cast<int>(std::clamp(share, 0.0, 1.0) * bar_columns + 0.5);
            line += "  ";
            for (int k = 0; k < width; ++k) line += "▆";
            if (!remark.empty()) line += std::string(bar_columns - width, ' ');
        }
        if (!remark.empty()) line += "  " + remark;
        text_ += line + "\n";
    }

    const std::string& text() const { return text_; }

private:
    double everything_;
    bool bars_;
    std::string text_;
};

/// Describes the steps of a stage, such as "28,000 steps, 250 M cell-steps/s; 16 steps a pass".
std::string remark_on_steps(const TimeAccount::Stage& stage) {
    if (stage.steps == 0) return "";
    const double seconds = stage.seconds[static_cast<std::size_t>(Spent::stepping)];
    std::string text = counted(stage.steps, "step");
    if (seconds > 0) {
        const double work = static_cast<double>(stage.steps) * static_cast<double>(stage.cells);
        text += fmt::format(", {} cell-steps/s", with_prefix(work / seconds));
    }
    if (!stage.stepping.words.empty()) text += "; " + stage.stepping.in_words();
    return text;
}

/// Describes kernels, such as "2 kernels compiled, 1 found on disk".
std::string remark_on_kernels(const KernelCounts& kernels) {
    std::string text;
    const auto add = [&](std::int64_t count, std::string_view what) {
        if (count == 0) return;
        if (text.empty()) {
            text = fmt::format("{} {}", counted(count, "kernel"), what);
        } else {
            text += fmt::format(", {} {}", count, what);
        }
    };
    add(kernels.compiled, "compiled");
    add(kernels.found, "found on disk");
    return text;
}

}  // namespace

std::string time_table(TimeAccount& account, bool bars) {
    // Time passes while the table is made, so each time is read only once, here.
    std::vector<double> seconds_of_parts;
    for (const Part& part : parts) seconds_of_parts.push_back(account.seconds(part.what));
    const double everything =
        std::accumulate(seconds_of_parts.begin(), seconds_of_parts.end(), account.seconds_before());
    const auto& stages = account.stages();
    Table table(everything, bars);
    table.line("program start", account.seconds_before());
    for (std::size_t k = 0; k < seconds_of_parts.size(); ++k) {
        const Part& part = parts[k];
        const double seconds = seconds_of_parts[k];
        const bool is_stepping = part.what == Spent::stepping;
        const std::string remark = part.what == Spent::compiling
                                       ? remark_on_kernels(account.kernels)
                                   : is_stepping && stages.size() == 1 ? remark_on_steps(stages[0])
                                                                       : "";
        table.line(std::string(part.name), seconds, remark);
        if (stages.size() < 2 || part.what == Spent::rest) continue;
        for (const TimeAccount::Stage& stage : stages) {
            const double of_stage = stage.seconds[static_cast<std::size_t>(part.what)];
            if (of_stage <= 0) continue;
            table.line("  " + stage.name, of_stage, is_stepping ? remark_on_steps(stage) : "");
        }
    }
    table.line("everything", everything);
    return table.text();
}

std::string rank_table(std::span<const RankLoad> loads) {
    std::string text = fmt::format("{:<24}{:>15}{:>15}{:>20}\n", "steps of each rank", "processor",
                                   "in messages", "bytes of halos");
    for (std::size_t rank = 0; rank < loads.size(); ++rank) {
        const RankLoad& load = loads[rank];
        text +=
            fmt::format("  {:<22}{:>12.1f} ms{:>12.1f} ms{:>20}\n",
                        fmt::format("{} on {}", rank, load.machine.data()), 1e3 * load.processor,
                        1e3 * load.messages, with_commas(load.halo_bytes));
    }
    return text;
}

}  // namespace cascade

// Analyses the requested stage and parameters, and writes the result as sentences, JSON or a plot.
#include "run/commands/analyze.h"

#include "analysis/describe_parameters.h"
#include "analysis/growing_domain.h"
#include "analysis/dispersion_plot.h"
#include "analysis/map_plot.h"
#include "analysis/negative_diffusion.h"
#include "analysis/outlook.h"
#include "analysis/stage_analysis.h"
#include "core/file.h"
#include "core/file_format.h"
#include "run/commands/analyze_json.h"
#include "run/commands/find_parameter.h"
#include "run/simulation/other_cells.h"
#include "run/simulation/stage_sizes.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade {

namespace {

using namespace analysis;

/// The number of values along each side of a map.
constexpr std::size_t values_along_map = 400;

class Analysis {
public:
    Analysis(const ast::Script& tree, const Program& program, std::uint32_t stage,
             const AnalyzeRequest& request)
        : tree_(tree), program_(program), stage_(stage), request_(request) {}

    Result<AnalyzeReport> run() {
        auto analysis = analyze_stage(program_, stage_);
        if (!analysis) {
            return failure(fmt::format("stage '{}' cannot be analyzed: {}",
                                       program_.stages[stage_].name, analysis.error().message),
                           analysis.error().hint);
        }
        if (auto done = vary(*analysis); !done) return tl::unexpected(done.error());
        AnalyzeReport report;
        report.text = request_.as_json ? json(*analysis) : words(*analysis);
        if (request_.output.empty()) return report;
        if (auto done = write(*analysis); !done) return tl::unexpected(done.error());
        report.written.push_back(request_.output);
        return report;
    }

private:
    Result<void> vary(const StageAnalysis& analysis) {
        std::vector<ParameterSpan> spans;
        for (const VariedRange& range : request_.varied) {
            auto item = find_parameter(program_, stage_, range.name);
            if (!item) return tl::unexpected(item.error());
            const auto unit = unit_factor(tree_, range);
            if (!unit) return tl::unexpected(unit.error());
            spans.push_back({*item, range.low * *unit, range.high * *unit});
        }
        if (analysis.states.empty()) {
            if (spans.empty()) return {};
            return failure("no flat state, with all cells equal, was found");
        }
        const Vector& state = state_to_show(analysis).state.species;
        if (spans.size() == 2) {
            if (spans[0].item == spans[1].item) {
                return failure(fmt::format("'{}' is varied twice", request_.varied[0].name));
            }
            auto map =
                map_parameters(program_, stage_, spans[0], spans[1], values_along_map, state);
            if (!map) return tl::unexpected(cannot_vary(map.error()));
            map_ = std::move(*map);
        } else if (spans.empty()) {
            spans = ranged_parameters(program_, stage_);
        }
        for (const ParameterSpan& span : spans) {
            auto scan = scan_parameter(program_, stage_, span, state);
            if (scan) {
                scans_.push_back(std::move(*scan));
            } else if (!request_.varied.empty()) {
                return tl::unexpected(cannot_vary(scan.error()));
            }
        }
        return {};
    }

    static Failure cannot_vary(const Failure& why) {
        return {fmt::format("the parameter cannot be varied: {}", why.message), why.hint};
    }

    std::string words(const StageAnalysis& analysis) const {
        std::string text = describe(analysis);
        if (const auto why = why_nothing_grows(program_, stage_)) {
            text += fmt::format("\nnothing will grow: {}\n", *why);
        }
        if (const auto why = negative_diffusion(program_, stage_)) {
            text += fmt::format("\nno pattern has a length: {}\n", *why);
        }
        text += waves_of_growing_domain(program_, stage_);
        if (!scans_.empty()) {
            text += fmt::format("\nby parameters, the flat state {}\n",
                                values_text(analysis.model, state_to_show(analysis).state.species));
        }
        for (const ParameterScan& scan : scans_) {
            text += fmt::format("  {}\n", describe(program_, stage_, scan));
        }
        if (map_) text += fmt::format("\n{}", shares());
        return text;
    }

    /// Says which fraction of the map each class covers: "of the pairs, 40 % are Turing, 60 %
    /// stable".
    std::string shares() const {
        std::vector<std::optional<Stability>> classes = map_->classes;
        std::sort(classes.begin(), classes.end());
        std::string text;
        for (auto each = classes.begin(); each != classes.end();) {
            const auto end = std::upper_bound(each, classes.end(), *each);
            text += fmt::format("{}{:.1f} % {}", text.empty() ? "" : ", ",
                                100.0 * static_cast<double>(end - each) /
                                    static_cast<double>(classes.size()),
                                class_name(*each));
            each = end;
        }
        return fmt::format("of {0} x {0} pairs of values: {1}\n", map_->side, text);
    }

    std::string json(const StageAnalysis& analysis) const {
        return analysis_as_json(analysis, scans_, map_ ? &*map_ : nullptr);
    }

    Result<void> write(const StageAnalysis& analysis) const {
        if (is_of_kind(request_.output, FormatKind::report))
            return write_file(request_.output, json(analysis));
        if (!map_ && analysis.states.empty()) {
            return failure(fmt::format("there is nothing to draw in {}: no flat state was found",
                                       request_.output.string()));
        }
        const Drawing drawing = map_ ? drawn_map() : plot_dispersion(analysis);
        return write_drawing(request_.output, drawing);
    }

    Drawing drawn_map() const {
        const System& system = program_.system_of(stage_);
        return plot_map(*map_,
                        {fmt::format("{}, stage '{}'", system.name, program_.stages[stage_].name),
                         std::string(system.item_name(map_->across.item)),
                         std::string(system.item_name(map_->up.item)),
                         {scans_[0].present, scans_[1].present}});
    }

    const ast::Script& tree_;
    const Program& program_;
    std::uint32_t stage_;
    const AnalyzeRequest& request_;
    std::vector<ParameterScan> scans_;
    std::optional<ParameterMap> map_;
};

}  // namespace

bool is_analysis_output(const std::filesystem::path& path) {
    return can_hold(path, FormatTrait::drawing) || is_of_kind(path, FormatKind::report);
}

Result<AnalyzeReport> analyze(Script& script, const AnalyzeRequest& request) {
    SimulationOptions options;
    options.kernel_cache = request.kernel_cache;
    const auto sized = sized_program(script, options);
    if (!sized) return tl::unexpected(sized.error());
    const Program& program = **sized;
    if (program.stages.empty()) {
        return failure("there is no stage to analyze", example_of_stage(program));
    }
    const auto stage = find_stage(program, request.stage.empty() ? "1" : request.stage);
    if (!stage) return tl::unexpected(stage.error());
    const Program own = program_of_stage(script, program, *stage);
    return Analysis(script.tree, own, *stage, request).run();
}

}  // namespace cascade

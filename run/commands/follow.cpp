// Finds the first steady state, follows it, and writes the branches.
#include "run/commands/follow.h"

#include "analysis/stage_analysis.h"
#include "continuation/branch.h"
#include "core/file.h"
#include "core/file_format.h"
#include "run/commands/branch_plot.h"
#include "run/commands/find_parameter.h"
#include "run/commands/follow_table.h"
#include "run/commands/followed_cells.h"
#include "run/commands/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cascade::continuation {

namespace {

/// The largest drift (Corrector::Solved) of a pattern that can move freely. If the drift is larger,
/// the cells hold the pattern in its place. The limit is higher on a model, whose unevenly spread
/// cells hold each pattern weakly.
constexpr double most_drift = 1e-7, most_drift_on_model = 0.01;

class BranchRun {
public:
    BranchRun(Script& script, const FollowRequest& request, RunControl& control)
        : script_(script), program_(*script.program), request_(request), control_(control) {}

    Result<FollowReport> run();

private:
    Result<void> find_what_varies();
    /// The program that runs, in which the lengths of stages with a size have been scaled.
    const Program& program() const { return *simulation_->domain().program; }
    Result<void> run_stages();
    Result<SteadyProblem> problem_with(const ConstantValues& constants) const;
    Result<Vector> first_state(Index size) const;
    Scales scales_of(const Vector& state) const;
    Result<std::vector<Branch>> follow();
    Result<void> save(const Point& point, const std::string& name);
    Result<FollowReport> write(const std::vector<Branch>& branches);
    Failure cannot(const Failure& why) const {
        return {fmt::format("the states of stage '{}' cannot be followed: {}",
                            program_.stages[stage_].name, why.message),
                why.hint};
    }

    Script& script_;
    const Program& program_;
    const FollowRequest& request_;
    RunControl& control_;
    std::uint32_t stage_ = 0;
    ItemId varied_;
    double unit_ = 1;    ///< The factor from the script's unit of the parameter, see unit_factor().
    VariedRange range_;  ///< In the unit that the script uses for the parameter.
    std::unique_ptr<Simulation> simulation_;
    SimulationOptions options_;
    Vector areas_;  ///< The areas of the cells.
};

Result<void> BranchRun::find_what_varies() {
    if (program_.stages.empty()) {
        return failure("there is no stage to follow", example_of_stage(program_));
    }
    stage_ = script_.final_stage();
    if (!request_.stage.empty()) {
        const auto stage = find_stage(program_, request_.stage);
        if (!stage) return tl::unexpected(stage.error());
        stage_ = *stage;
    }
    const auto item = find_parameter(program_, stage_, request_.varied->name);
    if (!item) return tl::unexpected(item.error());
    varied_ = *item;
    range_ = *request_.varied;
    const auto unit = unit_factor(script_.tree, range_);
    if (!unit) return tl::unexpected(unit.error());
    unit_ = *unit;
    range_.low *= unit_;
    range_.high *= unit_;
    if (!request_.save.empty() && stage_ > 0) {
        return failure("--save keeps states of a first stage only",
                       "the table has the numbers of all states");
    }
    if (auto good = check_steady(program_, stage_); !good)
        return tl::unexpected(cannot(good.error()));
    return {};
}

Result<SteadyProblem> BranchRun::problem_with(const ConstantValues& constants) const {
    auto problem =
        SteadyProblem::create(program(), stage_, followed_cells(*simulation_), varied_, constants);
    if (!problem) return tl::unexpected(cannot(problem.error()));
    return problem;
}

Result<void> BranchRun::run_stages() {
    options_ = request_.simulation;
    auto simulation = Simulation::create(script_, options_);
    if (!simulation) return tl::unexpected(simulation.error());
    simulation_ = *std::move(simulation);
    // The run will give the constants. Before the run, any numbers for them are enough to find out
    // what is not supported.
    const auto trial = problem_with([](const Formula&) { return std::vector{1.0}; });
    if (!trial) return tl::unexpected(trial.error());
    for (std::uint32_t k = 0; k <= stage_; ++k) {
        auto started = simulation_->start_stage(k, control_.cancel);
        if (!started) return started;
        if (k == stage_ && request_.from_flat) break;
        auto end = simulation_->advance_stage(k, program_.stages[k].iterations, control_, {});
        if (!end) return tl::unexpected(end.error());
        if (*end == StageEnd::cancelled)
            return failure("interrupted before the first steady state");
    }
    return {};
}

Result<Vector> BranchRun::first_state(Index size) const {
    if (!request_.from_flat) return followed_state(*simulation_, stage_);
    auto analysis = analysis::analyze_stage(program_, stage_);
    if (!analysis) return tl::unexpected(cannot(analysis.error()));
    if (analysis->states.empty()) return failure("no flat state was found");
    const auto& flat = analysis->states.front().state.species;
    Vector state(size);
    for (Index k = 0; k < size; ++k) state[k] = flat[k % flat.size()];
    return state;
}

Scales BranchRun::scales_of(const Vector& state) const {
    const auto count = static_cast<Index>(program_.system_of(stage_).species().size());
    Vector squares = Vector::Zero(count);
    for (Index k = 0; k < state.size(); ++k) squares[k % count] += state[k] * state[k];
    squares *= static_cast<double>(count) / static_cast<double>(state.size());
    const double largest = squares.maxCoeff();
    // If all values are near 0, they cannot serve as a scale.
    if (largest < 1e-12) squares.setOnes();
    squares = squares.cwiseMax(0.0025 * largest);
    Scales scales{Vector(state.size()), 0};
    for (Index k = 0; k < state.size(); ++k) {
        scales.weights[k] = 1 / (squares[k % count] * static_cast<double>(state.size()));
    }
    const double range = range_.high - range_.low;
    scales.parameter = 1 / (range * range);
    return scales;
}

Result<std::vector<Branch>> BranchRun::follow() {
    auto problem = problem_with(
        [&](const Formula& formula) { return followed_values(*simulation_, stage_, formula); });
    if (!problem) return tl::unexpected(problem.error());
    areas_ = problem->areas();
    const auto state = first_state(problem->size());
    if (!state) return tl::unexpected(state.error());
    const double parameter = simulation_->state(stage_).numbers[varied_];
    if (parameter < range_.low || parameter > range_.high) {
        const VariedRange& asked = *request_.varied;
        return failure(fmt::format("the run has {} = {:.6g}, which is outside of the range {:.6g} "
                                   "to {:.6g}",
                                   asked.name, parameter / unit_, asked.low, asked.high),
                       fmt::format("start inside of it with --set {}={:.6g}", asked.name,
                                   (asked.low + asked.high) / 2));
    }
    Corrector corrector(*problem, scales_of(*state));
    corrector.keep_totals(problem->conserved_near(*state, parameter));
    const Direction fixed{Vector::Zero(state->size()), 1};
    auto start = corrector.solve({*state, parameter}, fixed);
    if (!start || start->drift > (program_.domain.model ? most_drift_on_model : most_drift)) {
        corrector.hold_motions(false);
        start = corrector.solve({*state, parameter}, fixed);
    }
    if (!start) {
        return failure("Newton's method finds no steady state near the end of the run",
                       "let the stage run longer, for example with until: steady(1e-6), or start "
                       "with another value of the parameter");
    }
    FollowSettings settings;
    settings.low = range_.low;
    settings.high = range_.high;
    settings.step = request_.step;
    settings.most_points = request_.points;
    settings.most_branches = request_.branches;
    settings.cancel = &control_.cancel;
    settings.report = [&](std::size_t branch, std::size_t points, double at) {
        if (!control_.report) return;
        Progress progress;
        progress.doing =
            fmt::format("branch {}, point {}: {} = {:.4g}", branch + 1, points, range_.name, at);
        control_.report(progress);
    };
    std::vector<Branch> branches = Follower(corrector, settings).follow(*start);
    if (branches.empty()) {
        return failure("the first steady state is a point at which branches meet",
                       "start with another value of the parameter");
    }
    return branches;
}

/// Saves a state like a run that has taken no step.
Result<void> BranchRun::save(const Point& point, const std::string& name) {
    Overrides overrides = script_.overrides;
    overrides.sets.push_back(fmt::format("{}={:.17g}{}{}", range_.name,
                                         point.place.parameter / unit_,
                                         range_.unit.empty() ? "" : " ", range_.unit));
    Script script = load_script(script_.name, script_.text, script_.folder, overrides);
    script.file = script_.file;
    if (!script.program) return failure("the script does not accept the parameter's value");
    SimulationOptions options = options_;
    options.known_model = simulation_->domain().shared_model();
    auto simulation = Simulation::create(script, options);
    if (!simulation) return tl::unexpected(simulation.error());
    if (auto started = (*simulation)->start_stage(0); !started) return started;
    set_followed_state(**simulation, 0, point.place.state);
    const auto saved = save_run(request_.save / name, script, **simulation);
    if (!saved) return tl::unexpected(saved.error());
    return {};
}

Result<FollowReport> BranchRun::write(const std::vector<Branch>& branches) {
    const FollowTable table(program_, stage_, varied_, areas_);
    FollowReport report;
    report.text = table.words(branches);
    report.json = table.json(branches);
    std::vector<std::filesystem::path> outputs = request_.outputs;
    if (outputs.empty()) {
        outputs = {output_stem(script_) + "_branches.csv", output_stem(script_) + "_branches.svg"};
    }
    const auto number =
        request_.up.empty() ? Result<std::size_t>(0) : table.find_number(request_.up);
    if (!number) return tl::unexpected(number.error());
    const StatePictures pictures{followed_cells(*simulation_), request_.pictures};
    for (const auto& path : outputs) {
        const std::string title = fmt::format("{}, stage '{}'", program_.system_of(stage_).name,
                                              program_.stages[stage_].name);
        const auto done =
            can_hold(path, FormatTrait::drawing)
                ? write_drawing(path, table.diagram(branches, *number, title, pictures))
                : write_file(path, table.csv(branches));
        if (!done) return tl::unexpected(done.error());
        report.written.push_back(path);
    }
    if (request_.save.empty()) return report;
    for (std::size_t b = 0; b < branches.size(); ++b) {
        for (std::size_t k = 0; k < branches[b].points.size() && !control_.hurry; ++k) {
            const std::string name = fmt::format("branch{}_point{}", b + 1, k + 1);
            if (auto done = save(branches[b].points[k], name); !done) {
                return tl::unexpected(done.error());
            }
        }
    }
    report.written.push_back(request_.save);
    return report;
}

Result<FollowReport> BranchRun::run() {
    if (auto found = find_what_varies(); !found) return tl::unexpected(found.error());
    if (!request_.up.empty()) {
        const auto number = FollowTable(program_, stage_, varied_, {}).find_number(request_.up);
        if (!number) return tl::unexpected(number.error());
    }
    for (const auto& path : request_.outputs) {
        if (auto good = check_writable(path); !good) return tl::unexpected(good.error());
    }
    if (auto done = run_stages(); !done) return tl::unexpected(done.error());
    const auto branches = follow();
    if (!branches) return tl::unexpected(branches.error());
    return write(*branches);
}

}  // namespace

}  // namespace cascade::continuation

namespace cascade {

bool is_branches_output(const std::filesystem::path& path) {
    return can_hold(path, FormatTrait::drawing) || path.extension() == ".csv";
}

Result<FollowReport> follow_branches(Script& script, const FollowRequest& request,
                                     RunControl& control) {
    return continuation::BranchRun(script, request, control).run();
}

}  // namespace cascade

// Commands of the prompt that concern the run: start, step, show, save.
#include "app/prompt_session.h"

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/option_values.h"
#include "app/progress_display.h"
#include "run/commands/run.h"
#include "run/pictures/painter.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace cascade {

namespace {

/// True if two stages have the same species, so that the fields of one can continue in the other.
bool same_species(const System& first, const System& second) {
    std::vector<std::string> names[2];
    for (const Quantity& quantity : first.quantities) {
        if (quantity.is_species) names[0].push_back(quantity.name);
    }
    for (const Quantity& quantity : second.quantities) {
        if (quantity.is_species) names[1].push_back(quantity.name);
    }
    return names[0] == names[1];
}

/// True if two domains are the same cells of a model, or neither is on a model.
bool same_cells(const std::shared_ptr<const ModelCells>& first,
                const std::shared_ptr<const ModelCells>& second) {
    if (!first || !second) return !first && !second;
    return first->mesh.triangles == second->mesh.triangles &&
           first->cells.areas == second->cells.areas && first->cells.ends == second->cells.ends;
}

/// A run with a progress display that Ctrl-C stops.
struct WatchedRun {
    RunControl control;
    ProgressDisplay display;
    InterruptGuard interrupt{control.cancel};

    explicit WatchedRun(Console& console)
        : display(make_progress_display(console, !console.error().is_terminal)) {
        control.report = [this](const Progress& progress) { display.show(progress); };
        control.warn = [this, &console](const std::string& message) {
            display.clear();
            console.warn(message);
        };
    }
    WatchedRun(const WatchedRun&) = delete;
    WatchedRun& operator=(const WatchedRun&) = delete;
};

/// Creates a simulation, showing that the cells of a model are made, which may take a while.
Result<std::unique_ptr<Simulation>> create_simulation(Script& script, SimulationOptions options,
                                                      Console& console) {
    WatchedRun watched(console);
    options.control = &watched.control;
    auto created = Simulation::create(script, options);
    watched.display.clear();
    return created;
}

std::vector<Field> copies(const std::vector<Field>& fields) {
    std::vector<Field> result;
    for (const Field& field : fields) result.push_back(field.clone());
    return result;
}

}  // namespace

/// A simulation of a changed script that continues from the present one: parameters are computed
/// anew; species and steps are kept for the leading stages with equal species.
Result<std::unique_ptr<Simulation>> PromptSession::carry_over(Script& script) const {
    auto created = create_simulation(script, options_, console_);
    if (!created) return created;
    Simulation& simulation = **created;
    const Program& before = *script_->program;
    const Program& after = *script.program;
    if (!same_cells(simulation_->model(), simulation.model())) return created;
    if (!(before.domain.grid == after.domain.grid) || before.domain.seed != after.domain.seed ||
        before.domain.precision != after.domain.precision) {
        return created;
    }
    const std::size_t count = std::min(before.stages.size(), after.stages.size());
    for (std::uint32_t k = 0; k < count && simulation_->state(k).started; ++k) {
        if (before.stages[k].name != after.stages[k].name ||
            !same_species(before.system_of(k), after.system_of(k))) {
            break;
        }
        const StageState& state = simulation_->state(k);
        if (auto started = simulation.start_stage(k); !started) {
            return tl::unexpected(started.error());
        }
        const bool is_done = state.steps >= after.stages[k].iterations;
        simulation.restore(k, {copies(state.species), state.steps, state.t, is_done, false, {}});
    }
    return created;
}

bool PromptSession::has_something_to_run() {
    if (script_ && !script_->program->stages.empty()) return true;
    fail({"there is no stage yet", "type one: stage spots: turing_spots { ka: 1/80 }"});
    return false;
}

/// Creates the simulation and starts its first stage, unless there is one. False if that failed.
bool PromptSession::make_simulation() {
    if (simulation_) return true;
    if (!has_something_to_run()) return false;
    auto simulation = create_simulation(*script_, options_, console_);
    Result<void> started;
    if (simulation) started = (*simulation)->start_stage(0);
    if (!simulation || !started) {
        print_errors(*script_);
        script_->diagnostics = {};
        fail(simulation ? started.error() : simulation.error());
        return false;
    }
    simulation_ = std::move(*simulation);
    return true;
}

void PromptSession::init(const std::string&) {
    simulation_.reset();
    if (make_simulation()) tell_place();
}

void PromptSession::run(const std::string& count) {
    std::int64_t steps = std::numeric_limits<std::int64_t>::max();
    if (!count.empty()) {
        const auto parsed = parse_whole(count, 1, steps);
        if (!parsed) {
            fail(parsed.error());
            return;
        }
        steps = *parsed;
    }
    if (!make_simulation()) return;
    if (is_over()) return tell_over();
    const bool good = advance(steps);
    tell_place();
    if (good && show_after_run_) show("");
}

/// Takes `steps` steps, from stage to stage. False if a run failed.
bool PromptSession::advance(std::int64_t steps) {
    WatchedRun watched(console_);
    for (std::uint32_t k = 0; k < script_->stage_count() && steps > 0; ++k) {
        if (simulation_->state(k).done) continue;
        Result<StageEnd> end = StageEnd::finished;
        if (!simulation_->state(k).started) {
            if (auto started = simulation_->start_stage(k); !started) {
                end = tl::unexpected(started.error());
            }
        }
        const std::int64_t before = simulation_->state(k).steps;
        const std::int64_t iterations = script_->program->stages[k].iterations;
        const std::int64_t last = before + std::min(steps, iterations - before);
        if (end) end = simulation_->advance_stage(k, last, watched.control, {});
        watched.display.clear();
        if (!end) {
            fail(end.error());
            return false;
        }
        if (*end != StageEnd::finished) return true;
        remark(simulation_->remark_on(k));
        steps -= simulation_->state(k).steps - before;
    }
    return true;
}

bool PromptSession::is_over() const {
    if (!simulation_) return false;
    for (std::uint32_t k = 0; k < script_->stage_count(); ++k) {
        if (!simulation_->state(k).done) return false;
    }
    return true;
}

void PromptSession::tell_over() {
    console_.say("every stage has taken its steps: ':init' begins again, another stage goes on\n");
}

void PromptSession::remark(const std::string& words) {
    if (!words.empty()) console_.warn(words);
}

void PromptSession::show(const std::string& expression) {
    if (!make_simulation()) return;
    PictureRequest request;
    request.show = expression;
    auto painter = Painter::create(*script_, request);
    if (!painter) {
        print_errors(*script_);
        script_->diagnostics = {};
        return;
    }
    const Canvas canvas = painter->canvas(*simulation_);
    const Image image = painter->image(canvas);
    const int columns = console_.out().columns();
    console_.draw(console_.out().colour ? half_blocks(image, columns)
                                        : plain_characters(image, columns));
    if (!canvas.is_colour()) {
        const Spread values = spread_of(canvas.fields[0]);
        console_.print(values.count == 0 ? "no values\n"
                       : values.is_even()
                           ? fmt::format("{:.6g} in all cells\n", values.mean)
                           : fmt::format("{:.6g} to {:.6g}\n", values.smallest, values.largest));
    }
    if (painter->fell_back()) {
        console_.warn("it names a stage that has not run; this is the default picture");
    }
}

void PromptSession::list_stages(const std::string&) {
    if (!has_something_to_run()) return;
    const Program& program = *script_->program;
    for (std::uint32_t k = 0; k < program.stages.size(); ++k) {
        const StageState not_begun;
        const StageState& state = simulation_ ? simulation_->state(k) : not_begun;
        console_.print(fmt::format("{}: {}, {}\n", program.stages[k].name,
                                   program.system_of(k).name,
                                   describe_place(program.stages[k], state)));
    }
}

void PromptSession::save(const std::string& folder) {
    if (!make_simulation()) return;
    const auto written = save_run(folder, *script_, *simulation_);
    if (!written) {
        fail(written.error());
        return;
    }
    console_.note(fmt::format("wrote {} files in {}", written->size(), folder));
}

void PromptSession::tell_place() {
    const auto shown = simulation_->shown_stage();
    if (!shown) return;
    const Stage& stage = script_->program->stages[*shown];
    console_.print(fmt::format("stage '{}', {}\n", stage.name,
                               describe_place(stage, simulation_->state(*shown))));
}

}  // namespace cascade

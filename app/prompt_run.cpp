// The commands of the prompt that start the run, take steps, show the run and save it.
#include "app/prompt_session.h"

#include "app/commands.h"
#include "app/growing_picture.h"
#include "app/interrupt.h"
#include "app/option_values.h"
#include "app/progress_display.h"
#include "app/prompt_text.h"
#include "core/file.h"
#include "core/file_format.h"
#include "run/commands/run.h"
#include "run/pictures/measured.h"
#include "run/pictures/painter.h"
#include "run/session/session_picture.h"
#include "run/simulation/end_remarks.h"
#include "run/stage/stage_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <limits>

namespace cascade {

namespace {

/// A growing picture may be drawn after this many steps. With a smaller number, the solver could
/// not take several steps in one pass through memory.
constexpr std::int64_t steps_between_looks = 64;

/// Shows the progress of a run, and stops the run on Ctrl-C.
struct WatchedRun {
    RunControl control;
    ProgressDisplay display;
    InterruptGuard interrupt{control.cancel};

    std::shared_ptr<SessionFile> kept;

    WatchedRun(Console& console, std::shared_ptr<SessionFile> kept_file)
        : display(make_progress_display(console, !console.error().is_terminal)),
          kept(std::move(kept_file)) {
        control.report = [this](const Progress& progress) { display.show(progress); };
        control.warn = [this, &console](const std::string& message) {
            display.clear();
            console.warn(message);
        };
    }
    ~WatchedRun() {
        const bool ends_program = interrupt.signal() == SIGTERM || interrupt.signal() == SIGHUP;
        if (kept && ends_program) kept->leave();
    }
    WatchedRun(const WatchedRun&) = delete;
    WatchedRun& operator=(const WatchedRun&) = delete;
};

/// Describes the values of a field, such as "3.5 in all cells" or "0.1 to 0.9".
std::string in_words(const Field& field) {
    const Spread values = spread_of(field);
    if (values.count == 0) return "no values\n";
    if (values.is_uniform()) {
        return fmt::format("{:.6g} in all cells{}\n", values.mean,
                           values.is_one_number() ? "" : ", within a 100,000th of it");
    }
    return fmt::format("{:.6g} to {:.6g}\n", values.smallest, values.largest);
}

/// Describes the progress of a stage. If its cells crawl, also gives the numbers of cells, births
/// and deaths.
std::string progress_in_words(const Stage& stage, const StageState& state) {
    const std::string place = describe_place(stage, state);
    const auto cells = counts_of_cells(state);
    if (!cells) return place;
    return fmt::format("{}: {} cells, {} births, {} deaths", place, cells->count, cells->births,
                       cells->deaths);
}

}  // namespace

bool PromptSession::has_something_to_run() {
    if (script() && !script()->program->stages.empty()) return true;
    fail({"there is no stage yet", "type one: stage spots: turing_spots { ka: 1/80 }"});
    return false;
}

/// Replaces the run by the result of `make`. This may take a while, because `make` may make the
/// cells of a model or repeat steps. Returns false if `make` fails.
bool PromptSession::begin_with(
    const std::function<Accepted<std::unique_ptr<LiveRun>>(RunControl&)>& make) {
    WatchedRun watched(console_, kept_);
    auto made = make(watched.control);
    watched.display.clear();
    if (!made) {
        print_refusal(made.error());
        return false;
    }
    take_over(std::move(*made));
    tell_place();
    return true;
}

/// Starts the first stage, unless there is already a run. Returns false if that fails.
bool PromptSession::begin_run() {
    if (run_) return true;
    if (!has_something_to_run()) return false;
    WatchedRun watched(console_, kept_);
    const Script& typed = *script_;
    auto made = LiveRun::begin(load_script(typed.name, typed.text, typed.folder, typed.overrides),
                               options_, watched.control);
    watched.display.clear();
    if (!made) {
        print_refusal(made.error());
        return false;
    }
    take_over(std::move(*made));
    run_->script().diagnostics = {};  // The warnings in it have already been printed.
    return true;
}

void PromptSession::take_over(std::unique_ptr<LiveRun> run) {
    run_ = std::move(run);
    script_.reset();
    // The log of a run that continues a saved run cannot reproduce the run, so the log is not
    // stored.
    const bool is_kept = at_terminal_ && !run_->is_resumed();
    kept_ = is_kept ? SessionFile::of(*run_, stem_, "repl", false) : nullptr;
}

/// Applies a change to the run, and prints the warnings of a changed script. Returns false if the
/// run refuses the change.
bool PromptSession::apply(const Change& change) {
    WatchedRun watched(console_, kept_);
    const auto applied = run_->apply(change, watched.control);
    watched.display.clear();
    if (!applied) {
        print_refusal(applied.error());
        return false;
    }
    const std::string warnings = run_->script().messages(console_.error().colour);
    if (warnings != last_warnings_) console_.say(warnings);
    last_warnings_ = warnings;
    run_->script().diagnostics = {};
    return true;
}

/// Moves the run to an earlier moment, or forward again.
void PromptSession::move(const std::function<Accepted<void>(RunControl&)>& go) {
    WatchedRun watched(console_, kept_);
    const auto done = go(watched.control);
    watched.display.clear();
    if (!done) return print_refusal(done.error());
    run_->script().diagnostics = {};
    tell_place();
}

void PromptSession::init(const std::string&) {
    if (run_) return move([&](RunControl& control) { return run_->go_to(0, control); });
    if (begin_run()) tell_place();
}

void PromptSession::go_to(const std::string& name) {
    if (!begin_run()) return;
    const auto stage = find_stage(*run_->script().program, name);
    if (!stage) return fail(stage.error());
    move([&](RunControl& control) { return run_->go_to(*stage, control); });
}

void PromptSession::next(const std::string&) {
    if (begin_run() && apply(NextStage{})) tell_place();
}

void PromptSession::undo(const std::string&) {
    if (begin_run()) move([&](RunControl& control) { return run_->undo(control); });
}

void PromptSession::redo(const std::string&) {
    if (begin_run()) move([&](RunControl& control) { return run_->redo(control); });
}

void PromptSession::paint(const std::string& assignment) {
    const std::size_t sign = assignment.find_first_of("=:");
    const auto name = std::string(trim(assignment.substr(0, sign)));
    if (sign == std::string::npos || name.empty()) return fail({":paint takes NAME=EXPR", ""});
    if (!begin_run()) return;
    apply(Paint{name, std::string(trim(assignment.substr(sign + 1)))});
}

void PromptSession::run(const std::string& count) {
    std::int64_t steps = std::numeric_limits<std::int64_t>::max();
    if (!count.empty()) {
        const auto parsed = parse_whole(count, 1, steps);
        if (!parsed) return fail(parsed.error());
        steps = *parsed;
    }
    if (!begin_run()) return;
    if (run_->is_over()) return tell_over();
    const bool good = advance(steps);
    tell_place();
    if (good && at_terminal_) show("");
}

/// Takes `steps` steps, also across the ends of stages. Returns false if the run failed.
bool PromptSession::advance(std::int64_t steps) {
    WatchedRun watched(console_, kept_);
    GrowingPicture picture(console_, pictures_, *run_);
    Watching watching;
    watching.stage_ended = [&](std::uint32_t stage) {
        watched.display.clear();
        picture.erase();
        remark(remark_on(run_->simulation(), stage));
    };
    if (at_terminal_ && console_.out().colour) {
        watching.every = steps_between_looks;
        watching.observe = [&] {
            if (!picture.is_due()) return;
            watched.display.clear();
            picture.draw();
        };
    }
    const auto end = run_->advance(steps, watched.control, watching);
    watched.display.clear();
    picture.erase();
    if (!end) fail(end.error());
    return end.has_value();
}

void PromptSession::tell_over() {
    console_.say(
        "every stage has taken its steps: type ':init' to begin again, or a new stage to "
        "continue\n");
}

void PromptSession::remark(const std::string& words) {
    if (!words.empty()) console_.warn(words);
}

/// Makes a painter of the run. Begins the run if there is none. Returns an empty optional if the
/// run cannot begin or if the expression has errors.
std::optional<Painter> PromptSession::painter_of(const std::string& expression) {
    if (!begin_run()) return std::nullopt;
    auto painter = make_painter(*run_, picture_of(expression));
    if (painter) return std::move(*painter);
    print_refusal(painter.error());
    return std::nullopt;
}

void PromptSession::show(const std::string& expression) {
    auto painter = painter_of(expression);
    if (!painter) return;
    shown_ = expression;
    const Canvas canvas = painter->canvas(run_->simulation());
    const Image image = painter->image(canvas);
    console_.draw(pictures_.draw(image, console_.out()));
    if (!canvas.is_colour()) console_.print(in_words(canvas.fields[0]));
    if (painter->fell_back()) {
        console_.warn("the picture reads a stage that has not run, so this is the default picture");
    }
}

/// Prints the value of an expression that was typed.
void PromptSession::print_value(const std::string& expression) {
    auto painter = painter_of(expression);
    if (!painter) return;
    const Canvas values = painter->values(run_->simulation());
    for (const Field& field : values.fields) console_.print(in_words(field));
}

void PromptSession::print_features_shown(const std::string&) {
    auto painter = painter_of(shown_);
    if (!painter) return;
    const Simulation& simulation = run_->simulation();
    if (simulation.state(shown_stage(simulation)).tissue()) {
        return fail({"cells that crawl have no rows and columns", ""});
    }
    if (simulation.domain().model)
        return fail({"the cells of a model have no rows and columns", ""});
    print_features(measure_shown(*painter, simulation), console_);
}

void PromptSession::list_stages(const std::string&) {
    if (!has_something_to_run()) return;
    const Program& program = *script()->program;
    for (std::uint32_t k = 0; k < program.stages.size(); ++k) {
        const StageState not_begun;
        const StageState& state = run_ ? run_->simulation().state(k) : not_begun;
        console_.print(fmt::format("{}: {}, {}\n", program.stages[k].name,
                                   program.system_of(k).name,
                                   progress_in_words(program.stages[k], state)));
    }
}

void PromptSession::save(const std::string& path) {
    if (!begin_run()) return;
    const std::string ending = lower_ending(path);
    if (ending == ".session") {
        if (auto done = write_file(path, print_session_log(run_->log())); !done) {
            return fail(done.error());
        }
        return console_.note(fmt::format("wrote {}", path));
    }
    if (ending == ".cascade") return save_text(path);
    if (ending == ".png") return save_picture(path);
    if (has_ending_of_file(path)) {
        return fail({fmt::format("':save' cannot write a file that ends with {}", ending),
                     "use NAME.png, NAME.cascade, NAME.session, or a folder for the fields"});
    }
    const auto written = save_run(path, run_->script(), run_->simulation());
    if (!written) return fail(written.error());
    console_.note(fmt::format("wrote {} files in {}", written->size(), path));
}

/// Saves a picture of the present state. The picture shows the same expression as the picture that
/// was drawn last.
void PromptSession::save_picture(const std::string& path) {
    const auto file = session_picture(*run_, picture_of(shown_));
    if (!file) return print_refusal(file.error());
    if (auto done = write_file(path, *file); !done) return fail(done.error());
    console_.note(fmt::format("wrote {}", path));
}

/// Saves the text of the script. Fails if a run of this text would not make the present pattern.
void PromptSession::save_text(const std::string& path) {
    if (!run_->script().overrides.sets.empty()) {
        return fail({"parameters that ':set' changed are not in the text of the script",
                     "type them into its stages, or write 'NAME.session', which has them"});
    }
    if (auto done = write_file(path, run_->script().text); !done) return fail(done.error());
    console_.note(fmt::format("wrote {}", path));
}

void PromptSession::tell_place() {
    const std::uint32_t number = std::max(shown_stage(run_->simulation()), run_->place().stage);
    const Stage& stage = run_->script().program->stages[number];
    console_.print(fmt::format("stage '{}', {}\n", stage.name,
                               progress_in_words(stage, run_->simulation().state(number))));
}

}  // namespace cascade

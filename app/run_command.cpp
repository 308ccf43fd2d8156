// The command `cascade run` loads the script, shows progress, and reports the written files.

#include "app/commands.h"
#include "app/device_option.h"
#include "app/exit_status.h"
#include "app/interrupt.h"
#include "app/json_answer.h"
#include "app/last_moments.h"
#include "app/limits.h"
#include "app/option_values.h"
#include "app/progress_display.h"
#include "app/rank_process.h"
#include "app/time_table.h"
#include "app/whole_program.h"
#include "core/counted.h"
#include "core/file_format.h"
#include "core/with_commas.h"
#include "lang/syntax/replace_blocks.h"
#include "ranks/launcher.h"
#include "ranks/ranks.h"
#include "run/pictures/picture_size.h"
#include "run/script/embedded_script.h"
#include "run/script/script_folder.h"
#include "run/session/session_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

/// Loads the script to run, with the picture options that are stored with it in a picture or saved
/// run.
std::optional<LoadedFile> load_for_run(const Options& options, const Console& console) {
    if (options.run.resume.empty()) return load(options.scripts[0], options.overrides, console);
    std::optional<LoadedFile> given;
    if (!options.scripts.empty()) {
        given = load(options.scripts[0], {}, console);
        if (!given) return std::nullopt;
    }
    auto saved = load_saved_script(options.run.resume, options.overrides,
                                   given ? given->script.folder : std::filesystem::path());
    if (!saved) {
        console.fail(saved.error());
        return std::nullopt;
    }
    if (given) {
        if (given->script.text != saved->text) {
            if (!differ_in_pictures_only(given->script.text, saved->text)) {
                console.fail({fmt::format("{} differs from the script of the run saved in {}",
                                          options.scripts[0], options.run.resume.string()),
                              "a saved run continues with its own script: leave SCRIPT out; only "
                              "pictures and shapes may differ"});
                return std::nullopt;
            }
            saved = load_saved_script(options.run.resume, options.overrides, given->script.folder,
                                      &given->script);
            if (!saved) {
                console.fail(saved.error());
                return std::nullopt;
            }
        }
        saved->file = given->script.file;
    }
    const auto edited = find_edited_script(options.run.resume, saved->name, saved->text);
    if (!given && edited) {
        console.warn(fmt::format(
            "{} differs from the script of the saved run, so the run continues with its own "
            "script; files are read from {} and the folders of --allow-read",
            edited->string(), options.run.resume.string()));
    }
    return LoadedFile{std::move(*saved), ""};
}

/// Whether the run needs parts that the first program lacks (cmake/later.txt).
bool needs_more_than_planes(const Options& options, const Script& script) {
    const RunRequest& run = options.run;
    if (script.program && draws_scene(script, apply(options.picture, run.picture))) return true;
    if (!run.save.empty() || is_of_format(run.volume, FileFormat::vdb)) return true;
    return std::any_of(run.outputs.begin(), run.outputs.end(), [](const auto& path) {
        const auto kind = output_kind(path);
        return kind == FormatKind::model || kind == FormatKind::cells;
    });
}

/// Prints the written files. All pictures of --frames together are one line.
void tell_written(const RunReport& report, const RunRequest& request, Console& console) {
    std::size_t frames = 0;
    for (const auto& path : report.written) {
        if (!request.frames.empty() && path.parent_path() == request.frames) {
            ++frames;
        } else {
            console.print(fmt::format("wrote {}\n", path.string()));
        }
    }
    if (frames > 0) {
        console.print(fmt::format("wrote {} in {}\n",
                                  counted(static_cast<std::int64_t>(frames), "picture"),
                                  request.frames.string()));
    }
    for (const std::string& note : report.notes) console.note(note);
}

/// Adds the members of --json that describe a run.
void answer(const RunReport& report, bool limit_reached, JsonAnswer& all) {
    using Json = nlohmann::ordered_json;
    const bool is_cancelled = report.status == RunStatus::cancelled;
    all["outcome"] = is_cancelled ? (limit_reached ? "time limit" : "interrupted")
                     : report.status == RunStatus::stopped ? "stopped"
                                                           : "finished";
    all["where"] = report.where;
    all["steps"] = report.steps;
    all["seconds"] = report.seconds;
    all["written"] = Json::array();
    for (const auto& path : report.written) all["written"].push_back(path.string());
    all["remarks"] = report.remarks;
    if (!report.features) return;
    const auto values = measure::to_array(*report.features);
    for (std::size_t k = 0; k < values.size(); ++k) {
        all["features"][std::string(measure::feature_names()[k])] =
            std::isfinite(values[k]) ? Json(values[k]) : Json(nullptr);
    }
}

int tell(const RunReport& report, const Options& options, int signal, bool limit_reached,
         Console& console) {
    if (console.answer()) answer(report, limit_reached, *console.answer());
    if (report.features) {
        print_features(*report.features, console);
        for (const std::string& remark : report.remarks) {
            console.print(fmt::format("{:<11} {}\n", "remark", remark));
        }
    }
    if (!options.quiet) {
        tell_written(report, options.run, console);
        if (report.steps > 0) {
            console.say(
                fmt::format("{} steps in {:.2f} s\n", with_commas(report.steps), report.seconds));
        }
    }
    if (report.status == RunStatus::stopped && !options.quiet) {
        console.say(fmt::format("stopped at {}\n", report.where));
    }
    if (report.status != RunStatus::cancelled) return exit_status::success;
    const char* const written =
        report.has_begun ? "the results so far have been written" : "nothing has been written";
    if (limit_reached) {
        console.say(fmt::format("cascade: the limit of {} is reached at {}; {}\n",
                                describe_duration(options.limit_seconds), report.where, written));
        return exit_status::time_limit;
    }
    console.say(fmt::format("cascade: interrupted at {}; {}\n", report.where, written));
    return exit_status::signal_base + signal;
}

}  // namespace

Result<std::optional<SessionLog>> session_to_play(const LoadedFile& file, Overrides changes,
                                                  const Console& console, bool quiet) {
    auto log = session_of(file);
    if (!log || !*log) return log;
    // Only the name of the model's file is compared, not its folder.
    const auto name_of_model = [](const Overrides& overrides) {
        return std::filesystem::path(overrides.model.value_or("")).filename();
    };
    const Overrides merged = merge((*log)->overrides, changes);
    if (name_of_model(changes) == name_of_model((*log)->overrides)) {
        changes.model.reset();
        changes.model_is_asked_for = false;
    }
    changes.reads = {};
    const bool is_same = changes == Overrides();
    if (!quiet) {
        console.note(is_same ? fmt::format("{}: playing its session, up to step {} of stage {}",
                                           file.script.file.string(),
                                           with_commas((*log)->end.steps), (*log)->end.stage + 1)
                             : fmt::format("{}: its session is not played, because options "
                                           "change the script; only the script runs",
                                           file.script.file.string()));
    }
    if (!is_same) return std::nullopt;
    (*log)->overrides = merged;
    return log;
}

void print_features(const measure::Features& features, Console& console) {
    const auto values = measure::to_array(features);
    for (std::size_t k = 0; k < values.size(); ++k) {
        console.print(
            fmt::format("{:<11} {}\n", measure::feature_names()[k],
                        std::isfinite(values[k]) ? fmt::format("{:.6g}", values[k]) : "-"));
    }
}

ProgressDisplay make_progress_display(const Console& console, bool quiet) {
    using Kind = ProgressDisplay::Kind;
    const Stream stream = console.error();
    const Kind kind = quiet ? Kind::none : stream.is_terminal ? Kind::bar : Kind::lines;
    return {kind,
            {[stream](std::string_view text) { (void)stream.write(text); },
             [stream] { return stream.columns(); },
             [] { return std::chrono::steady_clock::now(); }}};
}

static int run_script(const Options& options, Console& console, Ranks* ranks);

int run_command(const Options& options, Console& console) {
    if (options.device == "list") return print_devices(console);
    if (launched_ranks()) return run_as_rank(options, console, run_script);
    if (options.ranks > 0) return start_ranks(options, console);
    return run_script(options, console, nullptr);
}

/// Makes the request of the run from the options, and adds the picture options and the session that
/// a picture of Cascade contains.
static Result<RunRequest> request_of(const LoadedFile& file, const Options& options,
                                     Console& console) {
    RunRequest request = options.run;
    if (!file.picture_options.empty()) {
        auto stored = picture_request_from_json(file.picture_options);
        if (!stored) return tl::unexpected(stored.error());
        request.picture = std::move(*stored);
    }
    request.picture = apply(options.picture, std::move(request.picture));
    auto session = session_to_play(file, options.overrides, console, options.quiet);
    if (!session) return tl::unexpected(session.error());
    request.session = std::move(*session);
    return request;
}

/// Lets several ranks or a device take the steps, if options ask for it.
static Result<void> choose_executor(const Options& options, const Script& script, Ranks* ranks,
                                    RunRequest& request, RunControl& control) {
    if (ranks != nullptr) {
        if (auto shared = share_steps(script, *ranks, request, control); !shared) return shared;
    }
    if (options.device.empty()) return {};
    return use_device(options.device, script, request, control);
}

static int run_script(const Options& options, Console& console, Ranks* ranks) {
    TimeAccount times;
    auto file = [&] {
        const TimeAccount::Scope spent(&times, Spent::reading);
        return load_for_run(options, console);
    }();
    if (!file) return exit_status::wrong_script;
    Script& script = file->script;
    if (needs_more_than_planes(options, script)) need_whole_program();
    if (!options.dump.empty()) return dump_command(script, options.dump, console);
    console.tell(script);
    if (!script.program) return exit_status::wrong_script;
    script.diagnostics = {};  // The warnings in it have already been printed.

    auto requested = request_of(*file, options, console);
    if (!requested) {
        console.fail(requested.error());
        return exit_status::wrong_script;
    }
    RunRequest request = std::move(*requested);
    if (options.timing) request.simulation.account = &times;

    RunControl control;
    ProgressDisplay display = make_progress_display(console, options.quiet);
    control.report = [&](const Progress& progress) { display.show(progress); };
    control.warn = [&](const std::string& message) {
        display.clear();
        if (!options.quiet) console.warn(message);
    };
    control.note = [&](const std::string& message) {
        display.clear();
        if (!options.quiet) console.note(message);
    };
    if (auto chosen = choose_executor(options, script, ranks, request, control); !chosen) {
        console.fail(chosen.error());
        return exit_status::failed_run;
    }
    // Several ranks must end at the same step, so they agree on it through a flag of their own.
    std::atomic<bool>& to_end = ranks != nullptr ? ranks->end_flag() : control.cancel;
    const LastMoments last(control, options.limit_seconds);
    const InterruptGuard interrupt(to_end);
    const bool is_first = ranks == nullptr || ranks->is_root();
    const TimeLimit limit(is_first ? options.limit_seconds : 0, to_end);
    const auto report = run(script, request, control);
    display.clear();
    if (report) {
        const int status =
            tell(*report, options, std::max(interrupt.signal(), 2), limit.reached(), console);
        if (options.timing) console.say(time_table(times, console.error().is_terminal));
        if (options.timing && ranks != nullptr) console.say(rank_table(ranks->loads()));
        return status;
    }
    if (options.timing && !script.diagnostics.has_errors()) {
        console.say(time_table(times, console.error().is_terminal));
    }
    console.tell(script);
    if (script.diagnostics.has_errors()) return exit_status::wrong_script;
    console.fail(report.error());
    return exit_status::failed_run;
}

}  // namespace cascade

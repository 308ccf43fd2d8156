// Implements `check`, `compile` and `--dump`, and loads the scripts of all commands.
#include "app/commands.h"

#include "app/examples.h"
#include "app/exit_status.h"
#include "app/json_answer.h"
#include "app/wgsl_dump.h"
#include "app/whole_program.h"
#include "core/counted.h"
#include "core/file.h"
#include "core/near_name.h"
#include "core/printable.h"
#include "lang/library/library.h"
#include "lang/syntax/parse.h"
#include "run/commands/dump.h"
#include "run/commands/outlooks.h"
#include "run/pictures/picture_size.h"
#include "run/script/embedded_script.h"
#include "run/session/changed_script.h"
#include "run/session/session_log.h"
#include "run/stage/kernel_cache.h"
#include "run/stage/memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <unistd.h>

namespace cascade {

Result<std::string> read_standard_input() {
    std::string text;
    std::string piece(1 << 16, '\0');
    while (true) {
        const ssize_t count = ::read(STDIN_FILENO, piece.data(), piece.size());
        if (count == 0) return text;
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) {
            return failure(fmt::format("standard input cannot be read: {}", std::strerror(errno)));
        }
        text.append(piece, 0, static_cast<std::size_t>(count));
        if (text.size() > largest_script) {
            return failure(
                fmt::format("standard input is longer than the {} bytes that a script may have",
                            largest_script));
        }
    }
}

namespace {

/// Loads the log of a session from a file. The loaded script is the last script of the session, as
/// it is for a log in a picture.
Result<LoadedFile> load_session_file(const std::filesystem::path& path, const Overrides& options) {
    auto text = read_file(path, largest_session_log);
    if (!text) return tl::unexpected(text.error());
    const auto log = parse_session_log(*text);
    if (!log) {
        return failure(fmt::format("{}: {}", path.string(), log.error().message), log.error().hint);
    }
    LoadedFile file{script_at_end(*log, path.parent_path(), options), ""};
    file.script.file = path;
    file.session = std::move(*text);
    return file;
}

Result<LoadedFile> load_file(const std::string& path, const Overrides& overrides,
                             const TypedScript* typed) {
    if (path != "-") {
        if (is_session_log(first_bytes(path, longest_log_beginning))) {
            return load_session_file(path, overrides);
        }
        return load_script_file(path, overrides);
    }
    if (typed) {
        return LoadedFile{load_script(typed->name, typed->text, typed->folder,
                                      merge(typed->overrides, overrides)),
                          ""};
    }
    need_whole_program();  // The whole program cannot read input that this program has read.
    auto text = read_standard_input();
    if (!text) return tl::unexpected(text.error());
    return LoadedFile{load_script("<standard input>", std::move(*text), ".", overrides), ""};
}

/// Returns a hint for a path that does not exist but has the name of an example. Returns an empty
/// string for other paths.
std::string advice_on_example(const std::filesystem::path& path) {
    const auto examples = read_examples();
    if (!examples) return "";
    const std::string stem = path.stem().string();
    const auto named = examples_named(*examples, stem);
    if (named.empty()) return "";
    return fmt::format("'cascade examples {} -o {}.cascade' writes the example of this name",
                       named.front()->name, stem);
}

/// Returns a hint for a path that does not exist. If `path` is the name of a system, the hint
/// suggests `cascade new`. Otherwise it names a file with a similar name.
std::string advice_on_missing(const std::filesystem::path& path) {
    std::error_code error;
    if (std::filesystem::exists(path, error)) return "";
    if (find_library_text(path.string())) {
        return fmt::format("'cascade new {}' prints a script of that system", path.string());
    }
    const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
    std::vector<std::string> names;
    constexpr std::size_t most_names = 1000;
    for (auto each = std::filesystem::directory_iterator(folder, error);
         !error && each != std::filesystem::directory_iterator() && names.size() < most_names;
         each.increment(error)) {
        const auto ending = each->path().extension();
        if (ending == ".cascade" || ending == ".png") {
            names.push_back(each->path().filename().string());
        }
    }
    std::sort(names.begin(), names.end());
    std::string near = nearest_name(path.filename().string(), names);
    if (near.empty()) near = nearest_name(path.filename().string() + ".cascade", names);
    if (near.empty()) return advice_on_example(path);
    const auto beside =
        path.has_parent_path() ? path.parent_path() / near : std::filesystem::path(near);
    return fmt::format("did you mean '{}'?", beside.string());
}

/// Summarises a script: "2 stages, 35000 steps, 64 × 64 cells". The number of steps is left out if
/// it is known only after a run.
std::string summary(const Script& script) {
    const Program& program = *script.program;
    std::int64_t steps = 0;
    const std::uint32_t count = program.stages.empty() ? 0 : script.stage_count();
    bool is_known = true;
    for (std::uint32_t k = 0; k < count; ++k) {
        const StageTime& time = program.stages[k].time;
        is_known = is_known && !time.has_duration() && !time.open_end;
        steps += program.stages[k].iterations;
    }
    return fmt::format("{}, {}{} cells", counted(count, "stage"),
                       is_known ? fmt::format("{} steps, ", steps) : "",
                       describe_sides(program.domain.grid));
}

/// Returns the members of --json that describe a checked script.
nlohmann::ordered_json facts_of(const Script& script) {
    nlohmann::ordered_json facts = {{"file", script.name},
                                    {"is_correct", script.program != nullptr}};
    if (!script.program) return facts;
    const Grid& grid = script.program->domain.grid;
    facts["grid"] = {grid.width, grid.height, grid.depth};
    facts["stages"] = nlohmann::ordered_json::array();
    for (std::uint32_t k = 0; !script.program->stages.empty() && k < script.stage_count(); ++k) {
        const Stage& stage = script.program->stages[k];
        nlohmann::ordered_json of_stage = {{"name", stage.name},
                                           {"system", script.program->system_of(k).name}};
        if (stage.time.duration) of_stage["duration"] = *stage.time.duration;
        else if (!stage.time.has_duration() && !stage.time.open_end)
            of_stage["iterations"] = stage.iterations;
        facts["stages"].push_back(std::move(of_stage));
    }
    return facts;
}

int check_one(const std::string& path, const Options& options, Console& console) {
    const auto file = load(path, options.overrides, console, typed_of(options));
    if (!file) return exit_status::wrong_script;
    if (file->script.program && draws_scene(file->script, {})) need_whole_program();
    if (console.answer()) (*console.answer())["scripts"].push_back(facts_of(file->script));
    if (!options.dump.empty()) return dump_command(file->script, options.dump, console);
    console.tell(file->script);
    if (!file->script.program) return exit_status::wrong_script;
    for (const std::string& remark : outlooks(file->script)) console.warn(remark);
    console.print(
        fmt::format("{}: no errors ({})\n", printable(file->script.name), summary(file->script)));
    return exit_status::success;
}

Result<void> write_compiled(const CompiledStep& compiled, const std::filesystem::path& object,
                            const std::filesystem::path& header) {
    const std::string_view bytes(reinterpret_cast<const char*>(compiled.object.data()),
                                 compiled.object.size());
    if (auto done = write_file(object, bytes); !done) return done;
    return write_file(header, compiled.header);
}

}  // namespace

std::optional<LoadedFile> load(const std::string& path, const Overrides& overrides,
                               const Console& console, const TypedScript* typed) {
    auto file = load_file(path, overrides, typed);
    if (file) return std::move(*file);
    Failure failure = file.error();
    if (failure.hint.empty()) failure.hint = advice_on_missing(path);
    console.fail(failure);
    return std::nullopt;
}

void print_list_line(std::string_view name, std::string_view about, Console& console) {
    std::string line = fmt::format("{:<24} {}", name, about);
    const auto columns = static_cast<std::size_t>(console.out().columns());
    if (console.out().is_terminal && line.size() > columns) {
        std::size_t end = columns > 2 ? columns - 2 : 0;
        // Moves the end of the cut line back to the beginning of a UTF-8 character.
        while (end > 0 && (line[end] & 0xc0) == 0x80) --end;
        line = line.substr(0, end) + "…";
    }
    console.print(line + "\n");
}

int dump_command(const Script& script, const std::string& kind, Console& console) {
    // Tokens and syntax tree exist even if the script has errors. Other dumps need a checked
    // program.
    const bool can_be_shown = script.program || kind == "tokens" || kind == "ast";
    const auto shown = [&] {
        return kind == wgsl_kind && script.program ? dump_wgsl(*script.program)
                                                   : dump(script, kind);
    };
    const auto text = can_be_shown ? shown() : Result<std::string>(std::string());
    if (text) console.print(*text);
    console.tell(script);
    if (!script.program) return exit_status::wrong_script;
    if (text) return exit_status::success;
    console.fail(text.error());
    return exit_status::failed_run;
}

int check_command(const Options& options, Console& console) {
    int status = exit_status::success;
    for (const std::string& path : options.scripts) {
        status = std::max(status, check_one(path, options, console));
    }
    return status;
}

int compile_command(const Options& options, Console& console) {
    auto file = load(options.scripts[0], options.overrides, console, typed_of(options));
    if (!file) return exit_status::wrong_script;
    Script& script = file->script;
    console.tell(script);
    if (!script.program) return exit_status::wrong_script;

    std::filesystem::path object = options.object;
    if (object.empty()) object = output_stem(script) + ".o";
    std::filesystem::path header = options.header;
    if (header.empty()) header = std::filesystem::path(object).replace_extension(".h");
    if (object.lexically_normal() == header.lexically_normal()) {
        console.fail({fmt::format("the object file and the header would both be written to {}",
                                  object.string()),
                      "give them different names with -o and --header"});
        return exit_status::wrong_use;
    }
    for (const auto& path : {object, header}) {
        if (auto good = check_writable(path); !good) {
            console.fail(good.error());
            return exit_status::failed_run;
        }
    }
    CompileRequest request = options.compile;
    request.kernel_cache = usual_kernel_cache();
    const auto compiled = compile_step(script, request);
    if (!compiled) {
        if (script.diagnostics.has_errors()) {
            console.tell(script);
            return exit_status::wrong_script;
        }
        console.fail(compiled.error());
        return fastest_backend().is_native ? exit_status::wrong_use : exit_status::failed_run;
    }
    if (auto done = write_compiled(*compiled, object, header); !done) {
        console.fail(done.error());
        return exit_status::failed_run;
    }
    console.print(fmt::format("wrote {}\nwrote {}\n", object.string(), header.string()));
    return exit_status::success;
}

}  // namespace cascade

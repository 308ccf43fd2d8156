// The command `cascade fmt` rewrites scripts in the standard form.
#include "app/commands.h"

#include "app/exit_status.h"
#include "core/file.h"
#include "lang/format/format_script.h"
#include "lang/syntax/parse.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade {

namespace {

/// Returns the script in the standard form. If the script cannot be parsed, prints its errors and
/// returns an empty optional.
std::optional<std::string> formatted(const std::string& name, const std::string& text,
                                     ScriptNotation notation, const Console& console) {
    Sources sources;
    Diagnostics diagnostics;
    const SourceId source = sources.add(name, text);
    auto result = format_script(source, sources, diagnostics, notation);
    RenderStyle style;
    style.colour = console.error().colour;
    if (!result) console.say(render(diagnostics, sources, style));
    return result;
}

int format_file(const std::string& path, const Options& options, Console& console) {
    const auto text = read_file(path, largest_script);
    if (!text) {
        console.fail(text.error());
        return exit_status::wrong_script;
    }
    if (text->starts_with("\x89PNG")) {
        console.fail({fmt::format("{} is a picture; its script cannot be changed", path),
                      "use fmt only for scripts"});
        return exit_status::wrong_script;
    }
    const auto result = formatted(path, *text, options.notation, console);
    if (!result) return exit_status::wrong_script;
    if (*result == *text) return exit_status::success;
    console.print(path + "\n");
    if (options.check_only) return exit_status::would_change;
    if (auto done = write_file(path, *result); !done) {
        console.fail(done.error());
        return exit_status::failed_run;
    }
    return exit_status::success;
}

/// Reads a script from standard input and prints its standard form. With --check, prints no script
/// and only returns the status.
int format_standard_input(const Options& options, Console& console) {
    const auto text = read_standard_input();
    if (!text) {
        console.fail(text.error());
        return exit_status::wrong_script;
    }
    const auto result = formatted("<standard input>", *text, options.notation, console);
    if (!result) return exit_status::wrong_script;
    if (!options.check_only) console.print_exactly(*result);
    return options.check_only && *result != *text ? exit_status::would_change
                                                  : exit_status::success;
}

}  // namespace

int format_command(const Options& options, Console& console) {
    int status = exit_status::success;
    for (const std::string& path : options.scripts) {
        status = std::max(status, path == "-" ? format_standard_input(options, console)
                                              : format_file(path, options, console));
    }
    return status;
}

}  // namespace cascade

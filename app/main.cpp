// The program `cascade`. Parses the options and runs a command.

#include "app/commands.h"
#include "app/exit_status.h"
#include "app/interrupt.h"
#include "app/limits.h"
#include "app/options.h"
#include "app/unexpected.h"

#include <algorithm>
#include <array>
#include <clocale>
#include <string>
#include <vector>

namespace {

int run_chosen(const cascade::Options& options, cascade::Console& console) {
    for (const cascade::CommandEntry& entry : cascade::command_table()) {
        if (entry.command != options.command) continue;
        if (options.json) console.answer_in_json(entry.name);
        return entry.action(options, console);
    }
    return cascade::exit_status::bug;
}

/// Whether an error in the command line must also be reported in JSON.
bool wants_json(const std::vector<std::string>& arguments) {
    constexpr std::array commands = {"check", "mesh", "run", "sweep", "systems"};
    return !arguments.empty() &&
           std::find(commands.begin(), commands.end(), arguments[0]) != commands.end() &&
           std::find(arguments.begin(), arguments.end(), "--json") != arguments.end();
}

}  // namespace

int main(int argc, char** argv) {
    // libedit finds the encoding through the locale. Numbers are read and written independently of
    // the locale.
    std::setlocale(LC_CTYPE, "");
    cascade::take_signals_of_writes_as_errors();
    auto console = cascade::Console::standard();
    try {
        const std::vector<std::string> arguments(argv + 1, argv + std::max(argc, 1));
        const auto parsed = cascade::parse_options("cascade", arguments);
        if (const auto* const leave = std::get_if<cascade::Leave>(&parsed)) {
            if (leave->status == cascade::exit_status::success) {
                console.print(leave->text);
            } else if (wants_json(arguments)) {
                console.answer_in_json(arguments[0]);
                console.fail({leave->text.substr(0, leave->text.find('\n')), ""});
            } else {
                console.say(leave->text);
            }
            return console.finish(leave->status);
        }
        const auto& options = std::get<cascade::Options>(parsed);
        cascade::limit_memory(options.run.simulation.memory_limit);
        return console.finish(run_chosen(options, console));
    } catch (...) {
        return console.finish(cascade::tell_of_exception(console));
    }
}

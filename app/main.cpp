// The program `cascade`: parses the options and runs a command.

#include "app/commands.h"
#include "app/exit_status.h"
#include "app/interrupt.h"
#include "app/limits.h"
#include "app/options.h"

#include <algorithm>
#include <array>
#include <clocale>
#include <exception>
#include <new>
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

/// Whether a wrong use of the command line is to be answered in JSON, too.
bool wants_json(const std::vector<std::string>& arguments) {
    constexpr std::array commands = {"check", "mesh", "run", "sweep", "systems"};
    return !arguments.empty() &&
           std::find(commands.begin(), commands.end(), arguments[0]) != commands.end() &&
           std::find(arguments.begin(), arguments.end(), "--json") != arguments.end();
}

}  // namespace

int main(int argc, char** argv) {
    // For libedit, which asks the locale for the encoding; numbers are read and written without it.
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
    } catch (const std::bad_alloc&) {
        console.fail({"there is not enough memory",
                      "a smaller grid, or fewer cells, need less; --limit-memory may allow more"});
        return console.finish(cascade::exit_status::failed_run);
    } catch (const std::exception& error) {
        console.fail({std::string("this should not have happened: ") + error.what(),
                      "it is a bug in Cascade"});
        return console.finish(cascade::exit_status::bug);
    }
}

// The table of commands.
#include "app/commands.h"

#include <array>

namespace cascade {

std::span<const CommandEntry> command_table() {
    using enum AtPrompt;
    static constexpr std::array<CommandEntry, 14> all = {{
        {Command::run, "run", run_command, absent},
        {Command::sweep, "sweep", sweep_command, of_script},
        {Command::check, "check", check_command, of_script},
        {Command::analyze, "analyze", analyze_command, of_script},
        {Command::bench, "bench", bench_command, of_script},
        {Command::compile, "compile", compile_command, of_script},
        {Command::systems, "systems", systems_command, plain},
        {Command::new_script, "new", new_command, absent},
        {Command::palettes, "palettes", palettes_command, plain},
        {Command::format, "fmt", format_command, absent},
        {Command::mesh, "mesh", mesh_command, plain},
        {Command::repl, "repl", repl_command, absent},
        {Command::view, "view", view_command, absent},
        {Command::export_page, "export", export_command, of_script},
    }};
    return all;
}

}  // namespace cascade

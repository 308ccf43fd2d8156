// The table of commands.
#include "app/command_options.h"
#include "app/commands.h"
#include "app/help.h"

#include <array>

namespace cascade {

std::span<const CommandEntry> command_table() {
    using enum AtPrompt;
    static const std::array<CommandEntry, 18> all = {{
        {Command::run, "run", run_command, absent, help::run, help::run_examples,
         command_options::run},
        {Command::sweep, "sweep", sweep_command, of_script, help::sweep, help::sweep_examples,
         command_options::sweep},
        {Command::follow, "continue", continue_command, of_script, help::follow,
         help::follow_examples, command_options::follow},
        {Command::check, "check", check_command, of_script, help::check, help::check_examples,
         command_options::check},
        {Command::analyze, "analyze", analyze_command, of_script, help::analyze,
         help::analyze_examples, command_options::analyze},
        {Command::bench, "bench", bench_command, of_script, help::bench, help::bench_examples,
         command_options::bench},
        {Command::compile, "compile", compile_command, of_script, help::compile,
         help::compile_examples, command_options::compile},
        {Command::systems, "systems", systems_command, plain, help::systems, help::systems_examples,
         command_options::systems},
        {Command::examples, "examples", examples_command, plain, help::examples_about,
         help::examples_examples, command_options::examples},
        {Command::new_script, "new", new_command, absent, help::new_script,
         help::new_script_examples, command_options::new_script},
        {Command::import_model, "import", import_command, absent, help::import_model,
         help::import_model_examples, command_options::import_model},
        {Command::palettes, "palettes", palettes_command, plain, help::palettes,
         help::palettes_examples, command_options::palettes},
        {Command::format, "fmt", format_command, absent, help::format, help::format_examples,
         command_options::format},
        {Command::mesh, "mesh", mesh_command, plain, help::mesh, help::mesh_examples,
         command_options::mesh},
        {Command::repl, "repl", repl_command, absent, help::repl, help::repl_examples,
         command_options::repl},
        {Command::export_page, "export", export_command, of_script, help::export_page,
         help::export_page_examples, command_options::export_page},
        {Command::view, "view", view_command, absent, help::view, help::view_examples,
         command_options::view},
        {Command::lsp, "lsp", lsp_command, absent, help::lsp, help::lsp_examples,
         command_options::lsp},
    }};
    return all;
}

}  // namespace cascade

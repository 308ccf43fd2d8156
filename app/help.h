// What --help says beside the lists of options, and what --version says.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cascade::help {

extern const std::string_view about;
extern const std::string_view examples;
extern const std::string_view run, run_examples;
extern const std::string_view sweep, sweep_examples;
extern const std::string_view check, check_examples;
extern const std::string_view bench, bench_examples;
extern const std::string_view compile, compile_examples;
extern const std::string_view systems, systems_examples;
extern const std::string_view new_script, new_script_examples;
extern const std::string_view format, format_examples;
extern const std::string_view mesh, mesh_examples;
extern const std::string_view repl, repl_examples;

/// Names in lines that fit beside the column of options.
std::string in_lines(const std::vector<std::string>& names);

std::string version_text();

}  // namespace cascade::help

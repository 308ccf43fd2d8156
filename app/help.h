// The text of --version, and the texts of --help except for the lists of options.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cascade::help {

extern const std::string_view about;
extern const std::string_view examples;
extern const std::string_view run, run_examples;
extern const std::string_view sweep, sweep_examples;
extern const std::string_view follow, follow_examples;
extern const std::string_view check, check_examples;
extern const std::string_view analyze, analyze_examples;
extern const std::string_view bench, bench_examples;
extern const std::string_view compile, compile_examples;
extern const std::string_view systems, systems_examples;
extern const std::string_view examples_about, examples_examples;
extern const std::string_view new_script, new_script_examples;
extern const std::string_view import_model, import_model_examples;
extern const std::string_view palettes, palettes_examples;
extern const std::string_view format, format_examples;
extern const std::string_view mesh, mesh_examples;
extern const std::string_view repl, repl_examples;
extern const std::string_view export_page, export_page_examples;
extern const std::string_view view, view_examples;
extern const std::string_view lsp, lsp_examples;

/// Joins names, divided into lines that fit into the column of descriptions.
std::string in_lines(const std::vector<std::string>& names);
/// Divides a text into lines that fit into the column of descriptions.
std::string in_lines(const std::string& text);

std::string version_text();

}  // namespace cascade::help

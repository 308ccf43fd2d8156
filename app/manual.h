// All commands and options as data: the content of --help, for manual pages and shell completions.
#pragma once

#include <string>
#include <vector>

namespace cascade {

/// An argument or option of a command.
struct ManualOption {
    std::vector<std::string> names;  ///< "-o", "--output". For an argument its name, "SCRIPT".
    std::string value;               ///< The name of its value: "FILE". Empty for a flag.
    std::string about;               ///< In lines, as --help prints it.
    std::string group;               ///< The heading in --help.
    bool is_repeatable = false;      ///< Whether an argument may be given several times.
};

struct ManualCommand {
    std::string name, about, examples;
    std::vector<ManualOption> arguments, options;
};

struct Manual {
    std::string about, examples;
    std::vector<ManualOption> options;
    std::vector<ManualCommand> commands;
};

/// Reads the table of commands and the options that each command defines (options.cpp).
Manual read_manual();

/// The manual pages, as roff with the macros of man(7). They name the version.
std::string man_page(const Manual& manual);
std::string man_page(const ManualCommand& command);

/// Scripts that complete commands, options, the words that an option accepts, and files.
std::string bash_completions(const Manual& manual);
std::string zsh_completions(const Manual& manual);
std::string fish_completions(const Manual& manual);

}  // namespace cascade

// All commands and options as data. From this content of --help, manual pages and shell completions
// are made.
#pragma once

#include <string>
#include <vector>

namespace cascade {

/// An argument or option of a command.
struct ManualOption {
    /// The names of an option, "-o" and "--output", or the name of an argument, "SCRIPT".
    std::vector<std::string> names;
    std::string value;           ///< The name of the option's value: "FILE". Empty for a flag.
    std::string about;           ///< The description, divided into lines as --help prints it.
    std::string group;           ///< The heading of --help below which the option is listed.
    bool is_repeatable = false;  ///< Whether an argument may be given several times.
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

/// Writes the manual pages as roff with the macros of man(7). They name the version.
std::string man_page(const Manual& manual);
std::string man_page(const ManualCommand& command);

/// Writes scripts that complete commands, options, the words that an option accepts, and files.
std::string bash_completions(const Manual& manual);
std::string zsh_completions(const Manual& manual);
std::string fish_completions(const Manual& manual);

}  // namespace cascade

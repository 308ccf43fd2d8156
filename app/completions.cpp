// Completions for bash, zsh and fish, made from the tables of --help.
#include "app/completed.h"
#include "app/manual.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace cascade {
namespace {

using Kind = Completed::Kind;

constexpr std::string_view origin = "# Made from the tables of 'cascade --help'.\n";

/// Returns the first sentence of a description, in one line.
std::string in_short(std::string about) {
    std::replace(about.begin(), about.end(), '\n', ' ');
    return about.substr(0, about.find_first_of(";"));
}

/// Puts a text into single quotes. `inner` replaces each quote inside the text, as the shell
/// requires.
std::string quoted(const std::string& text, std::string_view inner) {
    std::string out = "'";
    for (const char c : text) {
        if (c == '\'') out += inner;
        else out += c;
    }
    return out + "'";
}

std::string names_of(const std::vector<ManualOption>& options, std::string_view between) {
    std::vector<std::string> names;
    for (const ManualOption& option : options) {
        names.insert(names.end(), option.names.begin(), option.names.end());
    }
    return fmt::format("{}", fmt::join(names, between));
}

std::string names_of(const std::vector<ManualCommand>& commands) {
    std::vector<std::string> names;
    for (const ManualCommand& command : commands) names.push_back(command.name);
    return fmt::format("{}", fmt::join(names, " "));
}

/// Returns a command of bash that adds the possible values to COMPREPLY.
std::string in_bash(const Completed& values) {
    switch (values.kind) {
        case Kind::nothing: return ":";
        case Kind::words: return fmt::format("_cascade_words '{}'", fmt::join(values.words, " "));
        case Kind::folders: return "_cascade_files /";
        case Kind::files: return fmt::format("_cascade_files {}", fmt::join(values.endings, " "));
    }
    return "";
}

/// Returns the action of zsh's _arguments that completes the values.
std::string in_zsh(const Completed& values) {
    switch (values.kind) {
        case Kind::nothing: return " ";
        case Kind::words: return fmt::format("({})", fmt::join(values.words, " "));
        case Kind::folders: return "_files -/";
        case Kind::files:
            if (values.endings.empty()) return "_files";
            return fmt::format("_files -g \"*({})(-.)\"", fmt::join(values.endings, "|"));
    }
    return "";
}

/// Returns the options of fish's command `complete` that complete the values.
std::string in_fish(const Completed& values) {
    switch (values.kind) {
        case Kind::nothing: return " -x";
        case Kind::words: return fmt::format(" -x -a '{}'", fmt::join(values.words, " "));
        case Kind::folders: return " -x -a '(__fish_complete_directories)'";
        case Kind::files: break;
    }
    if (values.endings.empty()) return " -r -F";
    return fmt::format(" -x -a '(__cascade_files {})'", fmt::join(values.endings, " "));
}

/// Escapes a text for use between the brackets or colons of a specification for zsh's _arguments.
std::string within_zsh(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
        out += c;
    }
    return out;
}

std::string zsh_option(const ManualOption& option) {
    std::string lines;
    for (const std::string& name : option.names) {
        std::string spec = fmt::format("*{}[{}]", name, within_zsh(in_short(option.about)));
        if (!option.value.empty()) {
            spec += fmt::format(":{}:{}", within_zsh(option.value), in_zsh(values_of(option)));
        }
        lines += " \\\n      " + quoted(spec, "'\\''");
    }
    return lines;
}

std::string fish_option(const std::string& condition, const ManualOption& option) {
    std::string line = "complete -c cascade -n " + condition;
    for (const std::string& name : option.names) {
        line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    }
    if (!option.value.empty()) line += in_fish(values_of(option));
    return line + " -d " + quoted(in_short(option.about), "\\'") + "\n";
}

}  // namespace

std::string bash_completions(const Manual& manual) {
    std::string text(origin);
    text += R"(
# Adds the given words that begin like the word at the cursor.
_cascade_words() { mapfile -t COMPREPLY < <(compgen -W "$1" -- "$cur"); }

# Adds folders, and files with the given endings, or all files if there is none.
_cascade_files() {
    local ending
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -d -- "$cur"
        [ $# -gt 0 ] || compgen -f -- "$cur"
        for ending; do [ "$ending" = / ] || compgen -f -X "!*$ending" -- "$cur"; done)
}

_cascade() {
    local cur=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
    # bash divides --option=value into three words.
    if [ "$cur" = = ]; then cur=; elif [ "$before" = = ]; then before=${COMP_WORDS[COMP_CWORD - 2]}; fi
    COMPREPLY=()
    if [ "$COMP_CWORD" = 1 ]; then
)";
    text += fmt::format("        _cascade_words '{} {}'\n        return\n    fi\n",
                        names_of(manual.commands), names_of(manual.options, " "));
    text += "    case ${COMP_WORDS[1]} in\n";
    for (const ManualCommand& command : manual.commands) {
        text += fmt::format("    {})\n        case $before in\n", command.name);
        for (const ManualOption& option : command.options) {
            if (option.value.empty()) continue;
            text += fmt::format("        {}) {}; return ;;\n", fmt::join(option.names, "|"),
                                in_bash(values_of(option)));
        }
        text += fmt::format(
            "        esac\n        case $cur in\n        -*) _cascade_words '{}' ;;\n"
            "        *) {} ;;\n        esac ;;\n",
            names_of(command.options, " "), in_bash(arguments_of(command)));
    }
    return text + "    esac\n}\n\ncomplete -F _cascade cascade\n";
}

std::string zsh_completions(const Manual& manual) {
    std::string text = "#compdef cascade\n" + std::string(origin) + "\n_cascade() {\n";
    text += "  local -a commands\n  if (( CURRENT == 2 )); then\n    commands=(\n";
    for (const ManualCommand& command : manual.commands) {
        text += fmt::format("      {}\n",
                            quoted(command.name + ":" + within_zsh(command.about), "'\\''"));
    }
    text +=
        fmt::format("    )\n    _describe command commands\n    compadd -- {}\n    return\n  fi\n",
                    names_of(manual.options, " "));
    text += "  local command=$words[2]\n  shift words\n  (( CURRENT-- ))\n  case $command in\n";
    for (const ManualCommand& command : manual.commands) {
        text += fmt::format("    {})\n      _arguments", command.name);
        for (const ManualOption& option : command.options) text += zsh_option(option);
        for (const ManualOption& argument : command.arguments) {
            text += " \\\n      " +
                    quoted(fmt::format("{}:{}:{}", argument.is_repeatable ? "*" : "1",
                                       argument.names.front(), in_zsh(arguments_of(command))),
                           "'\\''");
        }
        text += " ;;\n";
    }
    return text + "  esac\n}\n\n_cascade \"$@\"\n";
}

std::string fish_completions(const Manual& manual) {
    std::string text(origin);
    text += R"(
# True if the command of the line is the given one.
function __cascade_command
    set -l words (commandline -opc)
    test (count $words) -ge 2; and test $words[2] = $argv[1]
end

# Lists folders, and files with the given endings.
function __cascade_files
    set -l word (commandline -ct)
    set -l word (string replace -r '^--[^=]*=' '' -- $word)
    for ending in / $argv
        for file in $word*$ending
            echo $file
        end
    end
end

complete -c cascade -f
)";
    for (const ManualCommand& command : manual.commands) {
        text += fmt::format("complete -c cascade -n __fish_use_subcommand -a {} -d {}\n",
                            command.name, quoted(in_short(command.about), "\\'"));
    }
    for (const ManualOption& option : manual.options) {
        text += fish_option("__fish_use_subcommand", option);
    }
    for (const ManualCommand& command : manual.commands) {
        const std::string condition = "'__cascade_command " + command.name + "'";
        text += "\n";
        const Completed values = arguments_of(command);
        if (values.kind != Kind::nothing) {
            text += "complete -c cascade -n " + condition + in_fish(values) + "\n";
        }
        for (const ManualOption& option : command.options) text += fish_option(condition, option);
    }
    return text;
}

}  // namespace cascade

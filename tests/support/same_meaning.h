// Is a script still the same after formatting? Asked by the tests of examples, specification and
// random scripts.
#pragma once

#include "lang/format/format_script.h"
#include "lang/syntax/parse.h"

#include <optional>
#include <sstream>
#include <string>

namespace cascade {

/// The syntax tree of a script as text, without the lines where its blocks began.
inline std::string tree_of(const std::string& text) {
    Sources sources;
    Diagnostics diagnostics;
    const SourceId source = sources.add("script.cascade", text);
    std::istringstream lines(print_ast(parse(source, sources, diagnostics), sources));
    std::string tree;
    for (std::string line; std::getline(lines, line);) {
        tree += line.substr(0, line.find("  # line ")) + '\n';
    }
    return tree;
}

/// What is wrong with the formatted form of a script that can be read; empty if nothing is.
inline std::string fault_of_formatting(const std::string& text) {
    const auto formatted = [](const std::string& script) {
        Sources sources;
        Diagnostics diagnostics;
        const SourceId source = sources.add("script.cascade", script);
        return format_script(source, sources, diagnostics);
    };
    const auto first = formatted(text);
    if (!first) return "it cannot be read:\n" + text;
    if (tree_of(*first) != tree_of(text)) return "it means something else:\n" + *first;
    const auto second = formatted(*first);
    if (second != first)
        return "a second run changes it:\n" + *first + "---\n" + second.value_or("");
    return "";
}

}  // namespace cascade

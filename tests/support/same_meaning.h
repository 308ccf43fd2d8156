// Checks that formatting keeps the meaning of a script. Used for examples, the specification and
// random scripts.
#pragma once

#include "lang/format/format_script.h"
#include "lang/syntax/parse.h"

#include <algorithm>
#include <optional>
#include <sstream>
#include <string>

namespace cascade::test {

/// The syntax tree of a script as text, without the line numbers of its blocks.
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

inline std::optional<std::string> formatted_in(ScriptNotation notation, const std::string& script) {
    Sources sources;
    Diagnostics diagnostics;
    const SourceId source = sources.add("script.cascade", script);
    return format_script(source, sources, diagnostics, notation);
}

/// The text without blanks, line ends and `;`, which formatting may exchange.
inline std::string without_layout(std::string text) {
    text.erase(std::remove_if(text.begin(), text.end(),
                              [](char c) { return c == ' ' || c == '\n' || c == ';'; }),
               text.end());
    return text;
}

/// Describes the first fault of the formatted form of a script without syntax errors, or returns an
/// empty text if there is no fault. The forms in ASCII and in the notation of papers must mean the
/// same, and converting a form to the other and back must not change it.
inline std::string fault_of_formatting(const std::string& text) {
    const std::string tree = tree_of(text);
    for (const ScriptNotation notation :
         {ScriptNotation::as_written, ScriptNotation::ascii, ScriptNotation::papers}) {
        const auto first = formatted_in(notation, text);
        if (!first) return "it cannot be read:\n" + text;
        if (tree_of(*first) != tree) return "it means something else:\n" + *first;
        for (const ScriptNotation again : {notation, ScriptNotation::as_written}) {
            const auto second = formatted_in(again, *first);
            if (second == first) continue;
            return "a second run changes it:\n" + *first + "---\n" + second.value_or("");
        }
    }
    const std::string ascii = formatted_in(ScriptNotation::ascii, text).value();
    const std::string papers = formatted_in(ScriptNotation::papers, ascii).value();
    const std::string back = formatted_in(ScriptNotation::ascii, papers).value();
    if (without_layout(back) != without_layout(ascii)) {
        return "the notation of papers does not lead back:\n" + papers + "---\n" + back;
    }
    return "";
}

}  // namespace cascade::test

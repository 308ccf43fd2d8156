// For tests of checker and lowering: a checked text, and its messages as short lines.
#pragma once

#include "lang/check/check.h"
#include "lang/syntax/parse.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace cascade::test {

/// A text and its result from the front end. Held by pointer, since views point into its sources.
struct Checked {
    Sources sources;
    Diagnostics diagnostics;
    ast::Script tree;
    std::optional<Program> program;

    /// "line:column: message | hint", in order. Warnings begin with "warning".
    std::vector<std::string> faults() const {
        std::vector<std::string> lines;
        for (const Diagnostic& fault : diagnostics.sorted()) {
            const Location place = sources[fault.span.source].locate(fault.span.begin);
            lines.push_back(fmt::format("{}:{}: {}{}{}{}", place.line, place.column,
                                        fault.severity == Severity::warning ? "warning: " : "",
                                        fault.message, fault.hint.empty() ? "" : " | ",
                                        fault.hint));
        }
        return lines;
    }
};

inline std::unique_ptr<Checked> check_text(const std::string& text,
                                           const std::vector<std::string>& overrides = {}) {
    auto result = std::make_unique<Checked>();
    const SourceId id = result->sources.add("test.cascade", text);
    result->tree = parse(id, result->sources, result->diagnostics);
    for (const std::string& change : overrides) {
        const SourceId line = result->sources.add("<command line>", change);
        parse_override(line, result->sources, result->tree, result->diagnostics);
    }
    result->program = check(result->tree, result->sources, result->diagnostics);
    return result;
}

/// Statements of a stage, for tests of other parts of a script.
inline constexpr const char* any_stage = "\nsystem_name: turing_spots\n";

/// The system of this name, which the script must have.
inline const System& system_named(const Program& program, std::string_view name) {
    for (const System& system : program.systems) {
        if (system.name == name && !system.built_in) return system;
    }
    ADD_FAILURE() << "there is no system " << name;
    return program.systems.front();
}

/// The number if a formula is a single number, otherwise a number that no test expects.
inline double only_number(const Formula& formula) {
    const auto* number = formula.nodes.front().as<double>();
    return formula.nodes.size() == 1 && number != nullptr ? *number : -1e300;
}

}  // namespace cascade::test

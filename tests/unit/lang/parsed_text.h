// For tests of the parser: a parsed text, its tree as text and its messages.
#pragma once

#include "lang/syntax/parse.h"
#include "script_faults.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace cascade::test {

struct Parsed {
    std::string tree;
    std::vector<std::string> faults;
    std::unique_ptr<Sources> sources;  ///< The script's words are views into these sources.
    ast::Script script;
};

inline Parsed parse_text(const std::string& text) {
    Parsed parsed;
    parsed.sources = std::make_unique<Sources>();
    Diagnostics diagnostics;
    const SourceId source = parsed.sources->add("test", text);
    parsed.script = parse(source, *parsed.sources, diagnostics);
    parsed.tree = print_ast(parsed.script, *parsed.sources);
    parsed.faults = list_faults(diagnostics, *parsed.sources);
    return parsed;
}

/// The tree of a text without faults.
inline std::string tree_of(const std::string& text) {
    const Parsed parsed = parse_text(text);
    EXPECT_THAT(parsed.faults, ::testing::IsEmpty()) << text;
    return parsed.tree;
}

/// An expression in prefix form.
inline std::string expression_of(const std::string& text) {
    const std::string tree = tree_of("system_name: s\nq: " + text);
    const std::string head = "system_name: s  # line 1\n    q: ";
    EXPECT_EQ(tree.substr(0, head.size()), head);
    return tree.substr(head.size(), tree.size() - head.size() - 1);
}

}  // namespace cascade::test

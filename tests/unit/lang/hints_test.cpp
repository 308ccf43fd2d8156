// Hints are true: if the text that a hint suggests is written into the script, the error
// disappears.
//
// A case is a script with an error, its hint, and the corrected script. If the hint contains the
// text itself (`write 'x'`, `did you mean 'x'?`), the test replaces the underlined text by it. If
// the hint leaves something open (`…`), the case contains what a reader would write. Every text in
// the sources that suggests a text must be the hint of a case, so none is forgotten. Hints that
// only explain are not tested here.
#include "check_helpers.h"
#include "hint_cases.h"
#include "hint_cases_of_checks.h"
#include "lang/service/advice.h"
#include "lang/vocabulary/words_elsewhere.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <sstream>
#include <set>
#include <vector>

namespace cascade::test {
namespace {

/// Scripts in which a case replaces `@`.
const std::map<std::string_view, std::string_view> frames{
    {"script", "@"},
    {"rate", "system s { u: 1; v: 1\n  u' = @\n  v' = 0 }\nstage a: s { }\n"},
    {"system", "system s { u: 1; v: 1; v' = u\n@\n}\nstage a: s { }\n"},
    {"stage", "system s { u: 1; v: 1; k: 2; u' = k * v; v' = u }\nstage a: s { @ }\n"},
    {"second", "system s { u: 1; v: 1; u' = v; v' = u }\nstage a: s { }\nstage b: s { @ }\n"},
    {"domain", "domain { @ }\nsystem s { u: 1; u' = 0 }\nstage a: s { }\n"},
    {"picture", "picture { @ }\nsystem s { u: 1; u' = 0 }\nstage a: s { }\n"},
    {"bent", "domain { surface: sx, sy, 0 }\nsystem s { u: 1; u' = @ }\nstage a: s { }\n"},
    {"shape", "shape s { @ }\nsystem r { u: 1; u' = 0 }\nstage a: r { }\n"},
    {"cells", "cells c { a: 1; b: 1; a' = b\n@\n}\n"},
    {"tissue",
     "domain { surface: sphere }\ncells c { a: 1; a' = 1 }\n"
     "stage one: c { founders: 1; duration: 1 }\nstage two: c { duration: 1 }\n"
     "stage s: c { @ }\n"},
    {"family", "system s { i: 1..3; u[i]: 1; k: 1\n@\n}\nstage a: s { }\n"},
};

std::string framed(std::string_view frame, std::string_view text) {
    std::string script(frames.at(frame));
    return script.replace(script.find('@'), 1, text);
}

std::optional<Diagnostic> find_hint(const Checked& checked, std::string_view hint) {
    for (const Diagnostic& each : checked.diagnostics.sorted()) {
        if (each.hint == hint) return each;
    }
    return std::nullopt;
}

std::unique_ptr<Checked> check_option(const std::string& change) {
    return check_text(framed("stage", ""), {change});
}

void expect_sound(const std::string& script, std::unique_ptr<Checked> checked,
                  const Diagnostic& fault) {
    EXPECT_FALSE(checked->diagnostics.has_errors())
        << script << ::testing::PrintToString(checked->faults());
    for (const Diagnostic& each : checked->diagnostics.sorted()) {
        EXPECT_NE(each.message, fault.message) << script;
    }
}

std::vector<HintCase> all_cases() {
    std::vector<HintCase> cases(std::begin(hint_cases), std::end(hint_cases));
    cases.insert(cases.end(), std::begin(hint_cases_of_checks), std::end(hint_cases_of_checks));
    return cases;
}

TEST(Hints, MendWhatTheyStandAt) {
    for (const HintCase& each : all_cases()) {
        const bool is_option = each.frame == "set";  // The text is the value of --set.
        const std::string before(is_option ? std::string(each.before)
                                           : framed(each.frame, each.before));
        auto checked = is_option ? check_option(before) : check_text(before);
        const auto fault = find_hint(*checked, each.hint);
        if (!fault) {
            ADD_FAILURE() << before << "\nhas no hint " << each.hint << ", but "
                          << ::testing::PrintToString(checked->faults());
            continue;
        }
        std::string after(is_option ? std::string(each.after) : framed(each.frame, each.after));
        if (each.after.empty()) {
            after = before;
            after.replace(fault->span.begin, fault->span.end - fault->span.begin,
                          text_to_write(fault->hint));
        }
        expect_sound(after, is_option ? check_option(after) : check_text(after), *fault);
    }
}

/// The frame for words of a context and for their advice.
std::string_view frame_of(WordContext context) {
    switch (context) {
        case WordContext::stage:
        case WordContext::statement: return "stage";
        case WordContext::picture: return "picture";
        case WordContext::function:
        case WordContext::value: return "rate";
        default: return "domain";
    }
}

std::string used(WordContext context, std::string_view word) {
    switch (context) {
        case WordContext::boundary: return fmt::format("boundary: {}", word);
        case WordContext::side: return fmt::format("sides: {}", word);
        case WordContext::precision: return fmt::format("precision: {}", word);
        case WordContext::function: return fmt::format("{}(u)", word);
        case WordContext::value: return std::string(word);
        case WordContext::statement: return fmt::format("{} q", word);
        // The value is not a single number, because the advice would repeat a single number.
        default: return fmt::format("{}: 1 + 1", word);
    }
}

std::string advised(WordContext context, const std::string& advice) {
    const std::string text(text_to_write(advice));
    const std::string_view frame = frame_of(context);
    // The advice may be another block, in place of the statement.
    for (const char* block : {"stage ", "domain ", "picture "}) {
        if (text.starts_with(block)) return framed(frame, "") + text + "\n";
    }
    if (advice.starts_with("did you mean")) {
        const std::set<std::string_view> of_two{"min", "max", "random", "normal", "mod"};
        if (of_two.contains(text)) return framed(frame, text + "(u, v)");
        if (text == "mix") return framed(frame, "mix(u, v, 0.5)");
        if (text == "div") return framed(frame, "div(grad(u))");
        if (text == "grad") return framed(frame, "div(grad(u))");
        return framed(frame, text + "(u)");
    }
    const bool is_setting = text.find(": ") != std::string::npos;
    if (context == WordContext::boundary && !is_setting) return framed(frame, "boundary: " + text);
    if (context == WordContext::side && !is_setting) return framed(frame, "sides: " + text);
    if (context == WordContext::precision) return framed(frame, "precision: " + text);
    // The advice on functions of vectors calls the vector v, but v is a number in the frame.
    if (context == WordContext::function && text.ends_with("(v)")) {
        const std::string of_vector = text.substr(0, text.size() - 2) + "vector(u, v))";
        return framed(frame, text.starts_with("unit") ? "div(" + of_vector + ")" : of_vector);
    }
    return framed(frame, text);
}

/// For every word of other programs, the advice is correct in a script.
TEST(Hints, KnowTheWordsOfOthers) {
    for (const WordElsewhere& row : words_elsewhere()) {
        std::istringstream words{std::string(row.words)};
        const std::string advice(row.advice);
        for (std::string word; words >> word;) {
            const std::string before = framed(frame_of(row.context), used(row.context, word));
            const auto checked = check_text(before);
            const auto fault = find_hint(*checked, advice);
            if (!fault) {
                ADD_FAILURE() << before << ::testing::PrintToString(checked->faults());
                continue;
            }
            if (text_to_write(advice).empty()) continue;  // Advice that only explains.
            const std::string after = advised(row.context, advice);
            expect_sound(after, check_text(after), *fault);
        }
    }
}

std::string unescaped(const std::string& literal) {
    std::string text;
    for (std::size_t k = 0; k < literal.size(); ++k) {
        if (literal[k] == '\\' && k + 1 < literal.size()) ++k;
        text += literal[k];
    }
    return text;
}

/// Whether a hint begins with this text of the sources, in which `{…}` stands for anything.
bool begins(std::string text, std::string_view hint) {
    text = std::regex_replace(text, std::regex(R"(\{\{|\}\})"), "\x01");  // A literal bracket.
    std::size_t place = 0;
    const std::regex hole(R"(\{[0-9]*\})");
    for (auto piece = std::sregex_token_iterator(text.begin(), text.end(), hole, -1);
         piece != std::sregex_token_iterator(); ++piece) {
        std::string words = *piece;
        std::replace(words.begin(), words.end(), '\x01', '{');
        const std::size_t found = hint.find(words, place);
        if (found == std::string_view::npos || (piece->first == text.begin() && found != 0)) {
            return false;
        }
        place = found + words.size();
    }
    return true;
}

/// The texts of the sources that suggest a text.
std::set<std::string> hints_in_sources() {
    const std::regex literal(R"re("((?:[^"\\]|\\.)*)")re");
    const std::regex tells(
        "^(write|add|put|did you mean|leave|take|join|choose|give|make|save) "
        "|: write |is written (?!with)|, as in |^as in ");
    std::set<std::string> texts;
    const std::filesystem::recursive_directory_iterator front_end(CASCADE_SOURCE_DIR "/lang");
    for (const auto& entry : front_end) {
        const std::string name = entry.path().filename().string();
        // Rows of these tables have a test of their own. Printed trees are no hints. Hints on
        // tables of numbers need files, so tests/table_functions_test.sh tests them.
        if (name.starts_with("words_elsewhere") || name.starts_with("print_") ||
            name.starts_with("describe_") || name.starts_with("parse_table")) {
            continue;
        }
        if (!entry.is_regular_file()) continue;
        std::ifstream file(entry.path());
        for (std::string line; std::getline(file, line);) {
            if (line.find_first_not_of(' ') == line.find("//")) continue;
            for (auto each = std::sregex_iterator(line.begin(), line.end(), literal);
                 each != std::sregex_iterator(); ++each) {
                const std::string text = unescaped((*each)[1]);
                if (std::regex_search(text, tells)) texts.insert(text);
            }
        }
    }
    return texts;
}

TEST(Hints, AreAllTried) {
    const std::set<std::string> texts = hints_in_sources();
    const std::vector<HintCase> cases = all_cases();
    EXPECT_GT(texts.size(), 60u);
    for (const std::string& text : texts) {
        const bool is_tried = std::any_of(cases.begin(), cases.end(), [&](const HintCase& each) {
            return begins(text, each.hint);
        });
        EXPECT_TRUE(is_tried) << "no case of hint_cases.h has this hint: " << text;
    }
}

}  // namespace
}  // namespace cascade::test

// Every function and operator at every position that takes an expression: each of these scripts is
// a program or gets a message. Most have errors.
#include "lang/vocabulary/functions.h"
#include "lang/vocabulary/settings.h"
#include "sound_check.h"
#include "support/last_script.h"

#include <gtest/gtest.h>

namespace cascade::test {
namespace {

/// A call with as many of these arguments as the function takes.
std::string call_of(const FunctionInfo& row, const std::string& first, const std::string& other) {
    const auto count = static_cast<std::size_t>(row.arity.least);
    if (row.spelling.starts_with('(')) return "";  // Only lowering makes it.
    if (const auto over = row.spelling.find(" over "); over != std::string_view::npos) {
        const std::string word(row.spelling.substr(over + 6));
        return fmt::format("{}({} over {})", row.spelling.substr(0, over), first,
                           word == "near" ? fmt::format("near({})", other) : word);
    }
    if (row.is_operator) {
        return count == 1 ? fmt::format("{} {}", row.spelling, first)
                          : fmt::format("{} {} {}", first, row.spelling, other);
    }
    std::string text = fmt::format("{}({}", row.spelling, first);
    for (std::size_t k = 1; k < count; ++k) text += ", " + other;
    return text + ")";
}

std::vector<std::string> all_expressions() {
    // clang-format off
    std::vector<std::string> all{
        "1", "x", "u", "[u]", "a.u", "u'", "u[1]", "w[i]", "b", "t", "ex", "touching", "\"u\"", "domain.x",
        "own(u)", "b(1)", "push(1)", "f(x)", "unknown", "1 +", "vector(1, u)", "vector(1, 2, 3).z",
        "integral(1 over domain)", "sum(w[i] over i)", "product(x over i)", "mean(x over j)",
        "convolve(distance, x, u)", "convolve(f(distance), u)", "field(\"a.npy\", x, y)",
        "along(axis(1, 0, u))", "along(image(\"a.png\"))", "if(x, vector(1, 2), vector(3, 4))"};
    // clang-format on
    for (std::size_t k = 0; k < function_count; ++k) {
        const FunctionInfo& row = info(static_cast<Function>(k));
        const bool reads_text = row.kind == FunctionKind::text;
        for (const std::string& text :
             {call_of(row, reads_text ? "\"a.npy\"" : "1", "0.5"),
              call_of(row, row.spelling == "convolve" ? "distance" : "u", "x"),
              call_of(row, "vector(u, 1)", "vector(1, 2)")}) {
            if (!text.empty()) all.push_back(text);
        }
    }
    return all;
}

/// Scripts with a # in place of the tested expression.
std::vector<std::string> all_places() {
    const std::string fields =
        "fn f(x) = 2 * x\nsystem s { i: 1..2; u: x; w[i]: i; b = 2*u; u' = lap(u); w[i]' = w[i] }\n";
    const std::string run = "stage a: s { iterations: 2 }\n";
    const std::string cells = "cells c { u: 1; u' = lap(u); b = 2 * u; p' += push(3)";
    std::vector<std::string> places;
    for (const SettingInfo& row : setting_rows()) {
        switch (row.block) {
            case SettingBlock::domain:
            case SettingBlock::side:
                places.push_back(fmt::format("domain {{ {}: # }}", row.word));
                if (row.domains == Domains::model) {
                    places.push_back(fmt::format("domain {{ surface: torus; {}: # }}", row.word));
                }
                break;
            case SettingBlock::stage:
            case SettingBlock::field_stage:
                places.push_back(fmt::format("{}stage a: s {{ {}: # }}", fields, row.word));
                break;
            case SettingBlock::cells:
                places.push_back(
                    fmt::format("{}; {}: # }}\nstage a: c {{ founders: 2 }}", cells, row.word));
                break;
            case SettingBlock::cell_stage:
                places.push_back(fmt::format("{} }}\nstage a: c {{ {}: # }}", cells, row.word));
                break;
            case SettingBlock::picture:
                places.push_back(fmt::format("{}{}picture {{ {}: # }}", fields, run, row.word));
                places.push_back(fmt::format(
                    "{} }}\nstage a: c {{ founders: 2 }}\npicture {{ {}: # }}", cells, row.word));
                break;
            case SettingBlock::system:
                places.push_back(fmt::format("system s {{ u: 1; u' = 1; {}: # }}", row.word));
                break;
        }
    }
    for (const char* text :
         {"domain { surface: x, y, # }", "domain { surface: implicit(#) }",
          "domain { surface: implicit(1 - x^2 - y^2 - z^2, #) }", "domain { surface: torus(#, 1) }",
          "domain { grid: 8, # }", "domain { grid: 8, 8; extent: 8, # }", "domain { mask: # }",
          "domain { left: fixed(#) }", "domain { left: slope(#) }", "domain { left: flux(#) }",
          "domain { surface: sphere; directions: gradient(#) }",
          "domain { surface: sphere; directions: axis(0, 1, #) }",
          "domain { surface: sphere; directions: keys(0, 0, 0, 1, 0, #) }",
          "let c = #\ndomain { grid: c }", "let c = #\ndomain { surface: x, y, c }",
          "fn g(x) = #\ndomain { spacing: g(1) }", "domain { mask: 1; border: fixed(#) }"}) {
        places.emplace_back(text);
    }
    for (const char* text : {"system d: s { u' += # }",
                             "system d: s { u: # }",
                             "system d: s { b = # }",
                             "system d: s { u'' = # }",
                             "system d: s { u >= # }",
                             "system d: s { u <= # }",
                             "system d: s { q: # in 0..1 }",
                             "system d: s { q: 1 in #..2 }",
                             "system d: s { k: 1..# }",
                             "system d: s { w[i]: # }",
                             "system d: s { w[i]' = # }",
                             "system d: s { w[1]: # }",
                             "system d: s { u' += w[#] }",
                             "system d: s { u' += sum(# over i) }",
                             "system d: s { 0 = lap(q) - # }",
                             "system d: s { q = #; u' += dot(q, q) }",
                             "system d: s { u' += convolve(#, u) }",
                             "system d: s { u' += convolve(distance, #) }",
                             "system d: s { u' += convolve(distance, u, #) }",
                             "system d: s { u.left: fixed(#) }",
                             "system d: s { u.right: flux(#) }",
                             "system d: s { u' += field(\"a.npy\", #, 0) }",
                             "system d: s { u: image(\"a.png\", #, 0) }",
                             "fn g(x) = #\nsystem d: s { u' += g(u) }",
                             "let c = #\nsystem d: s { u' += c }"}) {
        places.push_back(fmt::format("{}{}\nstage a: d {{ iterations: 1 }}", fields, text));
    }
    for (const char* text : {"u: #", "frozen: #", "w[i]: #", "w[2]: #", "u.top: slope(#)",
                             "grid: coarse(#)", "start: coarse(#)", "until: steady(#)"}) {
        places.push_back(fmt::format("{}{}stage z: s {{ {} }}", fields, run, text));
    }
    for (const char* text : {"u = #",
                             "u' = #",
                             "u'' = #",
                             "u' += #",
                             "p' = #",
                             "turn' += #",
                             "age' = #",
                             "ex' = #",
                             "r: #",
                             "age: #",
                             "u: # after divide",
                             "ey: #",
                             "v: #",
                             "v = #; u' += v",
                             "v >= #",
                             "b' = #",
                             "u' += sum(# over touching)",
                             "u' += mean(x over near(#))",
                             "0 = #",
                             "0 = lap(q) - #",
                             "k: 1..#"}) {
        places.push_back(fmt::format("{}; {} }}\nstage a: c {{ founders: 2 }}", cells, text));
    }
    for (const char* text : {"founders: 3, #", "founders: keys(0, 0, #)", "founders: #", "r: #",
                             "u: #", "remove: #", "ez: #", "body: a.u - #"}) {
        places.push_back(fmt::format("{}{}{} }}\nstage z: c {{ {} }}", fields, run, cells, text));
    }
    for (const char* text :
         {"parts: #", "middle = #", "radius = #", "place = #", "shade = #", "q: #", "q = #"}) {
        places.push_back(
            fmt::format("shape g {{ {} }}\n{} }}\nstage a: c {{ founders: 2 }}\n"
                        "picture {{ shape: g }}",
                        text, cells));
    }
    return places;
}

TEST(EveryPlace, TakesOrRefusesEveryExpression) {
    LastScript last;
    const std::vector<std::string> expressions = all_expressions();
    // To save time, each position is tested with only two of three expressions, and so at least
    // once with each function.
    std::size_t right = 0, count = 0, turn = 0;
    for (const std::string& place : all_places()) {
        const std::size_t at = place.find('#');
        for (std::size_t k = 0; k < expressions.size(); ++k) {
            if ((k + turn) % 3 == 0) continue;
            const std::string text = std::string(place).replace(at, 1, expressions[k]);
            last.tell(text);
            right += is_checked_soundly(text) ? 1 : 0;
            ++count;
        }
        ++turn;
    }
    std::printf("%zu of %zu scripts are programs\n", right, count);
    EXPECT_GT(right, count / 20) << "the places are wrong by themselves";
}

}  // namespace
}  // namespace cascade::test

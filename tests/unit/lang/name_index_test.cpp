// Declarations, uses and new names by position, and the outline of a script.
#include "lang/service/name_index.h"

#include "lang/library/library.h"
#include "lang/service/symbols.h"
#include "lang/syntax/parse.h"
#include "lang/vocabulary/settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cascade::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A text in which `|` marks a position.
class Asked {
public:
    explicit Asked(std::string marked, std::string used = "")
        : Asked(std::string(marked).erase(marked.find('|'), 1), marked.find('|'), std::move(used)) {
    }
    Asked(std::string text, std::size_t byte, std::string used)
        : byte_(static_cast<std::uint32_t>(byte)) {
        const SourceId source = sources_.add("asked.cascade", std::move(text));
        Diagnostics diagnostics;
        tree_ = parse(source, sources_, diagnostics);
        if (!used.empty()) {
            parse_used(sources_.add("used.cascade", std::move(used)), sources_, tree_, diagnostics);
        }
        index_ = std::make_unique<NameIndex>(tree_, diagnostics, sources_, source);
    }

    /// The lines of all uses, from 1.
    std::vector<std::uint32_t> lines() const {
        std::vector<std::uint32_t> lines;
        for (const Span use : index_->uses_at(byte_)) {
            lines.push_back(sources_[use.source].locate(use.begin).line);
        }
        return lines;
    }
    /// "asked.cascade:2:3", or "" where there is no name.
    std::string declaration() const {
        const auto span = index_->declaration_at(byte_);
        if (!span) return "";
        const Location at = sources_[span->source].locate(span->begin);
        return sources_[span->source].name() + ":" + std::to_string(at.line) + ":" +
               std::to_string(at.column);
    }
    Result<std::string> renamed(std::string_view name) const {
        return index_->renamed(byte_, name);
    }
    std::vector<Symbol> symbols() const { return symbols_of(tree_, 0); }

private:
    std::uint32_t byte_ = 0;
    Sources sources_;
    ast::Script tree_;
    std::unique_ptr<NameIndex> index_;
};

constexpr const char* two_systems =
    "system a {\n"
    "  u: 1\n"
    "  k: 2\n"
    "  d = k * u\n"
    "  u' = d - u\n"
    "  u >= 0\n"
    "}\n"
    "system b: a { k: 3 }\n"
    "stage one: a { u: noise(0, 1) + 1 }\n"
    "stage two: b { u: one.u; k: 4 }\n"
    "picture { color: grey(d) }\n";

std::string with_mark(std::string text, std::string_view before) {
    return text.insert(text.find(before), "|");
}

TEST(NameIndex, FindsAllUsesOfAQuantity) {
    EXPECT_THAT(Asked(with_mark(two_systems, "k: 2")).lines(), ElementsAre(3, 4, 8, 10));
    EXPECT_THAT(Asked(with_mark(two_systems, "k * u")).lines(), ElementsAre(3, 4, 8, 10));
    EXPECT_THAT(Asked(with_mark(two_systems, "k: 4")).lines(), ElementsAre(3, 4, 8, 10));
    EXPECT_THAT(Asked(with_mark(two_systems, "u >= 0")).lines(),
                ElementsAre(2, 4, 5, 5, 6, 9, 10, 10));
    EXPECT_THAT(Asked(with_mark(two_systems, "d - u")).lines(), ElementsAre(4, 5, 11));
}

TEST(NameIndex, FindsNamesInATextWithSyntaxErrors) {
    // The block ends before the rate of u, so the system is incomplete.
    const Asked asked("system s { u: 1; |k: 2; stage u' = -k * u }\nstage one: s { u: 2 }\n");
    EXPECT_EQ(asked.declaration(), "asked.cascade:1:18");
}

TEST(NameIndex, FindsSystemsAndStages) {
    EXPECT_THAT(Asked(with_mark(two_systems, "a { k: 3")).lines(), ElementsAre(1, 8, 9));
    EXPECT_THAT(Asked(with_mark(two_systems, "one.u")).lines(), ElementsAre(9, 10));
    EXPECT_EQ(Asked(with_mark(two_systems, "b { u")).declaration(), "asked.cascade:8:8");
}

TEST(NameIndex, FindsTheDeclarationThatCounts) {
    EXPECT_EQ(Asked(with_mark(two_systems, "k * u")).declaration(), "asked.cascade:3:3");
    EXPECT_EQ(Asked(with_mark(two_systems, "k: 4")).declaration(), "asked.cascade:8:15");
    EXPECT_EQ(Asked(with_mark(two_systems, "noise")).declaration(), "");
    EXPECT_EQ(Asked("# |u").declaration(), "");
    EXPECT_THAT(Asked("# |u").lines(), IsEmpty());
}

TEST(NameIndex, FindsFunctionsParametersConstantsAndIndices) {
    const std::string text =
        "fn bump(r, w) = exp(-(r/w)^2) * L\n"
        "let L = 2\n"
        "system s {\n"
        "  i: 1..3\n"
        "  r: L\n"
        "  u[i]: bump(r, 2)\n"
        "  u[i]' = bump(u[i], L) + sum(u[i] over i)\n"
        "}\n"
        "stage one: s { }\n";
    EXPECT_THAT(Asked(with_mark(text, "bump(r, w)")).lines(), ElementsAre(1, 6, 7));
    EXPECT_THAT(Asked(with_mark(text, "r/w")).lines(), ElementsAre(1, 1));
    EXPECT_THAT(Asked(with_mark(text, "r: L")).lines(), ElementsAre(5, 6));
    EXPECT_THAT(Asked(with_mark(text, "L = 2")).lines(), ElementsAre(1, 2, 5, 7));
    EXPECT_THAT(Asked(with_mark(text, "i: 1")).lines(), ElementsAre(4, 6, 7, 7, 7, 7));
    EXPECT_THAT(Asked(with_mark(text, "u[i]'")).lines(), ElementsAre(6, 7, 7, 7));
}

TEST(NameIndex, RenamesNamesBelowWhichAxesAreWritten) {
    const std::string text =
        "fn bend(e) = e_xx\n"
        "system s { u: 1; φ: 1; c_x: 2; c: 1; u' = u_xx + φ_x + c_x; φ' = bend(u); c' = 0 }\n"
        "stage one: s { }\n";
    const auto new_text = [&](std::string_view before) {
        return Asked(with_mark(text, before)).renamed("w").value_or("");
    };
    EXPECT_THAT(new_text("e)"), HasSubstr("bend(w) = w_xx"));
    EXPECT_THAT(new_text("u: 1"), HasSubstr("w' = w_xx + φ_x + c_x; φ' = bend(w)"));
    EXPECT_THAT(new_text("φ: 1"), HasSubstr("u_xx + w_x + c_x; w' ="));
    EXPECT_THAT(new_text("c: 1"), HasSubstr("c_x: 2; w: 1; u' = u_xx + φ_x + c_x;"));
}

TEST(NameIndex, RenamesEverywhereAndNothingElse) {
    const auto text = Asked(with_mark(two_systems, "k: 2")).renamed("rate");
    ASSERT_TRUE(text);
    std::string expected = two_systems;
    for (const char* use : {"k: 2", "k * u", "k: 3", "k: 4"})
        expected.replace(expected.find(use), 1, "rate");
    EXPECT_EQ(*text, expected);
    EXPECT_EQ(Asked("system s { |β: 1; u: 2; u' = β }\nstage t: s { β: 3 }\n").renamed("γ").value(),
              "system s { γ: 1; u: 2; u' = γ }\nstage t: s { γ: 3 }\n");
    EXPECT_EQ(Asked("system s { |u: 1; u'' = -u }\nstage t: s { }\n").renamed("v").value(),
              "system s { v: 1; v'' = -v }\nstage t: s { }\n");
}

TEST(NameIndex, RenamesEverythingThatTheLibraryDeclares) {
    std::size_t count = 0;
    for (const LibraryText& text : library_texts()) {
        const std::string whole(text.text);
        for (const Symbol& symbol : Asked(whole, 0, "").symbols()) {
            if (symbol.kind != NameKind::system) continue;
            for (const Symbol& inside : symbol.inside) {
                if (setting_named(inside.name)) continue;
                const Asked asked(whole, inside.name_span.begin, "");
                const auto renamed = asked.renamed("name_of_a_test");
                count += renamed ? 1U : 0U;
                if (renamed) continue;
                // The name is declared in a base, in another text of the library.
                EXPECT_THAT(renamed.error().message, HasSubstr("is also a name in"))
                    << text.system_name() << "." << inside.name;
            }
        }
    }
    EXPECT_GT(count, 200U);
}

TEST(NameIndex, RefusesNamesThatMeanSomethingElse) {
    const Asked k(with_mark(two_systems, "k: 2"));
    for (const char* taken : {"u", "d", "pi", "iterations", "x"}) {
        EXPECT_FALSE(k.renamed(taken)) << taken;
    }
    for (const char* wrong : {"", "2k", "a b", "a.b"}) {
        EXPECT_THAT(k.renamed(wrong).error().message, HasSubstr("is not a name")) << wrong;
    }
    EXPECT_TRUE(k.renamed("a"));  // A system and a parameter may have the same name.
    const Asked parameter("fn f(r|, w) = r * w\nsystem s { u: f(1, 2); u' = u }\nstage t: s { }\n");
    EXPECT_FALSE(parameter.renamed("w"));
    EXPECT_TRUE(parameter.renamed("v"));
    EXPECT_THAT(Asked("stage one: gray_scott { |feed: 0.03 }").renamed("G").error().message,
                HasSubstr("'feed' is also a name in"));
    const Asked used("use \"used.cascade\"\nstage one: |s { }\n", "system s { u: 1; u' = -u }\n");
    EXPECT_EQ(used.declaration(), "used.cascade:1:8");
    EXPECT_THAT(used.renamed("t").error().message, HasSubstr("used.cascade"));
}

TEST(NameIndex, AnswersForScriptsWithErrors) {
    const Asked asked("system s { u: 1; |k: 2; u' = k * missing + k }\nstage t: s { k: (\n");
    EXPECT_THAT(asked.lines(), ElementsAre(1, 1, 1, 2));
}

TEST(Symbols, AreBlocksAndWhatTheyDeclare) {
    const auto symbols = Asked(std::string("|fn f(r) = r\n") + two_systems).symbols();
    std::vector<std::string> outline;
    for (const Symbol& symbol : symbols) {
        std::string line(name_of(symbol.kind));
        line += " " + symbol.name + ":";
        for (const Symbol& inside : symbol.inside) line += " " + inside.name;
        outline.push_back(std::move(line));
    }
    EXPECT_THAT(outline, ElementsAre("function f:", "system a: u k d", "system b: k",
                                     "stage one: u", "stage two: u k", "keyword picture: color"));
    EXPECT_EQ(symbols[1].inside[0].kind, NameKind::species);
    EXPECT_EQ(symbols[1].inside[1].kind, NameKind::parameter);
}

}  // namespace
}  // namespace cascade::test

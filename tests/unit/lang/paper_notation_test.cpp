// The notation of papers: its tokens, their positions, and ambiguous cases.
#include "lang/syntax/paper_notation.h"

#include "lang/format/format_script.h"
#include "lang/vocabulary/greek_letters.h"
#include "script_faults.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace cascade {
namespace {

/// The tokens without blanks between them, followed by the error messages.
std::string read(const std::string& text) {
    Sources sources;
    Diagnostics diagnostics;
    std::string result;
    for (const Token& token : lex(sources.add("test", text), sources, diagnostics)) {
        result += token.kind == TokenKind::newline ? "\n" : token.text;
    }
    for (const std::string& fault : list_faults(diagnostics, sources)) result += " ! " + fault;
    return result;
}

std::string formatted(const std::string& statement, ScriptNotation notation) {
    Sources sources;
    Diagnostics diagnostics;
    const std::string before = "system s {\n  ", after = "\n}\n";
    const SourceId source = sources.add("test", before + statement + after);
    const auto result = format_script(source, sources, diagnostics, notation);
    if (!result) return "cannot be read";
    return result->substr(before.size(), result->size() - before.size() - after.size());
}

TEST(PaperNotation, IsReadAsTokensOfTheLanguage) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"∂u/∂t = D ∇²u + u²v", "u'=D*lap(u)+u^2*v"},
        {"∂u[i]/∂t += e", "u[i]'+=e"},
        {"∂ u / ∂ t", "u'"},
        {"u′ − a·b × c ⋅ d", "u'-a*b*c*d"},
        {"∂u/∂x·∂²u/∂x² − ∂²v/∂x∂y + ∂²v/∂z∂y", "dx(u)*dxx(u)-dxy(v)+dyz(v)"},
        {"k∂u/∂y", "k*dy(u)"},
        {"Δu + ∆v + Δ²w + ∇⁴u", "lap(u)+lap(v)+lap(lap(w))+lap(lap(u))"},
        {"∇·(c∇u)", "div(c*grad(u))"},
        {"∇·∇∇²u", "div(grad(lap(u)))"},
        {"∇²u[i + 1]", "lap(u[i+1])"},
        {"∇²u′", "lap(u')"},
        {"∇²large.u + ∇²[u]", "lap(large.u)+lap([u])"},
        {"∇⁴(u + v)", "lap(lap(u+v))"},
        {"∇²max(u, ∇²v)", "lap(max(u,lap(v)))"},
        {"√2 + √u + √(a² + b²)", "sqrt(2)+sqrt(u)+sqrt(a^2+b^2)"},
        {"u⁻¹² v", "u^-12*v"},
        {"10⁻³u", "10^-3*u"},
        {"u²(1 − v)³w", "u^2*(1-v)^3*w"},
        {"[u]²v + u[1]²v + u′²v", "[u]^2*v+u[1]^2*v+u'^2*v"},
        {"2√u + (a)∇²u", "2*sqrt(u)+(a)*lap(u)"},
        {"(1/2)∇²u − a/b + c ∇²u", "(1/2)*lap(u)-a/b+c*lap(u)"},
        {"mean(u² over domain)", "mean(u^2overdomain)"},
        {"a: 1 in √2 .. 3 step √2", "a:1insqrt(2)..3stepsqrt(2)"},
        {"a = u²\nv: 1", "a=u^2\nv:1"},
        {"a ≤ b ≥ c ≠ d =\u0338 e ∧ ¬f ∨ g", "a<=b>=c!=d!=eandnotforg"},
        {"β + diff_α2 + k₁₂ + Ω", "beta+diff_alpha2+k12+Omega"},
        {"µ + ϵ + ϕ + ϑ + \u2126", "mu+epsilon+phi+theta+Omega"},
        {"αβ", "alphabeta"},
    };
    for (const auto& [papers, ascii] : cases) EXPECT_EQ(read(papers), ascii) << papers;
}

TEST(PaperNotation, ReportsWhatCouldBeReadInTwoWays) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"∇²u²", "1:4 it is unclear what is raised to the power"},
        {"∇²u^2", "1:4 it is unclear what is raised to the power"},
        {"∇²(u)²", "1:6 it is unclear what is raised to the power"},
        {"∂u/∂x²", "1:6 it is unclear what is raised to the power"},
        {"∇·D∇u", "1:4 it is not clear what is multiplied before '∇'"},
        {"∇²u ∇²v", "1:5 it is not clear what is multiplied before '∇'"},
        {"a/b ∇²u", "1:5 it is not clear what is multiplied before '∇'"},
        {"a/b²c", "1:5 it is not clear what is multiplied before 'c'"},
        {"a/∂u/∂x", "1:3 it is unclear what is divided"},
        {"sin²(u)", "1:1 the power of a function must follow its brackets"},
        {"u²^3", "1:3 it is unclear which power comes first"},
        {"u ²", "1:3 a raised exponent must directly follow its base"},
        {"a + ²", "1:5 a raised exponent must directly follow its base"},
        {"u⁻", "1:2 a raised exponent must directly follow its base"},
        {"∇³u", "1:1 '∇³' is not an operator of the language"},
        {"Δx", "1:1 Δ is the Laplacian and cannot be part of a width"},
        {"a + ∇", "1:5 the operand of '∇' is missing"},
        {"∇×u", "1:1 there is no curl in the language"},
        {"∂u", "1:1 this derivative is not part of the language"},
        {"∂u/∂τ", "1:1 this derivative is not part of the language"},
        {"∂²u/∂x∂t", "1:1 this derivative is not part of the language"},
        {"2β", "1:1 '2β' is not a number"},
    };
    for (const auto& [papers, message] : cases) {
        const std::string result = read(papers);
        EXPECT_THAT(result, testing::HasSubstr(" ! " + message)) << papers;
        EXPECT_EQ(result.find(" ! "), result.rfind(" ! ")) << papers << ": " << result;
    }
}

/// Tokens have the spans of the source text, and implied tokens have empty spans.
TEST(PaperNotation, KeepsThePlaces) {
    Sources sources;
    Diagnostics diagnostics;
    const auto tokens = lex(sources.add("test", "∂β/∂t = D ∇²β"), sources, diagnostics);
    std::string places;
    for (const Token& token : tokens) {
        places += std::string(token.text) + "<" + std::string(sources.text(token.span)) + "> ";
    }
    EXPECT_EQ(places, "beta<∂β> '</∂t> =<=> D<D> *<> lap<∇²> (<> beta<β> )<> <> ");
}

TEST(PaperNotation, IsWrittenAndReadBack) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"u' = D * lap(u) + u^2*v", "∂u/∂t = D ∇²u + u²v"},
        {"u' = D*lap(u) + u^2 * v", "∂u/∂t = D∇²u + u² v"},
        {"u[i]' += u[i]'", "∂u[i]/∂t += u[i]′"},
        {"a = div(k*grad(v)) - lap(lap(v))", "a = ∇·(k∇v) − ∇⁴v"},
        {"a = lap(u)^2 + lap(u)*lap(v)", "a = lap(u)² + ∇²u·∇²v"},
        {"a = b/c*lap(u) + b*c^2*lap(u)", "a = b/c·∇²u + b·c²∇²u"},
        {"a = sqrt(u + v)/sqrt(2)", "a = √(u + v)/√2"},
        {"a = u^-1 + u^b + u^2^3 + u^0.5", "a = u⁻¹ + u^b + u^2³ + u^0.5"},
        {"a = sum(u[j]^2 over j)", "a = sum(u[j]² over j)"},
        {"diff_alpha2: pi*alphabet", "diff_α2: π·alphabet"},
        {"a = (not b and u != 1) * (v)", "a = (not b and u ≠ 1) · (v)"},
        {"phi >= -1", "φ ≥ −1"},
        {"u' = r*u - (1 + lap)^2 * u", "∂u/∂t = r·u − (1 + ∇²)² u"},
        {"a = (k*lap - 1)*u", "a = (k·∇² − 1)·u"},
        {"lap: 2 + b\n  u' = (1 + lap)*u", "lap: 2 + b\n  ∂u/∂t = (1 + lap)·u"},
    };
    for (const auto& [ascii, papers] : cases) {
        EXPECT_EQ(formatted(ascii, ScriptNotation::papers), papers);
        EXPECT_EQ(formatted(papers, ScriptNotation::papers), papers);
        EXPECT_EQ(formatted(papers, ScriptNotation::as_written), papers);
        EXPECT_EQ(formatted(papers, ScriptNotation::ascii), ascii);
    }
}

TEST(PaperNotation, KeepsWhatIsLinedUp) {
    const std::string ascii =
        "beta' = ka * (16 - beta)   # one\n"
        "  u'    = lap(beta) + u^2    # two";
    const std::string papers = formatted(ascii, ScriptNotation::papers);
    EXPECT_EQ(papers,
              "∂β/∂t = ka · (16 − β)   # one\n"
              "  ∂u/∂t = ∇²β + u²        # two");
}

TEST(GreekLetters, HaveOneSpelling) {
    for (const char32_t letter : U"αβγδεζηθικλμνξπρστυφχψωΓΘΛΞΠΣΦΨΩ") {
        if (letter == 0) continue;
        const std::string_view spelling = greek_spelling(letter);
        ASSERT_FALSE(spelling.empty());
        EXPECT_EQ(with_ascii_names(greek_letter(spelling)), spelling);
        EXPECT_EQ(last_letter_of_name("a" + std::string(greek_letter(spelling))), 2u);
    }
    EXPECT_EQ(with_greek_letters("beta_u_alpha12_betas_"), "β_u_α12_betas_");
    EXPECT_EQ(with_ascii_names("∇β₂·u"), "∇beta2·u");
    EXPECT_EQ(last_letter_of_name("∇"), 0u);
}

}  // namespace
}  // namespace cascade

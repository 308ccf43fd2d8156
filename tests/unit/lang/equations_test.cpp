// Equations in Unicode and TeX, for each notation and for the whole library.
#include "lang/equations/equations.h"
#include "lang/library/library.h"
#include "lang/syntax/parse.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace cascade {
namespace {

std::string equations(const std::string& text, const std::string& system, Notation notation,
                      EquationParts parts = EquationParts::all) {
    Sources sources;
    Diagnostics diagnostics;
    const ast::Script script = parse(sources.add("test.cascade", text), sources, diagnostics);
    EXPECT_FALSE(diagnostics.has_errors()) << text;
    return print_equations(script, sources, system, notation, parts);
}

/// Prints the right side of `q = …` in Unicode.
std::string unicode(const std::string& expression) {
    const std::string text =
        equations("system s { q = " + expression + " }", "s", Notation::unicode);
    const std::string before = "  where    q = ";
    EXPECT_TRUE(text.starts_with(before)) << text;
    return text.substr(before.size(), text.size() - before.size() - 1);
}
std::string tex(const std::string& expression) {
    const std::string text = equations("system s { q = " + expression + " }", "s", Notation::tex);
    const std::size_t begin = text.find("&= ") + 3;
    return text.substr(begin, text.find("\n\\end", begin) - begin);
}

/// Prints the right side of `q = …` in MathML, as one row.
std::string mathml(const std::string& expression) {
    Sources sources;
    Diagnostics diagnostics;
    const ast::Script script =
        parse(sources.add("test.cascade", "system s { q = " + expression + " }"), sources,
              diagnostics);
    const std::string text = equation_in_mathml(script, sources, "s", "q");
    const std::string before = "<mo>=</mo></mtd><mtd>", after = "</mtd></mtr></mtable></math>";
    const std::size_t equals = text.find(before);
    EXPECT_TRUE(equals != std::string::npos && text.ends_with(after)) << text;
    const std::size_t begin = equals + before.size();
    return text.substr(begin, text.size() - begin - after.size());
}

TEST(Equations, AreMathMLForBrowsers) {
    EXPECT_EQ(mathml("a - 2.5 * lap(u)"),
              "<mi>a</mi><mo>−</mo><mn>2.5</mn><mspace width=\"0.17em\"/>"
              "<msup><mo>∇</mo><mn>2</mn></msup><mi>u</mi>");
    EXPECT_EQ(mathml("u^2 / (1 + k)"),
              "<mfrac><msup><mi>u</mi><mn>2</mn></msup>"
              "<mrow><mn>1</mn><mo>+</mo><mi>k</mi></mrow></mfrac>");
    EXPECT_EQ(mathml("(u + 1)^-k"),
              "<msup><mrow><mo>(</mo><mi>u</mi><mo>+</mo><mn>1</mn><mo>)</mo></mrow>"
              "<mrow><mo>−</mo><mi>k</mi></mrow></msup>");
    EXPECT_EQ(mathml("beta * diff_u"),
              "<mi>β</mi><mspace width=\"0.17em\"/>"
              "<msub><mi mathvariant=\"normal\">diff</mi><mi>u</mi></msub>");
    EXPECT_EQ(mathml("sqrt(abs(u))"), "<msqrt><mrow><mo>|</mo><mi>u</mi><mo>|</mo></mrow></msqrt>");
    EXPECT_EQ(mathml("if(u < 1, 2, 3)"),
              "<mrow><mo>{</mo><mtable><mtr><mtd><mn>2</mn></mtd><mtd><mtext>if </mtext>"
              "<mi>u</mi><mo>&lt;</mo><mn>1</mn></mtd></mtr><mtr><mtd><mn>3</mn></mtd>"
              "<mtd><mtext>otherwise</mtext></mtd></mtr></mtable></mrow>");
    EXPECT_EQ(mathml("mean(u over domain)"), "<mrow><mo>⟨</mo><mi>u</mi><mo>⟩</mo></mrow>");
    EXPECT_EQ(
        mathml("max(tanh(u), 1e-3)"),
        "<mi>max</mi><mrow><mo>(</mo><mi>tanh</mi><mrow><mo>(</mo><mi>u</mi><mo>)</mo></mrow>"
        "<mo>,</mo><msup><mn>10</mn><mrow><mo>−</mo><mn>3</mn></mrow></msup><mo>)</mo></mrow>");
}

/// Whether the tags are nested correctly.
bool is_well_formed(std::string_view text) {
    std::vector<std::string_view> open;
    for (std::size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<', at)) {
        const std::size_t end = text.find('>', at);
        std::string_view tag = text.substr(at + 1, end - at - 1);
        at = end;
        if (tag.ends_with('/')) continue;
        const bool closes = tag.starts_with('/');
        if (closes) tag.remove_prefix(1);
        tag = tag.substr(0, tag.find(' '));
        if (!closes) {
            open.push_back(tag);
            continue;
        }
        if (open.empty() || open.back() != tag) return false;
        open.pop_back();
    }
    return open.empty();
}

TEST(Equations, OfTheLibraryAreWellFormedMathML) {
    for (const LibraryText& text : library_texts()) {
        Sources sources;
        Diagnostics diagnostics;
        const ast::Script script =
            parse(sources.add(std::string(text.system_name()), std::string(text.text)), sources,
                  diagnostics);
        for (const ast::Block& block : script.blocks) {
            for (const ast::Statement& statement : block.statements) {
                const std::string equation =
                    equation_in_mathml(script, sources, block.name.text, statement.name.text);
                EXPECT_TRUE(is_well_formed(equation)) << equation;
                EXPECT_EQ(equation.find('\\'), std::string::npos) << equation;
                EXPECT_EQ(equation.find("<mo></mo>"), std::string::npos) << equation;
            }
        }
    }
}

TEST(Equations, TextsAreNoTagsInMathML) {
    EXPECT_EQ(mathml("field(\"</mtext><img src=x>\\}{&\")").find("<img"), std::string::npos);
    EXPECT_TRUE(is_well_formed(mathml("field(\"</mtext><img src=x>\\}{&\")")));
}

TEST(Equations, DeepBracketsInMathMLNeedNoStack) {
    const std::string deep = std::string(5000, '-') + "u";
    EXPECT_TRUE(is_well_formed(mathml(deep)));
}

TEST(Equations, WriteASystemAsAPaperDoes) {
    const std::string script =
        "system s {\n  u: 1\n  v: 0.25\n  feed: 0.037\n  diff_u: 0.16\n"
        "  iterations: 5\n  rate = u * v^2\n"
        "  u' = diff_u * lap(u) - rate + feed * (1 - u)\n"
        "  v' = lap(v)\n  v' += rate\n  v' += -feed * v\n  v' += -u\n"
        "  v >= 0\n  u <= 1\n}";
    EXPECT_EQ(equations(script, "s", Notation::unicode),
              "  ∂u/∂t = diffᵤ ∇²u − rate + feed (1 − u)\n"
              "  ∂v/∂t = ∇²v + rate − feed v − u\n"
              "  where    rate = u v²\n"
              "  always   v ≥ 0\n"
              "           u ≤ 1\n"
              "  with     feed = 0.037\n"
              "           diffᵤ = 0.16\n"
              "  at first u = 1\n"
              "           v = 0.25\n");
    EXPECT_EQ(equations(script, "s", Notation::unicode, EquationParts::rates).find("with"),
              std::string::npos);
    EXPECT_EQ(equations(script, "s", Notation::tex, EquationParts::rates),
              "% s; needs \\usepackage{amsmath}\n"
              "\\begin{align}\n"
              "  \\partial_t u &= \\mathrm{diff}_{u} \\, \\nabla^2 u - \\mathrm{rate} + "
              "\\mathrm{feed} \\, \\left(1 - u\\right) \\\\\n"
              "  \\partial_t v &= \\nabla^2 v + \\mathrm{rate} - \\mathrm{feed} \\, v - u\n"
              "\\end{align}\nwhere\n\\begin{align*}\n  \\mathrm{rate} &= u \\, v^{2}\n"
              "\\end{align*}\nAlways $v \\ge 0$,\n  $u \\le 1$.\n");
    EXPECT_EQ(equations(script, "unknown", Notation::unicode), "");
}

TEST(Equations, ShowADerivedSystemAsAWhole) {
    EXPECT_EQ(equations("system a { u: 1; k: 2; d = k; u' = lap(u); u' += d }\n"
                        "system b: a { k: 3; d = k^2; u' += -u }\n"
                        "system c: b { u' = k }",
                        "b", Notation::unicode),
              "  ∂u/∂t = ∇²u + d − u\n  where    d = k²\n  with     k = 3\n  at first u = 1\n");
    // A definition replaces a parameter, and a rule for all members replaces the rule of one
    // member.
    EXPECT_EQ(equations("system a { i: 1..2; k: 1; u[i]: 1; u[2]: 5; u[i]' = k }\n"
                        "system b: a { k = 2; u[i]: 3; u[1]: 4; u[2]' = 7 }",
                        "b", Notation::unicode),
              "  ∂uᵢ/∂t = k\n  ∂u₂/∂t = 7\n  for      i = 1 … 2\n  where    k = 2\n"
              "  at first uᵢ = 3\n           u₁ = 4\n");
    EXPECT_EQ(equations("system gray_scott: gray_scott { feed: 0.5 }", "gray_scott",
                        Notation::unicode, EquationParts::rates),
              "  ∂u/∂t = diffᵤ ∇²u − rate + feed (1 − u)\n"
              "  ∂v/∂t = diffᵥ ∇²v + rate − (feed + kill) v\n"
              "  where    rate = u v²\n");
}

TEST(Equations, PutBracketsOnlyWhereTheyAreNeeded) {
    EXPECT_EQ(unicode("(a + b) + c"), "a + b + c");
    EXPECT_EQ(unicode("a + (b - c)"), "a + b − c");
    EXPECT_EQ(unicode("a - (b - c)"), "a − (b − c)");
    EXPECT_EQ(unicode("a - -b"), "a − (−b)");
    EXPECT_EQ(unicode("(a * b) * (c * d)"), "a b c d");
    EXPECT_EQ(unicode("(a + b) * c"), "(a + b) c");
    EXPECT_EQ(unicode("2 * 3 * x"), "2 · 3 x");
    EXPECT_EQ(unicode("x * 2"), "x · 2");
    EXPECT_EQ(unicode("x * 2^n"), "x · 2ⁿ");
    EXPECT_EQ(unicode("a * -b"), "a (−b)");
    EXPECT_EQ(unicode("-(a + b)"), "−(a + b)");
    EXPECT_EQ(unicode("-x^2"), "−x²");
    EXPECT_EQ(unicode("(-x)^2"), "(−x)²");
    EXPECT_EQ(unicode("(a < b) and not (c or d == e)"), "a < b and not (c or d = e)");
}

TEST(Equations, KeepQuotientsApartOnALine) {
    EXPECT_EQ(unicode("a / b / c"), "a / b / c");
    EXPECT_EQ(unicode("a / (b * c)"), "a / (b c)");
    EXPECT_EQ(unicode("a / b * c"), "(a / b) c");
    EXPECT_EQ(unicode("a * (b / c)"), "a (b / c)");
    EXPECT_EQ(unicode("1/8 * lap(a)"), "(1/8) ∇²a");
    EXPECT_EQ(tex("a / (b * c)"), "\\frac{a}{b \\, c}");
    EXPECT_EQ(tex("a / b * c"), "\\frac{a}{b} \\, c");
    EXPECT_EQ(tex("(a / b)^2"), "\\left(\\frac{a}{b}\\right)^{2}");
}

TEST(Equations, WritePowersAbove) {
    EXPECT_EQ(unicode("x^12 + x^-1 + x^n"), "x¹² + x⁻¹ + xⁿ");
    EXPECT_EQ(unicode("x^y"), "x^y");
    EXPECT_EQ(unicode("x^(a + 1)"), "x^(a + 1)");
    EXPECT_EQ(unicode("x^0.5"), "x^0.5");
    EXPECT_EQ(unicode("2^3^x"), "2^(3^x)");
    EXPECT_EQ(unicode("pow(a + b, 3)"), "(a + b)³");
    EXPECT_EQ(unicode("lap(u)^2"), "(∇²u)²");
    EXPECT_EQ(tex("x^(a + 1)"), "x^{a + 1}");
}

TEST(Equations, KnowTheOperators) {
    EXPECT_EQ(unicode("lap(c^3 - c - gamma * lap(c))"), "∇²(c³ − c − γ ∇²c)");
    EXPECT_EQ(unicode("lap(u) - div(chi * u * grad(v))"), "∇²u − ∇·(χ u ∇v)");
    EXPECT_EQ(unicode("div(grad(u))"), "∇·(∇u)");
    EXPECT_EQ(unicode("grad2(u) + dx(u) + dxx(u) + dxy(u + v)"),
              "|∇u|² + ∂u/∂x + ∂²u/∂x² + ∂²(u + v)/∂x∂y");
    EXPECT_EQ(unicode("u_x + 2 * u_yx + u_xxyy - c_zzz[i]"),
              "∂u/∂x + 2 ∂²u/∂x∂y + ∂⁴u/∂x²∂y² − ∂³cᵢ/∂z³");
    EXPECT_EQ(tex("u_xxy - c_zz[i]"), "\\partial_{xxy} u - \\partial_{zz} c_{i}");
    EXPECT_EQ(equations("system s { u_x = 2\nq = u_x }", "s", Notation::unicode),
              "  where    uₓ = 2\n           q = uₓ\n");
    EXPECT_EQ(unicode("advect(a, b, u)"), "(a, b)·∇u");
    EXPECT_EQ(unicode("diffuse(u, a1, a2, theta)"), "A(a₁, a₂, θ) : ∇∇u");
    EXPECT_EQ(unicode("div(tensor(p, q, 0) * grad(u))"), "∇·(A(p, q, 0) ∇u)");
    EXPECT_EQ(unicode("div(vector(a, b))"), "∇·(a, b)");
    EXPECT_EQ(unicode("advect(v, u) - transport(unit(v), a + b)"), "v·∇u − unit(v)·∇(a + b)");
    EXPECT_EQ(unicode("transport(a, b, u)"), "(a, b)·∇u");
    EXPECT_EQ(unicode("div(symmetric(p, q, r) * grad(u))"), "∇·(A(p, q, r) ∇u)");
    EXPECT_EQ(unicode("curl(v) + v.x * grad(u).y"), "∇×v + v_x (∇u)_y");
    EXPECT_EQ(tex("curl(v) + v.x * grad(u).y"),
              "\\nabla \\times v + v_{x} \\, \\left(\\nabla u\\right)_{y}");
    EXPECT_EQ(unicode("mean(u over domain) + max(u over domain)"), "⟨u⟩ + max_Ω(u)");
    EXPECT_EQ(tex("dxy(u) * grad2(u)"), "\\partial_{xy} u \\, \\left|\\nabla u\\right|^2");
    EXPECT_EQ(tex("mean(u over domain)"), "\\left\\langle u \\right\\rangle");
}

TEST(EquationsOfCells, WriteVectorsAndNeighbours) {
    EXPECT_EQ(unicode("dot(a, b + c) - cross(a, cross(b, c))"), "a · (b + c) − a × (b × c)");
    EXPECT_EQ(unicode("2 * length(p - v)"), "2 |p − v|");
    EXPECT_EQ(unicode("sum(overlap * own(c) over touching)"), "Σ_touching overlap own(c)");
    EXPECT_EQ(unicode("mean(c over near(2 * d))"), "⟨c⟩_near(2 d)");
    EXPECT_EQ(tex("min(c over near(d))"), "\\min_{\\mathrm{near}(d)}\\left(c\\right)");
    EXPECT_EQ(tex("sum(cross(a, b) over touching)"), "\\sum_{\\mathrm{touching}} a \\times b");
    EXPECT_EQ(mathml("cross(a, b)"), "<mi>a</mi><mo>×</mo><mi>b</mi>");
}

TEST(Equations, WriteConstantsAndSecondRates) {
    EXPECT_EQ(equations("let c = 2\nlet q = c^2\nsystem s { u: 1; u'' = q * lap(u) }", "s",
                        Notation::unicode),
              "  ∂uₜ/∂t = q ∇²u\n  ∂u/∂t = uₜ\n  where    q = c²\n           c = 2\n"
              "  at first u = 1\n           uₜ = 0\n");
}

TEST(Equations, KnowTheFunctions) {
    EXPECT_EQ(unicode("abs(u) + sqrt(u) + log(u)"), "|u| + √u + ln(u)");
    EXPECT_EQ(unicode("sqrt(u)^2 + cbrt(u^2)"), "(√u)² + ∛(u²)");
    EXPECT_EQ(tex("sqrt(u + v) * cbrt(2)"), "\\sqrt{u + v} \\, \\sqrt[3]{2}");
    EXPECT_EQ(unicode("if(a < b, c, d + 1) * u"), "{c if a < b, else d + 1} u");
    EXPECT_EQ(unicode("u' + random(0, 1e-3)"), "∂u/∂t + random(0, 10⁻³)");
    EXPECT_EQ(unicode("floor(2.5e10 * x)"), "⌊2.5·10¹⁰ x⌋");
    EXPECT_EQ(tex("tanh(a / b)"), "\\tanh\\left(\\frac{a}{b}\\right)");
    EXPECT_EQ(tex("min(a, my_own(b))"),
              "\\min\\left(a, \\operatorname{my\\_own}\\left(b\\right)\\right)");
    EXPECT_EQ(tex("if(a, b, c)"),
              "\\begin{cases}b & \\text{if } a \\\\ c & \\text{otherwise}\\end{cases}");
}

TEST(Equations, KnowNames) {
    EXPECT_EQ(unicode("alpha + beta2 + Omega + epsilon"), "α + β₂ + Ω + ε");
    EXPECT_EQ(unicode("u_max + p1"), "uₘₐₓ + p₁");
    EXPECT_EQ(tex("alpha_1 + diff_u_0 + feed + x2"),
              "\\alpha_{1} + \\mathrm{diff}_{u,0} + \\mathrm{feed} + x_{2}");
    // Either all names have subscripts or none, since Unicode has no subscript b.
    EXPECT_EQ(equations("system s { diff_a: 1; diff_b: 2; p1: 3 }", "s", Notation::unicode),
              "  with     diff_a = 1\n           diff_b = 2\n           p₁ = 3\n");
}

TEST(Equations, KnowFamiliesAndOwnFunctions) {
    EXPECT_EQ(equations("fn bump(r, w) = exp(-(r / w)^2)\nfn unused(a) = a\nsystem s {\n  i: 1..3\n"
                        "  u[i]: 1\n  w[i] = sum(u[i] over i) * u[mod(i, 3) + 1]\n"
                        "  u[i]' = w[i] - u[i + 1] + bump(u[i], 2)\n}",
                        "s", Notation::unicode),
              "  ∂uᵢ/∂t = wᵢ − uᵢ₊₁ + bump(uᵢ, 2)\n"
              "  for      i = 1 … 3\n"
              "  where    wᵢ = (Σᵢ uᵢ) u[mod(i,3)+1]\n"
              "           bump(r, w) = exp(−(r / w)²)\n"
              "  at first uᵢ = 1\n");
    EXPECT_EQ(tex("u[i+1] + v_0[n_a]^2"), "u_{i + 1} + {v_{0}}_{n_{a}}^{2}");
    EXPECT_EQ(tex("u[i]'"), "\\partial_t u_{i}");
    EXPECT_EQ(tex("max(u[i] over i)"), "\\max_{i}\\left(u_{i}\\right)");
}

// A term is 4 characters wide, and 5 with its sign, so 12 terms fit on a line of 60.
TEST(Equations, LongSumsGoOnInLinesBelow) {
    const std::string term = "a \\, b \\, c \\, d";
    std::string script = "a * b * c * d", line = term, rest;
    for (int k = 1; k < 20; ++k) {
        script += k % 2 == 0 ? " + a * b * c * d" : " - a * b * c * d";
        const std::string more = (k % 2 == 0 ? "+ " : "- ") + term;
        if (k < 12) line += " " + more;
        else rest += (rest.empty() ? "" : " ") + more;
    }
    EXPECT_EQ(tex(script), line + " \\notag \\\\\n  &\\quad {} " + rest);
    EXPECT_EQ(tex("(" + script + ") / q"),
              "\\frac{1}{q} \\Bigl( " + line + " \\notag \\\\\n  &\\quad {} " + rest + " \\Bigr)");
    // Brackets and fractions are not broken.
    EXPECT_EQ(tex("2 * (" + script + ")").find("notag"), std::string::npos);
    EXPECT_EQ(tex("1 / (" + script + ")").find("notag"), std::string::npos);
}

/// Whether all brackets of TeX are closed by brackets of the same kind, in order.
bool is_balanced(const std::string& text) {
    std::vector<std::string> open;
    for (std::size_t k = 0; k < text.size(); ++k) {
        if (text[k] == '\\' && (text[k + 1] == '{' || text[k + 1] == '}' || text[k + 1] == '\\')) {
            ++k;
        } else if (text[k] == '{') {
            open.emplace_back("}");
        } else if (text.compare(k, 6, "\\left|") == 0 || text.compare(k, 6, "\\left(") == 0 ||
                   text.compare(k, 11, "\\left\\langl") == 0) {
            open.emplace_back("right");
        } else if (text[k] == '}' || text.compare(k, 7, "\\right|") == 0 ||
                   text.compare(k, 7, "\\right)") == 0 || text.compare(k, 8, "\\right\\r") == 0) {
            if (open.empty() || open.back() != (text[k] == '}' ? "}" : "right")) return false;
            open.pop_back();
        }
    }
    return open.empty();
}

TEST(Equations, OfTheWholeLibraryAreWhole) {
    for (const LibraryText& text : library_texts()) {
        const std::string name(text.system_name());
        const std::string lines = equations("domain {}", name, Notation::unicode);
        EXPECT_THAT(lines, testing::HasSubstr("/∂t = ")) << name;
        EXPECT_THAT(lines, testing::Not(testing::HasSubstr("lap("))) << name;
        const std::string tex_text = equations("domain {}", name, Notation::tex);
        EXPECT_TRUE(is_balanced(tex_text)) << tex_text;
        for (const char c : tex_text) EXPECT_GT(c, 0) << tex_text;
    }
}

TEST(Equations, TakeLongAndDeepOnesInTheirStride) {
    std::string sum = "1", deep = "x";
    for (int k = 0; k < 200000; ++k) sum += " + 2 * x";
    EXPECT_GT(unicode(sum).size(), 1000000u);
    const std::size_t depth = 100000;
    deep = std::string(depth, '-') + "x";
    for (std::size_t k = 1; k < 2 * depth; k += 2) deep.insert(k, " ");
    EXPECT_GT(tex(deep).size(), depth);
}

}  // namespace
}  // namespace cascade

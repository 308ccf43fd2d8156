// Kernels of random formulas for cells that crawl: native code and the interpreter compute the same
// bits.
#include "ir/interpreter.h"
#include "jit/jit.h"
#include "lang/check/check.h"
#include "lang/lower/lower.h"
#include "lang/program/models.h"
#include "lang/syntax/parse.h"
#include "tests/support/kernel_comparison.h"
#include "tests/support/new_seed.h"
#include "tests/support/random_stream.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <span>

namespace cascade::test {
namespace {

/// Makes formulas of numbers and vectors, for a cell or, inside a sum, for a link.
class RandomFormulas {
public:
    explicit RandomFormulas(std::uint64_t seed) : random_(seed) {}

    std::string script() {
        std::string text =
            fmt::format("cells c {{\n  r: 0.02 in 0 .. 1\n  q: 0\n  q' = {}\n  k: 2\n",
                        number(4, false));
        text += fmt::format("  d = {}\n  v = cross(p, ez) * d\n", simple_number());
        text += "  m: 0\n  m' = x - m\n";
        text += fmt::format("  w: 0\n  w' = {}\n", number(4, false));
        text += fmt::format("  p' += {}\n  p' += {}\n  turn' += {}\n}}\n", vector(3, false),
                            vector(3, false), vector(3, false));
        text += random_.chance(50) ? "domain { surface: sphere; " : "domain { grid: 64, 32; ";
        text += random_.chance(50) ? "precision: double }\n" : "precision: single }\n";
        return text + "stage s: c { founders: 2; duration: 1 }\n";
    }

private:
    std::string one_of(std::span<const std::string_view> words) {
        return std::string(random_.pick(words));
    }

    std::string simple_number() {
        static constexpr std::array<std::string_view, 8> leaves{"q", "w",   "r",  "x",
                                                                "z", "off", "m'", "0.3"};
        return one_of(leaves);
    }

    std::string number(int depth, bool in_link) {
        if (depth == 0) {
            static constexpr std::array<std::string_view, 4> of_link{"distance", "gap", "overlap",
                                                                     "contact"};
            if (in_link && random_.chance(50)) return one_of(of_link);
            return random_.chance(20) ? "k" : simple_number();
        }
        const auto part = [&] { return number(depth - 1, in_link); };
        const auto vector_part = [&] { return vector(depth - 1, in_link); };
        switch (random_.below(in_link ? 9 : 11)) {
            case 0: return fmt::format("({} + {})", part(), part());
            case 1: return fmt::format("({} - {})", part(), part());
            case 2: return fmt::format("{} * {}", bracketed(part()), bracketed(part()));
            case 3: return fmt::format("tanh({})", part());
            case 4: return fmt::format("if({} < {}, {}, {})", part(), part(), part(), part());
            case 5: return fmt::format("dot({}, {})", vector_part(), vector_part());
            case 6: return fmt::format("length({})", vector_part());
            case 7: return in_link ? fmt::format("own({})", number(depth - 1, false)) : part();
            case 8: return fmt::format("lap({})", number(depth - 1, false) + " + q");
            default: {
                static constexpr std::array<std::string_view, 4> kinds{"sum", "mean", "min", "max"};
                static constexpr std::array<std::string_view, 3> over{"touching", "near(0.3)",
                                                                      "near(k / 4)"};
                return fmt::format("{}({} over {})", one_of(kinds), number(depth - 1, true),
                                   one_of(over));
            }
        }
    }

    std::string vector(int depth, bool in_link) {
        static constexpr std::array<std::string_view, 5> leaves{"p", "normal", "ex", "ey", "ez"};
        if (depth == 0) return in_link && random_.chance(40) ? "direction" : one_of(leaves);
        const auto part = [&] { return vector(depth - 1, in_link); };
        switch (random_.below(in_link ? 6 : 8)) {
            case 0: return fmt::format("({} - {})", part(), part());
            case 1: return fmt::format("({}) * {}", number(depth - 1, in_link), part());
            case 2: return fmt::format("cross({}, {})", part(), part());
            case 3: return fmt::format("unit({})", part());
            case 4: return fmt::format("vector({}, {})", number(depth - 1, in_link), "0.5");
            case 5: return in_link ? fmt::format("own({})", vector(depth - 1, false)) : "v";
            case 6: return fmt::format("mean({} over touching)", vector(depth - 1, true));
            default: return fmt::format("sum({} over near(0.3))", vector(depth - 1, true));
        }
    }

    static std::string bracketed(const std::string& text) { return "(" + text + ")"; }

    RandomStream random_;
};

void compare_random_formulas(std::uint64_t first_seed, std::uint64_t count) {
    const auto interpreter = make_interpreter();
    std::size_t passes = 0;
    for (std::uint64_t seed = first_seed; seed < first_seed + count; ++seed) {
        RandomFormulas formulas(seed);
        const std::string text = formulas.script();
        Sources sources;
        Diagnostics diagnostics;
        const SourceId id = sources.add("random.cascade", text);
        const ast::Script tree = parse(id, sources, diagnostics);
        const auto program = check(tree, sources, diagnostics);
        ASSERT_TRUE(program) << "seed " << seed << "\n" << text << diagnostics.sorted()[0].message;
        auto jit = make_jit({std::array{4, 8, 16}[seed % 3], 2});
        ASSERT_TRUE(jit);
        for (const Pass& pass : plan_rates(*program, 0).passes) {
            const CellKernel& kernel = *pass.bound.kernel;
            ASSERT_EQ(verify(kernel), "") << text;
            const Grid grid = rows_of_cells(20 + static_cast<std::int64_t>(seed % 50));
            EXPECT_EQ(same_bits(run_kernel(*interpreter, kernel, grid, seed),
                                run_kernel(**jit, kernel, grid, seed)),
                      "")
                << "seed " << seed << "\n"
                << text;
            ++passes;
        }
    }
    EXPECT_GT(passes, count) << "some sums read what neighbours compute";
}

TEST(CellsAgreement, RandomFormulas) { compare_random_formulas(1, 60); }
TEST(CellsAgreement, NewRandomFormulas) { compare_random_formulas(new_seed() + 2, 20); }

}  // namespace
}  // namespace cascade::test

// Graph passes: properties of every graph after each pass, and the effects of some passes.
#include "check_helpers.h"
#include "verify_expressions.h"

#include "lang/lower/lower_expressions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

namespace cascade::test {
namespace {

using namespace cascade::lowering;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string torus =
    "domain { grid: 16, 16\n"
    "  surface: (3 + cos(2*pi*sy)) * cos(2*pi*sx), (3 + cos(2*pi*sy)) * sin(2*pi*sx), "
    "sin(2*pi*sy) }\n";
const std::string sphere = "domain { surface: sphere; cells: 64 }\n";
const std::string masked = "domain { grid: 16, 16; mask: sx < 0.5 }\n";

/// Checks every graph of a script after each pass. Returns the graphs of a step as text, by pass.
std::map<std::string, std::string> verified(const std::string& script) {
    std::map<std::string, std::string> steps;
    const auto checked = check_text(script);
    if (!checked->program) return steps;
    watch_lowering(*checked->program, [&](const PassContext& context, std::string_view what,
                                          std::string_view pass, const Expressions& after) {
        EXPECT_EQ(verify(after, context, pass), "") << script << what << " after " << pass << "\n"
                                                    << print(after, context);
        if (what == "one step") steps[std::string(pass)] = print(after, context);
    });
    return steps;
}

std::map<std::string, std::string> step_of(const std::string& domain, const std::string& rate) {
    const auto steps =
        verified(domain + "system s { u: x; k: 2; u' = " + rate + " }\nstage only: s {}\n");
    EXPECT_FALSE(steps.empty()) << rate;
    return steps;
}

std::string text_of(const std::filesystem::path& file) {
    std::stringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

TEST(GraphPasses, OnAModelNoTensorIsLeft) {
    const auto steps =
        step_of(sphere,
                "diffuse(u, 2, k, along(grad(u))) + div(tensor(k, 1, x) * vector(u, 1, 0))");
    EXPECT_EQ(steps.count("tensors"), 0u);
    EXPECT_NE(steps.at("flatten").find("tensor("), std::string::npos);
    EXPECT_NE(steps.at("links").find("(place_x)"), std::string::npos) << steps.at("links");
}

TEST(GraphPasses, EveryGraphOfTheLibraryIsWhole) {
    std::size_t count = 0;
    for (const auto& file :
         std::filesystem::directory_iterator(CASCADE_SOURCE_DIR "/lang/systems")) {
        if (file.path().extension() != ".cascade") continue;
        const std::string stage = "stage one: " + file.path().stem().string() + " {}\n";
        for (const std::string& domain : {std::string(), torus, sphere, masked}) {
            count += verified(domain + stage).empty() ? 0 : 1;
        }
    }
    EXPECT_GT(count, 200u);
}

TEST(GraphPasses, GraphsOfCellsThatCrawlAreWhole) {
    const auto steps = verified(
        "cells c {\n  v = cross(p, ez) + mean(vector(q, distance) over near(0.1))\n"
        "  q: 0; q' = lap(q) + mean(dot(v, own(ez)) over touching) + mean(q over domain)\n"
        "  p' += push(1) + v; turn' += comb(1)\n}\n"
        "domain { surface: sphere }\nstage s: c { founders: 2; duration: 1 }\n");
    ASSERT_TRUE(steps.contains("tissue"));
    EXPECT_EQ(steps.at("tissue").find("vector"), std::string::npos) << steps.at("tissue");
    EXPECT_NE(steps.at("tissue").find("(link_sum)"), std::string::npos) << steps.at("tissue");
}

TEST(GraphPasses, EveryGraphOfTheExamplesIsWhole) {
    std::size_t count = 0;
    for (const auto& file :
         std::filesystem::recursive_directory_iterator(CASCADE_SOURCE_DIR "/examples")) {
        if (file.path().extension() != ".cascade") continue;
        count += verified(text_of(file.path())).empty() ? 0 : 1;
    }
    EXPECT_GT(count, 30u);
}

TEST(GraphPasses, FormulasAreOneGraph) {
    EXPECT_EQ(verified("system s { u: x; v: y; a = u * v; u' = a - v'; v' = u * v + a }\n"
                       "stage only: s {}\n")
                  .at("flatten"),
              "%0 = u\n"
              "%1 = v\n"
              "%2 = %0 * %1  # a\n"
              "%3 = %2 + %2  # v'\n"
              "%4 = %2 - %3  # u'\n"
              "result %3\n"
              "result %4\n");
}

TEST(GraphPasses, TensorsAreTheirEntries) {
    const auto steps = step_of("", "diffuse(u, 1, k, x)");
    EXPECT_THAT(steps.at("flatten"), HasSubstr("diffuse(%0, %1, %2, %3)"));
    EXPECT_THAT(steps.at("tensors"), HasSubstr("# tensor"));
    EXPECT_THAT(steps.at("tensors"), Not(HasSubstr("diffuse(%0, %1, %2, %3)")));
    EXPECT_FALSE(step_of("", "lap(u)").contains("tensors")) << "nothing to do";
}

TEST(GraphPasses, OperatorsOnASurfaceReadItsMetric) {
    const auto steps = step_of(torus, "lap(u)");
    EXPECT_THAT(steps.at("surface"), HasSubstr("(flow 11)"));
    EXPECT_THAT(steps.at("surface"), Not(HasSubstr("lap(")));
    EXPECT_FALSE(step_of("", "lap(u)").contains("surface"));
}

TEST(GraphPasses, FluxesOnAModelAreSumsOverLinks) {
    const auto steps = step_of(sphere, "div(k * grad(u)) + div(x * grad(u))");
    EXPECT_THAT(steps.at("links"), Not(HasSubstr("vector")));
    EXPECT_THAT(steps.at("links"), HasSubstr("lap(%0, %1)")) << steps.at("links");
    EXPECT_THAT(steps.at("weights"), Not(HasSubstr("lap(%0, %1)")));
    EXPECT_THAT(steps.at("weights"), HasSubstr("= lap(%1)")) << "k is the same everywhere";
}

TEST(GraphPasses, AggregatesCountAreasAndTheMask) {
    EXPECT_THAT(step_of(sphere, "mean(u over domain)").at("areas"), HasSubstr("(area)"));
    EXPECT_THAT(step_of(torus, "sum(u over domain)").at("areas"), HasSubstr("(area)"));
    EXPECT_THAT(step_of(masked, "max(u over domain)").at("mask"), HasSubstr("(inside)"));
    EXPECT_THAT(step_of(masked, "sum(u over domain)").at("mask"), Not(HasSubstr("(inside)")))
        << "items are 0 outside";
}

TEST(GraphPasses, FastStepsFuseProducts) {
    const auto fast = [](const std::string& rates) {
        auto checked = check_text("system s { u: x; v: y; k: 2; w: x * y; " + rates +
                                  " }\nstage only: s {}\n");
        checked->program->domain.fast = true;
        std::string step;
        watch_lowering(*checked->program, [&](const PassContext& context, std::string_view what,
                                              std::string_view pass, const Expressions& after) {
            EXPECT_EQ(verify(after, context, pass), "");
            if (what == "one step" && pass == "products") step = print(after, context);
        });
        return step;
    };
    EXPECT_EQ(fast("u' = k * u + v"),
              "%0 = k\n%1 = u\n%3 = v\n%4 = (multiply_add)(%0, %1, %3)  # u'\nresult %4\n");
    // The product with a coefficient is fused. If both products vary, the second is fused. A
    // negation moves to the factor that varies.
    EXPECT_THAT(fast("u' = k * u + u * v"),
                HasSubstr("%4 = %1 * %3\n%5 = (multiply_add)(%0, %1, %4)"));
    EXPECT_THAT(fast("u' = u * u + u * v"),
                HasSubstr("%1 = %0 * %0\n%2 = v\n%4 = (multiply_add)(%0, %2, %1)"));
    EXPECT_THAT(fast("u' = v - u * k"),
                HasSubstr("%2 = k\n%4 = -(%1)\n%5 = (multiply_add)(%2, %4, %0)"));
    EXPECT_THAT(fast("u' = v + u / k"), HasSubstr("(multiply_add)("));
    // Step-invariant products are rounded, and so is a product that is added to itself.
    EXPECT_EQ(fast("u' = w * w + x").find("multiply_add"), std::string::npos);
    EXPECT_EQ(fast("p = u * v; u' = p + p").find("multiply_add"), std::string::npos);
    EXPECT_EQ(fast("u' = u * v"), "") << "nothing to do";
}

TEST(GraphPasses, TheVerifierFindsWhatIsWrong) {
    const auto checked = check_text("system s { u: x; u' = u }\nstage only: s {}\n");
    const PassContext context{*checked->program, 0};
    const auto message_of = [&](const auto& make, std::string_view pass = "flatten") {
        Expressions expressions;
        expressions.roots.push_back(make(expressions.graph));
        return verify(expressions, context, pass);
    };
    using Graph = ExpressionGraph;
    EXPECT_EQ(message_of([](Graph& graph) { return graph.number(1); }), "");
    EXPECT_THAT(message_of([](Graph& graph) { return graph.leaf(Rate()); }),
                HasSubstr("do not exist here"));
    EXPECT_THAT(message_of([](Graph& graph) { return graph.leaf(MetricPlane::area); }),
                HasSubstr("do not exist here"));
    EXPECT_THAT(message_of(
                    [](Graph& graph) { return graph.call(Function::add, {graph.number(1)}); }),
                HasSubstr("number of operands"));
    EXPECT_THAT(message_of(
                    [](Graph& graph) { return graph.call(Function::div, {graph.number(1)}); }),
                HasSubstr("wrong type"));
    EXPECT_THAT(message_of(
                    [](Graph& graph) { return graph.call(Function::grad, {graph.number(1)}); }),
                HasSubstr("its type"));
    EXPECT_THAT(message_of([](Graph& graph) {
                    return graph.call(Function::lap, {graph.number(1), graph.number(2)});
                }),
                HasSubstr("number of operands"));
    EXPECT_THAT(message_of([](Graph& graph) {
                    Node forwards{Call()};
                    forwards.function = Function::sin;
                    forwards.operands[0] = NodeId(0);
                    forwards.operand_count = 1;
                    return graph.add(forwards);
                }),
                HasSubstr("before its reader"));
}

}  // namespace
}  // namespace cascade::test

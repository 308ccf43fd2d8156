// A fuzzer of the whole front end: bytes are lexed, parsed, formatted, checked, and, if they are a
// program, lowered and verified. All messages are rendered. It finds crashes, hangs, leaks and
// failed CHECKs. It is built with clang, libFuzzer and sanitizers. README.md in this folder has the
// commands.
#include "core/check.h"
#include "lang/check/check.h"
#include "lang/format/format_script.h"
#include "lang/lower/lower.h"
#include "lang/syntax/parse.h"
#include "lang/syntax/picture_expression.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace cascade {

namespace {

void lower_stages(const Program& program) {
    for (std::uint32_t stage = 0; stage < program.stages.size(); ++stage) {
        for (const StepPlan& plan : {plan_uniform_start(program, stage), plan_start(program, stage),
                                     plan_step(program, stage), plan_rates(program, stage),
                                     plan_view(program, program.stages[stage].show, stage)}) {
            for (const Pass& pass : plan.passes) {
                CHECK(verify(*pass.bound.kernel).empty(),
                      "every kernel that lowering makes is sound");
            }
        }
    }
}

void lower_picture(const ast::Script& script, Program& program, const Sources& sources,
                   Diagnostics& diagnostics) {
    const auto expression = picture_expression(script);
    if (!expression || program.stages.empty()) return;
    const auto last = static_cast<std::uint32_t>(program.stages.size() - 1);
    const auto view = check_view(script, *expression, last, last, program, sources, diagnostics);
    if (!view) return;
    for (const Pass& pass : plan_view(program, *view, last).passes) {
        CHECK(verify(*pass.bound.kernel).empty(), "the kernel of a picture is sound");
    }
}

void run_front_end(const std::string& text) {
    Sources sources;
    Diagnostics diagnostics;
    const SourceId source = sources.add("fuzz.cascade", text);
    const ast::Script script = parse(source, sources, diagnostics);
    print_ast(script, sources);
    std::optional<Program> program = check(script, sources, diagnostics);
    CHECK(program || diagnostics.has_errors(), "a script that is refused has a message");
    if (program && !diagnostics.has_errors()) {
        print_program(*program);
        describe_plans(*program);
        lower_stages(*program);
        lower_picture(script, *program, sources, diagnostics);
    }
    render(diagnostics, sources, {.colour = true});
}

/// Every text that can be parsed can be formatted, and formatting again changes nothing.
void run_formatter(const std::string& text) {
    Sources sources;
    Diagnostics diagnostics;
    const SourceId source = sources.add("fuzz.cascade", text);
    for (const ScriptNotation notation :
         {ScriptNotation::as_written, ScriptNotation::ascii, ScriptNotation::papers}) {
        const auto once = format_script(source, sources, diagnostics, notation);
        if (!once) return;
        const SourceId copy = sources.add("formatted", *once);
        CHECK(format_script(copy, sources, diagnostics, notation) == once,
              "formatting is done in one run");
        CHECK(format_script(copy, sources, diagnostics) == once, "no notation changes by itself");
    }
}

void run_short_forms(const std::string& text) {
    Sources sources;
    Diagnostics diagnostics;
    ast::Script script;
    const SourceId source = sources.add("--set", text);
    parse_override(source, sources, script, diagnostics);
    parse_expression(source, sources, script, diagnostics);
    print_tokens(lex(source, sources, diagnostics), sources);
    render(diagnostics, sources, {});
}

}  // namespace

}  // namespace cascade

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    cascade::run_front_end(text);
    cascade::run_formatter(text);
    cascade::run_short_forms(text);
    return 0;
}

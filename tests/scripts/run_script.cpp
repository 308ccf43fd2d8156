// Runs a script with expectations and lists differences.
#include "run/domain/domain_mask.h"
#include "run/simulation/end_remarks.h"
#include "run_script.h"

#include "lang/check/check.h"
#include "lang/syntax/parse.h"
#include "run/pictures/picture_remarks.h"
#include "support/kernel_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

namespace cascade::test {

namespace {

/// One native backend for all runs with the same width of vectors, so that equal kernels are
/// compiled once.
std::shared_ptr<TieredBackend> native_stepper(int lanes) {
    static std::map<int, std::shared_ptr<TieredBackend>> steppers;
    auto& stepper = steppers[lanes];
    if (!stepper) stepper = make_stepper({"jit", lanes, 0}).value();
    return stepper;
}

/// A script and the results of its run.
struct Run {
    Script script;
    std::unique_ptr<Simulation> simulation;
    std::string failure;
    std::vector<std::string> warnings, remarks;

    std::uint32_t last_stage() const { return script.stage_count() - 1; }
    void start(const Configuration& configuration);
    void remark();
};

Run load(const ScriptCase& script, const std::filesystem::path& folder,
         const Configuration& configuration) {
    Run run;
    Overrides overrides;
    overrides.sets = script.sets;
    if (!script.is_only_checked()) overrides.precision = configuration.precision;
    run.script = load_script("script", script.text, folder, overrides);
    return run;
}

/// Runs every stage to its end, or to a failure.
void Run::start(const Configuration& configuration) {
    // Vectors of 4 cells on one thread, of 16 cells on several threads.
    const int lanes = configuration.threads == 1 ? 4 : 16;
    SimulationOptions options{configuration.backend, lanes, configuration.threads};
    if (configuration.backend == "jit") options.stepper = native_stepper(lanes);
    RunControl control;
    control.warn = [&](const std::string& warning) { warnings.push_back(warning); };
    options.control = &control;
    auto made = Simulation::create(script, options);
    if (!made) {
        // Errors about files that the script names are already among the messages.
        if (!script.diagnostics.has_errors()) failure = made.error().message;
        return;
    }
    simulation = std::move(*made);
    const auto fails = [&](const auto& result) {
        if (!result) {
            failure = result.error().message;
            if (!result.error().hint.empty()) failure += " | " + result.error().hint;
        }
        return !result;
    };
    for (std::uint32_t k = 0; k < script.stage_count(); ++k) {
        if (fails(simulation->start_stage(k))) return;
        const std::int64_t steps = script.program->stages[k].iterations;
        if (fails(simulation->advance_stage(k, steps, control, {}))) return;
    }
}

/// Collects all remarks of `cascade run` on the results.
void Run::remark() {
    const auto add = [&](std::string remark) {
        if (!remark.empty()) remarks.push_back(std::move(remark));
    };
    for (std::uint32_t k = 0; k < script.stage_count(); ++k) {
        if (simulation->state(k).steps > 0) add(remark_on(*simulation, k));
    }
    auto painter = Painter::create(script, {});
    if (painter) add(remark_on_picture(*painter, *simulation, painter->canvas(*simulation)));
}

/// All messages about the texts of a script, notes among them.
std::vector<Message> messages_of(const Script& script) {
    std::vector<Message> messages;
    const auto add = [&](const char* kind, const std::optional<Span>& span, std::string text) {
        Message message{kind, "", 0, 0, std::move(text)};
        if (span) {
            const Source& source = script.sources[span->source];
            const Location place = source.locate(span->begin);
            if (source.name() != script.name) message.source = source.name();
            message.line = place.line;
            message.column = place.column;
        }
        messages.push_back(std::move(message));
    };
    for (const Diagnostic& each : script.diagnostics.sorted()) {
        add(each.severity == Severity::error ? "error" : "warning", each.span,
            each.hint.empty() ? each.message : each.message + " | " + each.hint);
        for (const Note& note : each.notes) add("note", note.span, note.message);
    }
    return messages;
}

using Errors = std::vector<std::string>;

/// Matches each of `found` with one of `expected`, in any order, and reports the entries of both
/// that are left.
template <typename Found, typename Expected, typename Matches, typename Describe>
void compare(std::vector<Found> found, const std::vector<Expected>& expected, Matches&& is_it,
             Describe&& describe, Errors& errors) {
    for (const Expected& pattern : expected) {
        const auto match = std::find_if(found.begin(), found.end(),
                                        [&](const Found& each) { return is_it(each, pattern); });
        if (match == found.end()) {
            errors.push_back("is missing: " + describe(pattern));
        } else {
            found.erase(match);
        }
    }
    for (const Found& each : found) {
        const std::string words = describe(each);
        if (!words.starts_with("expect note")) errors.push_back("is not expected: " + words);
    }
}

void compare_messages(const Run& run, const ScriptCase& script, Errors& errors) {
    const auto is_it = [](const Message& found, const Message& pattern) {
        return found.kind == pattern.kind && found.source == pattern.source &&
               found.line == pattern.line && found.column == pattern.column &&
               matches(found.text, pattern.text);
    };
    compare(messages_of(run.script), script.messages, is_it, print, errors);
}

void compare_words(const std::vector<std::string>& found, const std::vector<std::string>& patterns,
                   const std::string& kind, Errors& errors) {
    compare(
        found, patterns, matches,
        [&](const std::string& text) { return fmt::format("expect {}: {}", kind, text); }, errors);
}

/// The values of an expression after the last stage.
std::optional<Field> value_of(Run& run, const std::string& text, Errors& errors) {
    Diagnostics wrong;
    Script& script = run.script;
    const SourceId source = script.sources.add("<expect>", text);
    const auto expression = parse_expression(source, script.sources, script.tree, wrong);
    const auto formula = expression
                             ? check_view(script.tree, *expression, run.last_stage(),
                                          run.last_stage(), *script.program, script.sources, wrong)
                             : std::nullopt;
    if (!formula || wrong.has_errors()) {
        errors.push_back(render(wrong, script.sources, {}));
        return std::nullopt;
    }
    auto fields = run.simulation->evaluate(*formula, run.last_stage());
    if (fields.size() == 1) return std::move(fields[0]);
    errors.push_back("a colour cannot be expected: " + text);
    return std::nullopt;
}

bool holds(double left, double right, const ExpectedValue& expected) {
    if (expected.relation == "<") return left < right;
    if (expected.relation == ">") return left > right;
    if (expected.relation == "<=") return left <= right;
    if (expected.relation == ">=") return left >= right;
    if (std::isnan(left) && std::isnan(right)) return true;
    return left == right || std::abs(left - right) <= expected.tolerance.value_or(0);
}

void compare_value(Run& run, const ExpectedValue& expected, Errors& errors) {
    const auto left = value_of(run, expected.left, errors);
    const auto right = value_of(run, expected.right, errors);
    if (!left || !right) return;
    const PlaneLayout& layout = left->layout();
    const DomainMask* mask = run.simulation->domain().inside();
    std::int64_t wrong = 0;
    double largest = -1;
    std::string worst;
    const auto look = [&](std::int64_t i, std::int64_t j, std::int64_t k) {
        const double a = left->number_at(i, j, k), b = right->number_at(i, j, k);
        if (holds(a, b, expected)) return;
        ++wrong;
        const double difference = std::isfinite(a - b) ? std::abs(a - b) : INFINITY;
        if (difference <= largest) return;
        largest = difference;
        worst = fmt::format("{}, {}, {} by {:.3g}: {} and {}", i, j, k, difference, a, b);
    };
    if (const auto& cell = expected.cell) {
        const auto [i, j, k] = *cell;
        if (i >= layout.width || j >= layout.height || k >= layout.depth) {
            errors.push_back("there is no such cell: expect " + expected.written);
            return;
        }
        look(i, j, k);
    } else {
        for (std::int64_t k = 0; k < layout.depth; ++k) {
            for (std::int64_t j = 0; j < layout.height; ++j) {
                for (std::int64_t i = 0; i < layout.width; ++i) {
                    if (!mask || mask->inside.at(i, j, k) != 0) look(i, j, k);
                }
            }
        }
    }
    if (wrong > 0) {
        errors.push_back(fmt::format("expect {} fails in {} {}, most in {}", expected.written,
                                     wrong, wrong == 1 ? "cell" : "cells", worst));
    }
}

std::vector<Field> species_of(const Run& run) {
    std::vector<Field> copies;
    for (const Field& each : run.simulation->state(run.last_stage()).species()) {
        copies.push_back(each.clone());
    }
    return copies;
}

void compare_bits(const Run& run, const Run& other, const std::string& name, Errors& errors) {
    const std::string difference =
        other.simulation ? same_bits(species_of(run), species_of(other)) : other.failure;
    if (!difference.empty()) errors.push_back("is not the same as " + name + ": " + difference);
}

/// Stores the bits of the first configuration of a case with a precision, and compares the other
/// configurations of this precision with them. Their bits must be the same.
void compare_with_first(const Run& run, const ScriptCase& script,
                        const Configuration& configuration, Errors& errors) {
    struct First {
        std::string name;
        std::vector<Field> species;
    };
    static std::map<std::pair<std::string, Precision>, First> known;
    const auto [place, is_new] = known.try_emplace({script.text, configuration.precision});
    if (is_new) {
        place->second = {configuration.name(), species_of(run)};
        return;
    }
    const std::string difference = same_bits(place->second.species, species_of(run));
    if (!difference.empty()) {
        errors.push_back("is not the same as " + place->second.name + ": " + difference);
    }
}

}  // namespace

std::string Configuration::name() const {
    return fmt::format("{}/{}/{}", backend == "jit" ? "jit" : "interpreter",
                       precision == Precision::single ? "single" : "double", threads);
}

std::vector<Configuration> configurations_of(const ScriptCase& script) {
    const std::string_view fastest = fastest_backend().name;
    if (!script.is_interpreted && !is_available("jit")) return {};
    if (script.is_only_checked() || script.runs_once) {
        return {{fastest, script.is_single ? Precision::single : Precision::binary64, 3}};
    }
    std::vector<Configuration> configurations;
    for (const std::string_view backend : {"interp", "jit"}) {
        if (backend == "jit" ? !is_available("jit") : !script.is_interpreted) continue;
        for (const int threads : {1, 3}) {
            if (script.is_single) configurations.push_back({backend, Precision::single, threads});
            if (script.is_double) configurations.push_back({backend, Precision::binary64, threads});
        }
    }
    return configurations;
}

std::vector<std::string> check_script(const ScriptFile& file, const ScriptCase& script,
                                      const std::filesystem::path& folder,
                                      const Configuration& configuration) {
    Errors errors;
    Run run = load(script, folder, configuration);
    const bool runs = run.script.program && !run.script.program->stages.empty();
    if (runs && !script.is_sound) run.start(configuration);
    compare_messages(run, script, errors);
    if (!runs && !script.is_only_checked() && script.expectations > script.messages.size()) {
        errors.push_back("nothing runs");
    }
    if (!run.simulation && run.failure.empty()) return errors;
    compare_words(run.warnings, script.warnings, "warning", errors);
    if (run.failure.empty() && script.failure) {
        errors.push_back("is missing: expect failure: " + *script.failure);
    }
    if (!run.failure.empty()) {
        if (!script.failure || !matches(run.failure, *script.failure)) {
            errors.push_back("is not expected: expect failure: " + run.failure);
        }
        return errors;
    }
    if (script.remarks) {
        run.remark();
        compare_words(run.remarks, *script.remarks, "remark", errors);
    }
    for (const ExpectedValue& each : script.values) compare_value(run, each, errors);
    compare_with_first(run, script, configuration, errors);
    for (const std::string& name : script.same_as) {
        Run other = load(*file.find(name), folder, configuration);
        if (other.script.program) other.start(configuration);
        compare_bits(run, other, name, errors);
    }
    return errors;
}

}  // namespace cascade::test

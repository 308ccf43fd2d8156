// Settings of systems and stages: iterations, interval, frozen, speed, show. Those of time are in
// check_time.cpp.
#include "lang/check/check_blocks.h"
#include "lang/check/check_time.h"
#include "lang/vocabulary/settings.h"

#include <fmt/format.h>

#include <cmath>

namespace cascade::checking {

namespace {

/// A hint for `0,0125`, digits on both sides of a comma: a decimal comma.
std::string hint_of_decimal_comma(const ast::Script& script, const ast::Statement& statement) {
    if (statement.values.size() != 2) return "";
    const Span whole = span_of(script, statement.values[0]);
    const Span part = span_of(script, statement.values[1]);
    const auto is_number = [&](std::size_t k) {
        return std::holds_alternative<ast::Number>(
            script.expressions[statement.values[k].root].node);
    };
    if (!is_number(0) || !is_number(1) || part.begin != whole.end + 1) return "";
    const std::string_view name = statement.name.text;
    const bool is_count = name == "iterations" || name == "interval" || name == "duration";
    if (is_count && part.end - part.begin == 3) {
        const auto number = [&](std::size_t k) {
            return std::get<ast::Number>(script.expressions[statement.values[k].root].node).value;
        };
        return fmt::format("write '{}'", 1000 * number(0) + number(1));
    }
    return "the decimal separator is a point: write '.' for ','";
}

}  // namespace

bool has_one_value(Workspace& work, const ast::Script& script, const ast::Statement& statement) {
    if (statement.values.size() == 1) return true;
    if (statement.values.empty()) return false;
    work.diagnostics.error(span_of(script, statement.values[1]),
                           fmt::format("'{}' takes one value", statement.name.text),
                           hint_of_decimal_comma(script, statement));
    return false;
}

std::optional<std::int64_t> check_count(Workspace& work, const ast::Script& script,
                                        const ast::Statement& statement) {
    const std::string_view name = statement.name.text;
    const Span span = span_of(script, statement.values[0]);
    const auto value = check_constant(work, script, statement.values[0], name);
    if (!value) return std::nullopt;
    const double least = name == "iterations" ? 0 : 1;
    if (*value < least) {
        const bool is_share = *value > 0 && name == "interval";
        work.diagnostics.error(span, fmt::format("{} must be at least {}", name, least),
                               is_share ? "it counts steps: write 'interval: 50'" : "");
        return std::nullopt;
    }
    if (*value > static_cast<double>(most_iterations)) {
        work.diagnostics.error(span, fmt::format("{} must be at most 1000000000", name));
        return std::nullopt;
    }
    if (*value != std::floor(*value)) {  // Also true for NaN.
        work.diagnostics.error(span, fmt::format("{} must be a whole number", name));
        return std::nullopt;
    }
    return static_cast<std::int64_t>(*value);
}

void check_setting(Workspace& work, const ast::Script& script, const ast::Statement& statement,
                   const Scope& scope, Settings& settings) {
    if (!has_one_value(work, script, statement)) return;
    const std::string_view name = statement.name.text;
    const Setting setting = *setting_named(name);
    const bool is_speed = setting == Setting::speed && !is_automatic(script, statement);
    const bool has_cells = is_of_cells(work, scope);
    if (has_cells && is_speed) {
        work.diagnostics.error(statement.name.span, "cells choose the length of their steps",
                               "leave speed out; largest_step limits it");
        return;
    }
    if (has_cells && setting == Setting::start) {
        work.diagnostics.error(statement.name.span, "cells that crawl have no coarser grid");
        return;
    }
    if (setting == Setting::iterations) {
        settings.iterations = check_count(work, script, statement);
    } else if (setting == Setting::interval) {
        settings.interval = check_count(work, script, statement);
    } else if (setting == Setting::show) {
        Scope picture = scope;
        picture.context = Context::picture;
        picture.last_stage = scope.stage.value_or(0);
        auto checked = check_expression(work, script, statement.values[0], picture);
        if (!checked) return;
        if (checked->type() != ValueType::number && checked->type() != ValueType::colour) {
            const TypeWords words = words_of(checked->type(), has_cells);
            work.diagnostics.error(span_of(script, statement.values[0]),
                                   fmt::format("{} cannot be shown", words.name),
                                   std::string(words.hint));
            return;
        }
        settings.show = std::move(checked->formula);
    } else if (setting == Setting::frozen || is_speed) {
        auto checked = check_number(work, script, statement.values[0], scope);
        if (!checked) return;
        if (is_speed && checked->constant && !(*checked->constant > 0)) {
            work.diagnostics.error(span_of(script, statement.values[0]), "speed must be above 0");
            return;
        }
        if (is_speed) settings.time.automatic_speed = false;
        (is_speed ? settings.speed : settings.frozen) = std::move(checked->formula);
    } else {
        check_time_setting(work, script, statement, scope, settings);
    }
    if (!has_cells && is_end_setting(name) && settings.time.duration && settings.iterations) {
        work.diagnostics.error(statement.name.span,
                               "a stage ends by its iterations or by its duration, not by both",
                               "leave one of them out");
    }
}

}  // namespace cascade::checking

// Checks the arguments of calls. check_context.cpp checks whether calls are allowed where they are.
#include "core/check.h"
#include "core/palette.h"
#include "ir/space.h"
#include "lang/check/names/domain_lengths.h"
#include "lang/check/expressions/expression_checker.h"
#include "lang/program/fold.h"
#include "lang/vocabulary/units.h"
#include "lang/vocabulary/words_elsewhere.h"

#include <fmt/format.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <numbers>
#include <utility>

namespace cascade::checking {

namespace {

constexpr double largest_of_points = 1e15;
/// Functions that must be called with `over`, as in sum(e over i).
constexpr std::array<std::string_view, 4> only_over{"sum", "mean", "product", "integral"};

std::string number_of_values(Arity arity) {
    if (arity.is_groups) {
        return fmt::format("groups of {} values{}", arity.least,
                           arity.most > arity.least ? ", and optionally one more" : "");
    }
    if (arity.is_range) return fmt::format("{} to {} values", arity.least, arity.most);
    if (arity.least != arity.most) {
        return fmt::format("{} or {} values", arity.least, arity.most);
    }
    return arity.least == 1 ? std::string("1 value") : fmt::format("{} values", arity.least);
}

}  // namespace

void ExpressionChecker::visit(const ast::Call& call) {
    if (is_direction_[NodeId(parts_.size() - 1)]) {
        return take_direction(
            call.function.text,
            std::span(script_.arguments).subspan(call.first_argument, call.argument_count));
    }
    if (is_unit_call(call.function.text)) return take_unit(call);
    const auto function = function_named(call.function.text);
    if (!function) return unknown_function(call);
    if (!info(*function).arity.takes(call.argument_count)) {
        return wrong_count(*function, call.argument_count);
    }
    if (!belongs_here(*function, call.function.span)) return;
    if (info(*function).arity.is_groups) return take_surface_value(*function, call);
    if (is_nonlocal(*function)) return take_convolution(call);
    if (reads_file(*function)) return take_file_value(*function, call);
    Operands operands{};
    for (std::uint32_t i = 0; i < call.argument_count; ++i) {
        operands[i] = part_of(script_.arguments[call.first_argument + i]);
    }
    const bool is_length =
        function == Function::abs && formula_.nodes[operands[0]].type == ValueType::vector;
    apply(is_length ? Function::length : *function, operands, call.argument_count);
}

/// Registers a distance(…) or keys(…). The arguments must be constant, because the value is
/// computed only once per cell, before the run.
void ExpressionChecker::take_surface_value(Function function, const ast::Call& call) {
    SurfaceValue value{function, {}};
    for (std::uint32_t k = 0; k < call.argument_count; ++k) {
        const NodeId part = part_of(script_.arguments[call.first_argument + k]);
        if (parts_[part].has_error) parts_.back().has_error = true;
        if (parts_.back().has_error) return;
        if (parts_[part].constant && !(std::abs(parts_[part].value) <= largest_of_points)) {
            return error(formula_.nodes[part].span, "this number is too large",
                         "coordinates are 0..1 along the longest side");
        }
        if (!parts_[part].constant) {
            return error(formula_.nodes[part].span,
                         fmt::format("{} takes only numbers that are known before the run",
                                     info(function).spelling),
                         "the points cannot move during the run");
        }
        value.numbers.push_back(parts_[part].value);
    }
    const bool has_smoothing = value.numbers.size() % 4 == 1;
    if (function == Function::keys && has_smoothing && value.numbers.back() < 0) {
        const ast::ExprId last = script_.arguments[call.first_argument + call.argument_count - 1];
        return error(formula_.nodes[part_of(last)].span,
                     "the length of smoothing must be at least 0");
    }
    formula_.nodes.back().kind = work_.program.literals->id_of(value);
}

/// Checks an aggregate over the domain, over touching cells or over near cells, such as mean(e over
/// domain). Aggregates over an index have already been expanded.
void ExpressionChecker::visit(const ast::Over& over) {
    const auto function = function_over(over.function.text, over.index.text);
    if (!function) {
        const bool is_domain = over.index.text == "domain";
        return error(over.function.span,
                     fmt::format("{} cannot be taken over {}", over.function.text,
                                 is_domain ? "the domain" : "neighbours"),
                     is_domain ? "use mean, sum, integral, min or max"
                               : "use mean, sum, min or max");
    }
    if (!belongs_here(*function, over.function.span)) return;
    if (over.index.text == "near" && !over.distance) {
        return error(over.index.span, "'near' takes a distance",
                     fmt::format("for example, {}(e over near(0.1))", over.function.text));
    }
    const NodeId operand = part_of(over.operand);
    if (!over.distance) return apply(*function, {operand}, 1);
    apply(*function, {operand, part_of(*over.distance)}, 2);
}

void ExpressionChecker::visit(const ast::Indexed&) {
    CHECK(false, "members of families are names when an expression is checked");
}

void ExpressionChecker::wrong_count(Function function, std::size_t count) {
    const FunctionInfo& row = info(function);
    std::string hint(row.meaning);
    if (count == 1 && (function == Function::min || function == Function::max)) {
        hint = fmt::format("write {}(e over domain) for all cells", row.spelling);
    }
    error(formula_.nodes.back().span,
          fmt::format("{} takes {}, not {}", row.spelling, number_of_values(row.arity), count),
          std::move(hint));
}

/// A hint about u(…), where u is a number. By the arguments, the author may mean another cell or
/// another time.
std::string ExpressionChecker::hint_of_number(const ast::Call& call) const {
    const auto argument = [&](std::uint32_t k) -> const ast::Expr& {
        return script_.expressions[script_.arguments[call.first_argument + k]];
    };
    const auto reads_time = [&](const ast::Expr& expr) {
        const auto* sum = std::get_if<ast::Binary>(&expr.node);
        const auto* name =
            std::get_if<ast::Name>(&(sum != nullptr ? script_.expressions[sum->left] : expr).node);
        return name != nullptr && name->name == "t";
    };
    if (call.argument_count == 1 && reads_time(argument(0))) {
        return fmt::format("values of earlier times cannot be read; write '{}' for the value now",
                           call.function.text);
    }
    if (call.argument_count > 1) {
        return fmt::format("write shifted({}, 1, 0) for the value in the next cell along x",
                           call.function.text);
    }
    return fmt::format("write '{0} * (…)' to multiply", call.function.text);
}

void ExpressionChecker::unknown_function(const ast::Call& call) {
    const ast::Word& name = call.function;
    if (scope_.system != unknown_system && find(work_.names[scope_.system], name.text) != nullptr) {
        error(name.span, fmt::format("'{}' is a number, not a function", name.text),
              hint_of_number(call));
        parts_.back().has_error = true;
        return;
    }
    parts_.back().has_error = true;
    if (lacks_names(from_)) return;
    report_unknown_function(work_, name, functions_of(work_, from_).names());
}

bool is_function_name(std::string_view name) {
    return function_named(name) || is_unit_call(name) ||
           std::find(only_over.begin(), only_over.end(), name) != only_over.end();
}

void report_unknown_function(Workspace& work, const ast::Word& name,
                             const std::vector<std::string>& own) {
    if (std::find(only_over.begin(), only_over.end(), name.text) != only_over.end()) {
        return work.diagnostics.error(name.span, fmt::format("{} needs 'over'", name.text),
                                      name.text == integral_word
                                          ? "write integral(e over domain)"
                                          : fmt::format("write {0}(e over i) or {0}(e over domain)",
                                                        name.text));
    }
    std::string hint(advice_about(name.text, WordContext::function));
    if (hint.empty() && !is_hopeless(work)) {
        std::vector<std::string> names = own;
        if (work.cell_functions != nullptr) {
            for (const ast::FunctionDefinition& each : work.cell_functions->functions) {
                names.emplace_back(each.name.text);
            }
        }
        for (std::size_t i = 0; i < function_count; ++i) {
            const FunctionInfo& row = info(static_cast<Function>(i));
            if (row.is_named) names.emplace_back(row.spelling);
        }
        // No suggestion is made for a single letter, because too many names are similar to it.
        if (name.text.size() > 1) hint = did_you_mean(work, name.text, names);
        if (hint.empty()) {
            hint = fmt::format("define the function, as in fn {}(a, b) = …", name.text);
        }
    }
    work.diagnostics.error(name.span, fmt::format("there is no function '{}'", name.text),
                           std::move(hint));
}

void ExpressionChecker::apply(Function function, const Operands& operands, std::size_t count) {
    Node& node = formula_.nodes.back();
    node.kind = Call();
    node.function = function;
    node.operands = operands;
    node.operand_count = static_cast<std::uint8_t>(count);
    for (std::size_t i = 0; i < count; ++i) {
        if (parts_[operands[i]].has_error) parts_.back().has_error = true;
    }
    if (parts_.back().has_error) return;
    if (function == Function::along && formula_.nodes[operands[0]].calls(Function::image)) {
        return take_painted_direction(operands[0]);
    }
    if (function == Function::along && is_direction_[operands[0]]) {
        node.kind = std::exchange(formula_.nodes[operands[0]].kind, 0.0);
        node.operand_count = 0;
        return;
    }
    check_types(node);
    if (parts_.back().has_error) return;
    check_angle(node);
    fold_constants(node);
}

void ExpressionChecker::need(NodeId part, ValueType type) {
    const Node& operand = formula_.nodes[part];
    if (operand.type == type || parts_.back().has_error) return;
    if (type == ValueType::text) {
        return error(operand.span, "a text in quotes is expected here");
    }
    const TypeWords words = words_of(operand.type, in_cells());
    error(operand.span, fmt::format("{} is not a number", words.name), std::string(words.hint));
}

void ExpressionChecker::check_types(const Node& node) {
    const auto& operands = node.operands;
    if (check_vectors(node)) return;
    if (differentiates(node.function)) return check_operator(node);
    switch (info(node.function).kind) {
        case FunctionKind::choice: {
            const bool is_if = node.function == Function::if_;
            need(operands[is_if ? 0 : 2], ValueType::number);
            return check_choice(formula_.nodes.back(), operands[is_if ? 1 : 0],
                                operands[is_if ? 2 : 1]);
        }
        case FunctionKind::geometry: return check_geometry(formula_.nodes.back());
        case FunctionKind::link: return check_link(formula_.nodes.back());
        case FunctionKind::pattern: check_lattice(formula_.nodes.back()); break;
        case FunctionKind::colour:
            if (node.function == Function::palette) return check_palette(node);
            formula_.nodes.back().type = ValueType::colour;
            check_rgb(node);
            break;
        default: break;
    }
    for (const NodeId operand : node.reads()) need(operand, ValueType::number);
}

void ExpressionChecker::check_choice(Node& node, NodeId a, NodeId b) {
    const ValueType type = formula_.nodes[a].type;
    const bool is_chosen =
        type == ValueType::number || type == ValueType::colour || type == ValueType::vector;
    if ((type != formula_.nodes[b].type || !is_chosen) && !parts_.back().has_error) {
        return error(formula_.nodes[b].span,
                     fmt::format("{} needs two numbers, two vectors or two colours to choose from",
                                 info(node.function).spelling));
    }
    node.type = type;
    parts_.back().turned = parts_[a].turned || parts_[b].turned;
}

/// Warns of colour components above 1. For example, rgb(255, 128, 0) would be yellow.
void ExpressionChecker::check_rgb(const Node& node) {
    std::array<double, 3> parts{};
    for (std::size_t k = 0; k < parts.size(); ++k) {
        if (!parts_[node.operands[k]].constant) return;
        parts[k] = parts_[node.operands[k]].value;
    }
    const auto [least, most] = std::minmax_element(parts.begin(), parts.end());
    if (!(*least >= 0 && *most > 2 && *most <= 255)) return;
    const auto share = [&](std::size_t k) { return fmt::format("{:.3g}", parts[k] / 255); };
    warn(node.span, "red, green and blue must be from 0 to 1",
         fmt::format("write rgb({}, {}, {})", share(0), share(1), share(2)));
}

void ExpressionChecker::check_palette(const Node& node) {
    for (std::size_t i = 0; i < 3; ++i) need(node.operands[i], ValueType::number);
    need(node.operands[3], ValueType::text);
    if (parts_.back().has_error) return;
    const Node& text = formula_.nodes[node.operands[3]];
    const std::string& name = work_.program.literals->text(*text.as<TextId>());
    if (find_palette(name) == nullptr) {
        std::vector<std::string> names;
        for (const Palette& palette : palettes()) names.emplace_back(palette.name);
        std::string hint = did_you_mean(work_, name, names);
        if (name.starts_with('#')) {
            hint =
                "write the name of a palette, or 2 to 64 colours such as \"#1b2a49 #f08a5d "
                "#fff\"";
        }
        if (hint.empty()) hint = "the palettes are " + list_names(names);
        return error(text.span, fmt::format("there is no palette '{}'", name), std::move(hint));
    }
    const Part &low = parts_[node.operands[1]], &high = parts_[node.operands[2]];
    if (low.constant && high.constant && low.value == high.value) {
        warn(node.span,
             fmt::format("both ends of the palette are {:.4g}: it has no colours between them",
                         low.value),
             "write palette(value, low, high, \"name\") with low below high");
    }
    formula_.nodes.back().type = ValueType::colour;
}

/// Warns of an angle that is a whole number above a full turn in radians. The author probably means
/// degrees.
void ExpressionChecker::check_angle(const Node& node) {
    const bool is_stripe = node.function == Function::stripe && node.operand_count == 3;
    if (node.function != Function::diffuse && node.function != Function::tensor && !is_stripe)
        return;
    const NodeId last = node.operands[node.operand_count - 1u];
    const Part& angle = parts_[last];
    const bool is_odd = angle.constant && std::abs(angle.value) > 2 * std::numbers::pi &&
                        angle.value == std::floor(angle.value);
    if (!is_odd) return;
    warn(formula_.nodes[last].span,
         fmt::format("{:.4g} radians are {:.3g} turns", angle.value,
                     angle.value / (2 * std::numbers::pi)),
         fmt::format("{0:.4g} degrees are {0:.4g} * pi / 180", angle.value));
}

void ExpressionChecker::warn(Span span, std::string message, std::string hint) {
    Diagnostic diagnostic{Severity::warning, span, std::move(message), std::move(hint), {}};
    add_call(work_, diagnostic);
    work_.diagnostics.add(std::move(diagnostic));
}

/// Checks noise and lattices. Their first argument must be a length. The number of octaves of noise
/// must be constant.
void ExpressionChecker::check_lattice(Node& node) {
    const Part& side = parts_[node.operands[0]];
    if (side.constant && !(side.value > 0)) {
        return error(formula_.nodes[node.operands[0]].span,
                     fmt::format("the {} must be above 0",
                                 node.function == Function::noise ? "scale of noise" : "spacing"));
    }
    if (node.function != Function::noise) return;
    node.kind = Call{1};
    if (node.operand_count < 2) return;
    const Part& octaves = parts_[node.operands[1]];
    const bool is_count = octaves.constant && octaves.value == std::floor(octaves.value) &&
                          octaves.value >= 1 && octaves.value <= most_octaves;
    if (!is_count) {
        return error(formula_.nodes[node.operands[1]].span,
                     fmt::format("the number of octaves must be a whole number from 1 to {}",
                                 most_octaves),
                     "the number must be known before the run");
    }
    node.kind = Call{static_cast<std::uint8_t>(octaves.value)};
}

void ExpressionChecker::fold_constants(const Node& node) {
    std::array<double, most_operands> values{};
    bool constant = true;
    for (std::size_t i = 0; i < node.operand_count; ++i) {
        const Part& part = parts_[node.operands[i]];
        constant = constant && part.constant;
        values[i] = part.value;
    }
    // A denormal divisor counts as zero, because arithmetic flushes denormal numbers to zero.
    const bool divides = info(node.function).behaviour == Behaviour::divides;
    if (divides && parts_[node.operands[1]].constant &&
        std::abs(values[1]) < static_cast<double>(FLT_MIN)) {
        return error(formula_.nodes[node.operands[1]].span, "division by zero");
    }
    if (!constant) return;
    const auto value = fold(node.function, values);
    if (!value) return;
    const bool was_finite = std::all_of(values.begin(), values.begin() + node.operand_count,
                                        [](double each) { return std::isfinite(each); });
    const bool was_in_range =
        std::all_of(values.begin(), values.begin() + node.operand_count,
                    [](double each) { return std::abs(each) <= double{FLT_MAX}; });
    const bool leaves_range = was_in_range && std::abs(*value) > double{FLT_MAX};
    if (was_finite && (!std::isfinite(*value) || leaves_range)) {
        const std::string hint =
            std::isnan(*value) ? "the result is not defined for these numbers"
            : std::isinf(*value)
                ? "the result is infinite for these numbers"
                : fmt::format("{:.3g} is infinite in single precision, which ends at 3.4e38",
                              *value);
        warn(node.span, fmt::format("{} has no finite value here", info(node.function).spelling),
             hint);
    }
    parts_.back() = {false, true, *value};
}

}  // namespace cascade::checking

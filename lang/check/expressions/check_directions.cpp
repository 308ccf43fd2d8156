// Checks the arguments of directions against a table of all directions. Evaluates the arguments
// that are numbers, and refuses vectors of length 0.
#include "lang/check/expressions/check_directions.h"

#include "lang/check/expressions/expression_checker.h"
#include "lang/check/expressions/setting_words.h"
#include "lang/check/expressions/read_setting.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <span>

namespace cascade::checking {

namespace {

// The default smoothing of directions, in units of the model's longest side. Curvature is estimated
// triangle by triangle, so directions of curvature are smoothed a little. Directions of keys jump
// between the regions of two keys, so these directions are smoothed more.
constexpr double smoothing_of_curvature = 0.02;
constexpr double smoothing_of_keys = 0.1;
constexpr double largest_number = 1e15;

struct DirectionName {
    std::string_view word;
    DirectionSettings::Kind kind;
    Arity arity;       ///< The number of arguments, not counting the optional smoothing.
    double smoothing;  ///< The smoothing if the script gives none.
    std::string_view form;
};
constexpr std::array<DirectionName, 5> direction_names{{
    {"axis", DirectionSettings::Kind::axis, 3, 0, "axis(0, 1, 0)"},
    {"gradient", DirectionSettings::Kind::gradient, 1, 0, "gradient(x^2 + z^2)"},
    {"curvature_high", DirectionSettings::Kind::curvature_high, either(0, 1),
     smoothing_of_curvature, "curvature_high or curvature_high(0.05)"},
    {"curvature_low", DirectionSettings::Kind::curvature_low, either(0, 1), smoothing_of_curvature,
     "curvature_low or curvature_low(0.05)"},
    {"keys", DirectionSettings::Kind::keys, groups_of(6, 1), smoothing_of_keys,
     "keys(x, y, z, dx, dy, dz, …) or keys(…, smoothing)"},
}};

const DirectionName* direction_named(std::string_view word) {
    for (const DirectionName& name : direction_names) {
        if (name.word == word) return &name;
    }
    return nullptr;
}

/// The numbers in the brackets. If a number is not constant, reports an error and returns nullopt.
std::optional<std::vector<WrittenNumber>> numbers_of(Workspace& work, const ast::Script& script,
                                                     std::span<const ast::Expression> arguments) {
    std::vector<WrittenNumber> numbers;
    for (const ast::Expression each : arguments) {
        const auto number = check_constant(work, script, each, "each number of directions");
        if (!number) return std::nullopt;
        numbers.push_back({*number, script.expressions[each.root].span});
    }
    return numbers;
}

/// Whether every vector among the numbers has a length other than 0. The numbers are groups of
/// `stride`. The last three numbers of each group are a vector.
bool has_lengths(std::span<const double> numbers, std::size_t stride) {
    for (std::size_t k = stride - 3; k + 2 < numbers.size(); k += stride) {
        if (numbers[k] == 0 && numbers[k + 1] == 0 && numbers[k + 2] == 0) return false;
    }
    return true;
}

}  // namespace

bool names_direction(std::string_view word) {
    const DirectionName* name = direction_named(word);
    return name != nullptr && name->kind != DirectionSettings::Kind::gradient;
}

std::optional<DirectionSettings> direction_of(Workspace& work, std::string_view word,
                                              std::span<const WrittenNumber> numbers, Span span,
                                              std::string_view form) {
    const DirectionName& name = *direction_named(word);
    const auto refuse = [&](Span at, const char* message, bool shows_form) {
        work.diagnostics.error(
            at, message, shows_form ? fmt::format(fmt::runtime(form), name.form) : std::string());
        return std::nullopt;
    };
    const bool may_stand_alone = name.arity.least == 0;
    if (numbers.empty() ? !may_stand_alone : !name.arity.takes(numbers.size())) {
        return refuse(span, "these directions are not written correctly", true);
    }
    DirectionSettings read;
    read.kind = name.kind;
    read.smoothing = name.smoothing;
    read.span = span;
    for (const WrittenNumber& number : numbers) {
        if (!(std::abs(number.value) <= largest_number)) {
            return refuse(number.span, "this number is too large", false);
        }
        read.numbers.push_back(number.value);
    }
    const std::size_t stride = name.kind == DirectionSettings::Kind::keys ? 6 : 3;
    if (numbers.size() % stride == 1) {
        read.smoothing = read.numbers.back();
        read.numbers.pop_back();
        if (read.smoothing < 0) {
            return refuse(numbers.back().span, "the length of smoothing must be at least 0", false);
        }
    }
    if (!has_lengths(read.numbers, stride)) {
        return refuse(span, "this vector has no direction, because its length is 0", true);
    }
    return read;
}

std::optional<DirectionSettings> check_directions(Workspace& work, const ast::Script& script,
                                                  const ast::Statement& statement) {
    if (!has_one_value(work, script, statement)) return std::nullopt;
    const ast::Expr& value = value_of(script, statement);
    if (std::holds_alternative<ast::Garbage>(value.node)) return std::nullopt;
    const std::string_view word = word_of(value);
    const DirectionName* name = direction_named(word);
    if (name == nullptr) {
        std::vector<std::string> words;
        for (const DirectionName& each : direction_names) words.emplace_back(each.word);
        work.diagnostics.error(
            value.span,
            "'directions' must be axis, gradient, curvature_high, curvature_low or "
            "keys",
            did_you_mean(work, word, words));
        return std::nullopt;
    }
    const std::vector<ast::Expression> arguments = arguments_of(script, statement.values[0]);
    if (name->kind == DirectionSettings::Kind::gradient && arguments.size() == 1) {
        Scope scope;
        scope.context = Context::position;
        auto height = check_number(work, script, arguments[0], scope);
        if (!height) return std::nullopt;
        DirectionSettings read;
        read.kind = name->kind;
        read.span = value.span;
        read.height = std::move(height->formula);
        return read;
    }
    const auto numbers = numbers_of(work, script, arguments);
    if (!numbers) return std::nullopt;
    return direction_of(work, word, *numbers, value.span, "for example, directions: {}");
}

/// Registers a direction of the model, which `along` accepts in place of a vector.
void ExpressionChecker::take_direction(std::string_view word,
                                       std::span<const ast::ExprId> arguments) {
    const Span span = formula_.nodes.back().span;
    std::vector<WrittenNumber> numbers;
    for (const ast::ExprId argument : arguments) {
        const NodeId part = part_of(argument);
        if (parts_[part].has_error) parts_.back().has_error = true;
        if (parts_.back().has_error) return;
        if (!parts_[part].constant) {
            return error(formula_.nodes[part].span,
                         fmt::format("{} takes only numbers that are known before the run", word),
                         "write along(vector(ex, ey, ez)) for a direction that changes");
        }
        numbers.push_back({parts_[part].value, formula_.nodes[part].span});
    }
    const auto read = direction_of(work_, word, numbers, span, "for example, along({})");
    if (!read) {
        parts_.back().has_error = true;
        return;
    }
    formula_.nodes.back().kind = work_.program.literals->id_of(
        SurfaceValue{Function::along, read->numbers, read->kind, read->smoothing});
}

}  // namespace cascade::checking

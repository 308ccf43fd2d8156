// A table of the directions with their arguments; numbers are folded, vectors of length 0 refused.
#include "lang/check/check_directions.h"

#include "lang/check/setting_words.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <span>

namespace cascade::checking {

namespace {

using Kind = DirectionSettings::Kind;

// In units of the model's longest side. Curvature is estimated triangle by triangle, so its lines
// are smoothed a little; the lines of keys jump between the regions of two keys and are smoothed
// more.
constexpr double smoothing_of_curvature = 0.02;
constexpr double smoothing_of_keys = 0.1;
constexpr double largest_number = 1e15;

struct DirectionName {
    std::string_view word;
    Kind kind;
    Arity arity;       ///< Without the optional smoothing.
    double smoothing;  ///< The default.
    std::string_view form;
};
constexpr std::array<DirectionName, 5> direction_names{{
    {"axis", Kind::axis, 3, 0, "axis(0, 1, 0)"},
    {"gradient", Kind::gradient, 1, 0, "gradient(x^2 + z^2)"},
    {"curvature_high", Kind::curvature_high, either(0, 1), smoothing_of_curvature,
     "curvature_high or curvature_high(0.05)"},
    {"curvature_low", Kind::curvature_low, either(0, 1), smoothing_of_curvature,
     "curvature_low or curvature_low(0.05)"},
    {"keys", Kind::keys, groups_of(6, 1), smoothing_of_keys,
     "keys(x, y, z, dx, dy, dz, …) or keys(…, smoothing)"},
}};

const DirectionName* direction_named(std::string_view word) {
    for (const DirectionName& name : direction_names) {
        if (name.word == word) return &name;
    }
    return nullptr;
}

/// The numbers in brackets; reports an error and returns nothing if one is not constant.
std::optional<std::vector<double>> numbers_of(Workspace& work, const ast::Script& script,
                                              std::span<const ast::Expression> arguments) {
    std::vector<double> numbers;
    for (const ast::Expression each : arguments) {
        const auto number = check_constant(work, script, each, "each number of directions");
        if (!number) return std::nullopt;
        if (!(std::abs(*number) <= largest_number)) {
            work.diagnostics.error(script.expressions[each.root].span, "this number is too large");
            return std::nullopt;
        }
        numbers.push_back(*number);
    }
    return numbers;
}

/// True if no vector of a key, and not the axis, has length 0.
bool has_lengths(std::span<const double> numbers, std::size_t stride) {
    for (std::size_t k = stride - 3; k + 2 < numbers.size(); k += stride) {
        if (numbers[k] == 0 && numbers[k + 1] == 0 && numbers[k + 2] == 0) return false;
    }
    return true;
}

std::optional<DirectionSettings> read_numbers(Workspace& work, const ast::Script& script,
                                              std::span<const ast::Expression> arguments,
                                              const DirectionName& name, DirectionSettings read) {
    auto numbers = numbers_of(work, script, arguments);
    if (!numbers) return std::nullopt;
    const std::size_t stride = name.kind == Kind::keys ? 6 : 3;
    if (numbers->size() % stride == 1) {
        read.smoothing = numbers->back();
        numbers->pop_back();
        if (read.smoothing < 0) {
            work.diagnostics.error(script.expressions[arguments.back().root].span,
                                   "a length of smoothing is not below 0");
            return std::nullopt;
        }
    }
    if (!has_lengths(*numbers, stride)) {
        work.diagnostics.error(read.span, "a vector of length 0 has no direction",
                               fmt::format("directions: {}", name.form));
        return std::nullopt;
    }
    read.numbers = *std::move(numbers);
    return read;
}

}  // namespace

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
            value.span, "directions are axis, gradient, curvature_high, curvature_low or keys",
            did_you_mean(work, word, words));
        return std::nullopt;
    }
    const std::vector<ast::Expression> arguments = arguments_of(script, statement.values[0]);
    const bool may_stand_alone = name->arity.least == 0;
    if (arguments.empty() ? !may_stand_alone : !name->arity.takes(arguments.size())) {
        work.diagnostics.error(value.span, "this is not how directions are written",
                               fmt::format("directions: {}", name->form));
        return std::nullopt;
    }
    DirectionSettings read;
    read.kind = name->kind;
    read.smoothing = name->smoothing;
    read.span = value.span;
    if (name->kind == Kind::gradient) {
        Scope scope;
        scope.context = Context::position;
        auto height = check_number(work, script, arguments[0], scope);
        if (!height) return std::nullopt;
        read.height = std::move(height->formula);
        return read;
    }
    return read_numbers(work, script, arguments, *name, std::move(read));
}

}  // namespace cascade::checking

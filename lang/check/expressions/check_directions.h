// The setting `directions` of a domain with a model (internal to the checker).
#pragma once

#include "lang/check/names/check_names.h"
#include "lang/program/domain.h"
#include "lang/syntax/ast.h"

#include <optional>
#include <span>
#include <string_view>

namespace cascade::checking {

/// Whether the word is the name of a direction of a model, such as `axis`. If it is not, the
/// setting gives a vector.
bool names_direction(std::string_view word);

struct WrittenNumber {
    double value = 0;
    Span span;
};

/// The direction called `word`, with these numbers in brackets. If the direction does not accept
/// the numbers, reports an error and returns nullopt. `form` is the format string of a hint.
std::optional<DirectionSettings> direction_of(Workspace& work, std::string_view word,
                                              std::span<const WrittenNumber> numbers, Span span,
                                              std::string_view form);

/// Parses axis(…), gradient(…), curvature_high, curvature_low or keys(…). Reports errors.
std::optional<DirectionSettings> check_directions(Workspace& work, const ast::Script& script,
                                                  const ast::Statement& statement);

}  // namespace cascade::checking

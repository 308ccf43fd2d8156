// `directions` of a domain with a model (internal to the checker).
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace cascade::checking {

/// Do these words begin a direction that a model has, in place of a vector?
bool names_direction(std::string_view word);

struct WrittenNumber {
    double value = 0;
    Span span;
};

/// The direction of that name with these numbers in brackets; reports errors and returns nothing if
/// it is written otherwise. `form` is a format of the hints.
std::optional<DirectionSettings> direction_of(Workspace& work, std::string_view word,
                                              std::span<const WrittenNumber> numbers, Span span,
                                              std::string_view form);

/// Parses axis(…), gradient(…), curvature_high, curvature_low or keys(…); reports errors.
std::optional<DirectionSettings> check_directions(Workspace& work, const ast::Script& script,
                                                  const ast::Statement& statement);

}  // namespace cascade::checking

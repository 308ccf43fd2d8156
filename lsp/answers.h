// Answers to the requests of editors about a document. answers() lists them.
#pragma once

#include "core/result.h"
#include "lsp/document.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <span>
#include <string_view>

namespace cascade::lsp {

using Json = nlohmann::json;

/// A request about a document.
struct Asked {
    Document& document;
    const Json& params;
    std::size_t byte = 0;  ///< The byte at the request's position; 0 if it has none.
};

/// A member of an object. Null if the member is missing or `object` is no object.
const Json& member(const Json& object, const char* name);
/// The text of a member. Empty if the member is missing or is no text.
std::string text_of_member(const Json& object, const char* name);
/// Reads a position. Empty if `json` is no position.
std::optional<Position> position_from(const Json& json);

Json json_of(Position position);
/// The range between two bytes of a document.
Json range_of(const Document& document, std::size_t begin, std::size_t end);
inline Json range_of(const Document& document, Span span) {
    return range_of(document, span.begin, span.end);
}
/// The bytes [begin, end) of a range. Empty if `json` is no range.
std::optional<std::pair<std::size_t, std::size_t>> bytes_of_range(const Document& document,
                                                                  const Json& json);
/// The address and range of a span in any source of a script. Null if the source is a text of the
/// library that could not be written to a file.
Json location_of(Document& document, Span span);

/// The diagnostics of a document, at most `most_diagnostics`.
Json diagnostics_of(Document& document);
inline constexpr std::size_t most_diagnostics = 500;

struct Answer {
    std::string_view request;  ///< The name of the protocol's method.
    bool has_position;         ///< Whether the request is about a position.
    Result<Json> (*answer)(const Asked&);
};
std::span<const Answer> answers();

Result<Json> hover(const Asked& asked);
Result<Json> completion(const Asked& asked);
Result<Json> definition(const Asked& asked);
Result<Json> references(const Asked& asked);
Result<Json> highlights(const Asked& asked);
Result<Json> prepare_rename(const Asked& asked);
Result<Json> rename(const Asked& asked);
Result<Json> formatting(const Asked& asked);
Result<Json> symbols(const Asked& asked);
Result<Json> folding(const Asked& asked);
Result<Json> semantic_tokens(const Asked& asked);
Result<Json> colours(const Asked& asked);
Result<Json> colour_texts(const Asked& asked);
Result<Json> code_actions(const Asked& asked);
Result<Json> links(const Asked& asked);

/// The types of semantic tokens, in the order of their numbers.
Json semantic_legend();

}  // namespace cascade::lsp

// The names that a script may contain: what they mean, and which of them can follow a text that is
// being typed.
#pragma once

#include "lang/program/program.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

// clang-format off
enum class NameKind : std::uint8_t {
    species, parameter, definition, stage, system, function, value, setting, word, palette, keyword,
};
// clang-format on
/// As readers call it: "species", "parameter", …
std::string_view name_of(NameKind kind);

struct KnownName {
    std::string name;
    NameKind kind = NameKind::keyword;
    std::string note;  ///< Its doc comment or meaning; may be empty.
};

/// All names of the language and of a program, sorted, each once.
std::vector<KnownName> known_names(const Program& program);

/// The names that may stand in place of the last word of a text: after `STAGE.` the items of that
/// stage, after a setting its words, in a palette's quotes palettes, at the start of a statement
/// the settings of its block, … Blocks may be open, and the text need not be correct.
std::vector<KnownName> completions(std::string_view text, const Program& program);

/// What the last word of a text means where it stands. For a species or a parameter, also the stage
/// whose values it has there: `stage` unless the text says otherwise.
struct Mention {
    KnownName known;
    std::optional<StageItem> item;
};
std::optional<Mention> mention_at_end(std::string_view text, const Program& program,
                                      std::uint32_t stage);

/// The letters, Greek ones included, digits and _ at the end of a text.
std::string_view last_word(std::string_view text);

}  // namespace cascade

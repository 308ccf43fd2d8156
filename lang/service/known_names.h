// The names that a script may contain: what they mean, and which of them may stand at a position of
// a text that is being written.
#pragma once

#include "lang/program/program.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

// clang-format off
enum class NameKind : std::uint8_t {
    species, parameter, definition, stage, system, shape, function, value, setting, word, palette, keyword,
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

/// The names that may stand in place of the word that ends at a byte of a text: after `STAGE.` the
/// items of that stage, after a setting its words, in a palette's quotes palettes, at the start of
/// a statement the settings of its block, … Blocks may be open, and the text need not be correct:
/// only what comes before the byte is read. `program` is the last one that was correct.
std::vector<KnownName> completions(std::string_view text, std::size_t byte, const Program& program);

/// What the word at or before a byte of a text means there. For a species or a parameter, also the
/// stage whose values it has: `stage` unless the text says otherwise.
struct Mention {
    KnownName known;
    std::optional<StageItem> item;
};
std::optional<Mention> mention(std::string_view text, std::size_t byte, const Program& program,
                               std::uint32_t stage);

/// The end of the word at a byte of a text: the byte after its last letter, Greek ones included.
std::size_t end_of_word(std::string_view text, std::size_t byte);
/// The letters, Greek ones included, digits and _ at the end of a text.
std::string_view last_word(std::string_view text);

}  // namespace cascade

// The names that a script may contain, with their meanings. Also the names that are allowed at a
// position of a text that is being written.
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
/// The kind, in the words in which users read it: "species", "parameter", …
std::string_view name_of(NameKind kind);

struct KnownName {
    std::string name;
    NameKind kind = NameKind::keyword;
    std::string note;  ///< The name's doc comment or meaning; may be empty.
};

/// All names of the language and of a program, sorted and without duplicates.
std::vector<KnownName> known_names(const Program& program);

/// The names that may replace the word that ends at a byte of a text: for example the items of a
/// stage after `STAGE.`, the words of a setting after its colon, palettes in the quotes of a
/// palette, or the settings of a block at the start of a statement. Only the text before the byte
/// is read, and it may have errors and unclosed blocks. `program` is the last version of the script
/// that was correct.
std::vector<KnownName> completions(std::string_view text, std::size_t byte, const Program& program);

/// The meaning of the word at or before a byte of a text. For a species or a parameter, also the
/// stage whose values the word means: the stage that the text names, or the first stage of the
/// system that the block around the byte declares, or otherwise `stage`. The program may have no
/// stages.
struct Mention {
    KnownName known;
    std::optional<StageItem> item;
};
std::optional<Mention> mention(std::string_view text, std::size_t byte, const Program& program,
                               std::uint32_t stage);

/// The end of the word at a byte of a text: the position after the word's last letter. Greek
/// letters count as letters.
std::size_t end_of_word(std::string_view text, std::size_t byte);
/// The name at the end of a text: the letters (Greek letters, too), digits and _ with which the
/// text ends.
std::string_view last_word(std::string_view text);

}  // namespace cascade

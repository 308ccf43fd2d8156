// Finds where the names of a script are declared and used. Answers editors' questions about a byte
// of a text.
#pragma once

#include "core/diagnostics.h"
#include "core/result.h"
#include "core/source.h"
#include "lang/check/names/name_uses.h"
#include "lang/syntax/ast.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// The names of systems, stages, shapes, their quantities and definitions, indices, functions and
/// their parameters, and constants in a script. Names in options are not included.
class NameIndex {
public:
    /// Checks a script. If the script has errors, some names may be missing from the index. `read`
    /// contains the errors that were found when the tree was read, and may contain other errors.
    /// `text` is the script's source. The tree may also contain systems and functions of other
    /// sources. The check adds texts of the library to `sources`, which must outlive the index.
    NameIndex(const ast::Script& tree, const Diagnostics& read, Sources& sources, SourceId text);

    /// The name that contains a byte of the text or ends directly before it. nullopt if there is no
    /// such name.
    std::optional<Span> name_at(std::uint32_t byte) const;
    /// The declaration of the name at this byte, in any of the sources. If a derived system
    /// replaces the declaration, the result is the declaration that is valid at this byte.
    std::optional<Span> declaration_at(std::uint32_t byte) const;
    /// All places where the name at this byte is used or declared, in all sources, in ascending
    /// order.
    std::vector<Span> uses_at(std::uint32_t byte) const;

    /// The text with `name` in place of the name at this byte. Fails if the old name also occurs in
    /// another source, if the new text would have errors, or if the meaning of any name would
    /// change.
    Result<std::string> renamed(std::uint32_t byte, std::string_view name) const;

private:
    struct Word {
        Span span;
        std::size_t declaration = 0;  ///< The index of the declaration in `words_`.
        std::size_t group = 0;        ///< The index of the first word with the same meaning.
    };
    void add(const NameUses& uses);
    const Word* find(std::uint32_t byte) const;
    std::vector<std::size_t> meanings() const;

    const Sources& sources_;
    SourceId text_;
    /// The other sources of the tree, in the order in which the tree first uses them.
    std::vector<SourceId> used_;
    std::size_t errors_ = 0;
    std::vector<Word> words_;  ///< All words, in ascending order of their positions.
};

}  // namespace cascade

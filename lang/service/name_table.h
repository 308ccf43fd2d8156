// Where the names of a script are declared and used, for editors: a text, a byte of it, an answer.
#pragma once

#include "core/result.h"
#include "core/source.h"
#include "lang/check/name_uses.h"
#include "lang/syntax/ast.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// Systems, stages, shapes, their quantities and definitions, indices, functions, their parameters,
/// and constants. Names of options are left out.
class NameTable {
public:
    /// Checks a script, which may have errors: then names that they hide are missing. `text` is its
    /// source; the tree may hold systems and functions of other sources, too. Texts of the library
    /// are added to `sources`, which must outlive the table.
    NameTable(const ast::Script& tree, Sources& sources, SourceId text);

    /// The name at a byte of the text or directly before it; nothing if there is none.
    std::optional<Span> name_at(std::uint32_t byte) const;
    /// The statement that declares this name, in any of the sources: of several, one of which
    /// changes the other, that which has a meaning there.
    std::optional<Span> declaration_at(std::uint32_t byte) const;
    /// Wherever this name is used or declared, in all sources, in ascending order.
    std::vector<Span> uses_at(std::uint32_t byte) const;

    /// The text with another name in the place of this one. Fails if a part of it is in another
    /// source, and if the new text would have errors or any name in it another meaning.
    Result<std::string> renamed(std::uint32_t byte, std::string_view name) const;

private:
    struct Word {
        Span span;
        std::size_t declaration = 0;  ///< Into `words_`.
        std::size_t group = 0;        ///< The first word that means the same.
    };
    void add(const NameUses& uses);
    const Word* find(std::uint32_t byte) const;
    std::vector<std::size_t> meanings() const;

    const Sources& sources_;
    SourceId text_;
    std::vector<SourceId> used_;  ///< The other sources of the tree, in its order.
    std::size_t errors_ = 0;
    std::vector<Word> words_;  ///< In ascending order.
};

}  // namespace cascade

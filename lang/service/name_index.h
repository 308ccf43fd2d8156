// Where the names of a script are declared and used: answers for editors about a byte of a text.
#pragma once

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

/// Systems, stages, shapes, their quantities and definitions, indices, functions, their parameters,
/// and constants. Names of options are left out.
class NameIndex {
public:
    /// Checks a script. It may have errors, which may hide names. `text` is its source. The tree
    /// may hold systems and functions of other sources, too. Texts of the library are added to
    /// `sources`, which must outlive the index.
    NameIndex(const ast::Script& tree, Sources& sources, SourceId text);

    /// The name at a byte of the text or directly before it; nothing if there is none.
    std::optional<Span> name_at(std::uint32_t byte) const;
    /// The declaration of this name, in any of the sources. If a derived system replaces a
    /// declaration, it is the one that counts at this byte.
    std::optional<Span> declaration_at(std::uint32_t byte) const;
    /// Wherever this name is used or declared, in all sources, in ascending order.
    std::vector<Span> uses_at(std::uint32_t byte) const;

    /// The text with this name replaced by another. Fails if the name also occurs in another
    /// source, and if the new text would have errors or would change the meaning of any name.
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

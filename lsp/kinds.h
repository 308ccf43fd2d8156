// The numbers and words by which the protocol denotes kinds of names.
#pragma once

#include "lang/service/known_names.h"

#include <array>
#include <string_view>

namespace cascade::lsp {

struct KindNumbers {
    NameKind kind;
    int completion;           ///< CompletionItemKind
    int symbol;               ///< SymbolKind
    std::string_view colour;  ///< The type of a semantic token.
};

/// A row for each NameKind, in its order.
inline constexpr std::array<KindNumbers, 12> kind_numbers{{
    {NameKind::species, 6, 13, "variable"},
    {NameKind::parameter, 21, 14, "parameter"},
    {NameKind::definition, 6, 13, "variable"},
    {NameKind::stage, 9, 3, "namespace"},
    {NameKind::system, 7, 5, "class"},
    {NameKind::shape, 22, 23, "struct"},
    {NameKind::function, 3, 12, "function"},
    {NameKind::value, 12, 14, "variable"},
    {NameKind::setting, 10, 7, "property"},
    {NameKind::word, 20, 22, "enumMember"},
    {NameKind::palette, 16, 22, "enumMember"},
    {NameKind::keyword, 14, 2, "keyword"},
}};
constexpr const KindNumbers& numbers_of(NameKind kind) {
    return kind_numbers[static_cast<std::size_t>(kind)];
}

}  // namespace cascade::lsp

// The words of the language, for the grammars of editors.
#pragma once

#include <string>

namespace cascade::lsp {

/// A JSON object of lists, made from the tables of the language. editors/make.py writes grammars
/// from it. A word may be in several lists, because its meaning depends on its position.
std::string language_words();

}  // namespace cascade::lsp

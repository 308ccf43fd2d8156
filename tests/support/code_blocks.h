// The fenced code blocks of a Markdown page.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// One block: ``` WORD, its lines, ```.
struct CodeBlock {
    std::string word;       ///< The word after the opening fence. May be empty.
    std::string body;       ///< Whole lines, each with its line end.
    std::size_t line = 1;   ///< The line of the opening fence.
    std::size_t begin = 0;  ///< Offset of the body in the page.
    std::size_t end = 0;    ///< Offset of the end of the body, where the closing fence begins.
};

/// All blocks of a page, in order. A block that is never closed ends with the page.
std::vector<CodeBlock> code_blocks(std::string_view page);

}  // namespace cascade

// See code_blocks.h.
#include "tests/support/code_blocks.h"

#include <algorithm>

namespace cascade {

std::vector<CodeBlock> code_blocks(std::string_view page) {
    std::vector<CodeBlock> blocks;
    bool inside = false;
    std::size_t line_number = 0;
    for (std::size_t offset = 0; offset < page.size();) {
        const std::size_t end = std::min(page.find('\n', offset), page.size() - 1) + 1;
        const std::string_view line = page.substr(offset, end - offset);
        ++line_number;
        if (line.starts_with("```")) {
            if (inside) {
                blocks.back().end = offset;
            } else {
                const std::string_view word = line.substr(3, line.find_last_not_of("\r\n ") - 2);
                blocks.push_back({std::string(word), "", line_number, end, end});
            }
            inside = !inside;
        } else if (inside) {
            blocks.back().body += line;
            blocks.back().end = end;
        }
        offset = end;
    }
    return blocks;
}

}  // namespace cascade

// Counts brackets and commas outside of strings in one pass, without parsing.
#include "core/json_size.h"

#include <algorithm>

namespace cascade {

JsonSize measure_json(std::string_view text) {
    JsonSize size;
    std::size_t depth = 0;
    bool is_in_text = false;
    for (std::size_t k = 0; k < text.size(); ++k) {
        const char c = text[k];
        if (c == '"') is_in_text = !is_in_text;
        if (is_in_text) {
            k += c == '\\' ? 1 : 0;
        } else if (c == '[' || c == '{') {
            size.depth = std::max(size.depth, ++depth);
            ++size.objects;
            ++size.values;
        } else if (c == ',') {
            ++size.values;
        } else if ((c == ']' || c == '}') && depth > 0) {
            --depth;
        }
    }
    return size;
}

bool is_small_json(std::string_view text) {
    const JsonSize size = measure_json(text);
    return size.depth <= 64 && size.values <= 200'000;
}

}  // namespace cascade

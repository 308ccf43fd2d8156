#include "surface/text_words.h"

#include <algorithm>

namespace cascade {

std::vector<std::string_view> words_of(std::string_view line) {
    constexpr std::string_view blank = " \t\r\v\f";
    std::vector<std::string_view> words;
    for (std::size_t at = line.find_first_not_of(blank); at != std::string_view::npos;
         at = line.find_first_not_of(blank, at)) {
        const std::size_t end = std::min(line.find_first_of(blank, at), line.size());
        words.push_back(line.substr(at, end - at));
        at = end;
    }
    return words;
}

}  // namespace cascade

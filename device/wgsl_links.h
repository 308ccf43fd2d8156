// The links of cells as the words of c_links (wgsl_prelude.h).
#pragma once

#include "core/grid.h"
#include "core/links.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace cascade {

/// The bytes of `count` numbers as words. If `values` is null, all words are 0.
template <typename T>
std::vector<std::uint32_t> packed_words(const T* values, std::size_t count) {
    std::vector<std::uint32_t> words((count * sizeof(T) + 3) / 4);
    if (values != nullptr && count > 0) std::memcpy(words.data(), values, count * sizeof(T));
    return words;
}

struct WgslLinks {
    std::vector<std::uint32_t> words;
    /// The places of all arrays except the first in c_links. A call has these places among its
    /// words.
    std::vector<std::uint32_t> places;

    WgslLinks(const LinkTable<float>& table, const PlaneLayout& layout);

private:
    template <typename T>
    void add(const T* values, std::size_t count);
};

}  // namespace cascade

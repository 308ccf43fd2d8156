// Hashes of words and texts.
#include "core/hash.h"

namespace cascade {

std::array<std::uint32_t, 4> pcg4d(std::array<std::uint32_t, 4> v) {
    for (std::uint32_t& word : v) word = word * 1664525u + 1013904223u;
    auto& [x, y, z, w] = v;
    const auto mix = [&] {
        x += y * w;
        y += z * x;
        z += x * y;
        w += y * z;
    };
    mix();
    for (std::uint32_t& word : v) word ^= word >> 16;
    mix();
    return v;
}

std::uint64_t fnv1a(std::string_view text, std::uint64_t seed) {
    std::uint64_t hash = seed;
    for (const char character : text) {
        hash ^= static_cast<unsigned char>(character);
        hash *= 0x100000001b3ULL;
    }
    return hash;
}

}  // namespace cascade

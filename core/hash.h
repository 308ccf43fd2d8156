// Hashes: the source of all randomness, and keys of caches. No state anywhere.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace cascade {

/// pcg4d of M. Jarzynski and M. Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020:
/// four 32-bit words to four well mixed ones. The cell kernels compute the same function
/// (ir/random_numbers.cpp); this one serves tests and keys.
std::array<std::uint32_t, 4> pcg4d(std::array<std::uint32_t, 4> v);

/// FNV-1a, 64 bits, of a text; `seed` chains several.
std::uint64_t fnv1a(std::string_view text, std::uint64_t seed = 0xcbf29ce484222325ULL);

}  // namespace cascade

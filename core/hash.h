// Stateless hashes for all random numbers and for cache keys.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace cascade {

/// pcg4d of M. Jarzynski and M. Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020: maps
/// four 32-bit words to four well-mixed ones. Cell kernels compute the same function
/// (ir/random_numbers.cpp). The function here serves tests and keys.
std::array<std::uint32_t, 4> pcg4d(std::array<std::uint32_t, 4> v);

/// 64-bit FNV-1a of a text. To hash several texts, pass the hash of one as the `seed` of the next.
std::uint64_t fnv1a(std::string_view text, std::uint64_t seed = 0xcbf29ce484222325ULL);

}  // namespace cascade

// Random choices of tests: a pure function of a seed.
#pragma once

#include <cstdint>
#include <span>

namespace cascade::test {

/// SplitMix64 (Steele, Lea and Flood, "Fast splittable pseudorandom number generators", 2014).
class RandomStream {
public:
    explicit RandomStream(std::uint64_t seed) : state_(seed) {}

    std::uint64_t next() {
        state_ += 0x9e3779b97f4a7c15ULL;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        return z ^ (z >> 31);
    }
    /// One of 0 … count − 1.
    std::uint32_t below(std::uint64_t count) { return static_cast<std::uint32_t>(next() % count); }
    bool chance(int percent) { return below(100) < static_cast<std::uint32_t>(percent); }
    /// In [−1, 1).
    float symmetric() { return static_cast<float>(next() >> 40) * 0x1p-23f - 1.0f; }

    template <typename T>
    const T& pick(std::span<const T> from) {
        return from[below(from.size())];
    }

private:
    std::uint64_t state_;
};

/// A word that is likely to cause trouble: zeros of both signs, denormals, infinities, NaN, numbers
/// at the ends of the range, small integers, ordinary numbers, or any word at all.
std::uint32_t hostile_word(RandomStream& stream);
/// A word of 64 bits that is likely to cause trouble.
std::uint64_t hostile_long_word(RandomStream& stream);

}  // namespace cascade::test

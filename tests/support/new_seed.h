// A new seed in every run of the tests, so that random tests try something new each time.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>

namespace cascade::test {

/// The number of the environment variable CASCADE_TEST_SEED, or else a new one. It is printed so
/// that a failure can be repeated. It is below 2³², so that callers may add other numbers.
inline std::uint64_t new_seed() {
    static const std::uint64_t seed = [] {
        const char* const given = std::getenv("CASCADE_TEST_SEED");
        const std::uint64_t value =
            given ? std::strtoull(given, nullptr, 10) : std::random_device{}();
        std::printf("CASCADE_TEST_SEED=%llu repeats the random part\n",
                    static_cast<unsigned long long>(value));
        std::fflush(stdout);
        return value;
    }();
    return seed;
}

}  // namespace cascade::test

// Finds the identity and features of the processor by instructions such as CPUID.
#include "jit/processor.h"

#include <fmt/format.h>

#include <fstream>
#include <set>
#include <sstream>
#if defined(__x86_64__)
#include <cpuid.h>
#endif

namespace cascade {

#if defined(__x86_64__)

int host_lanes() {
    // Like LLVM's checks, these also ensure that the operating system saves the vector registers.
    if (__builtin_cpu_supports("avx512f")) return 16;
    return __builtin_cpu_supports("avx") ? 8 : 4;
}

namespace {

/// The vector registers that the operating system saves when it switches threads, as bits; 0 if
/// unknown.
std::uint64_t kept_registers() {
    unsigned a = 0, b = 0, c = 0, d = 0;
    constexpr unsigned os_keeps_registers = 1u << 27;
    if (!__get_cpuid(1, &a, &b, &c, &d) || (c & os_keeps_registers) == 0) return 0;
    unsigned low = 0, high = 0;
    __asm__("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    return std::uint64_t{high} << 32 | low;
}

}  // namespace

std::string host_identity() {
    std::string identity;
    const auto add = [&](unsigned word) {
        identity.append(reinterpret_cast<const char*>(&word), sizeof word);
    };
    // The leaves of the instruction CPUID: maker, model, extended features (two leaves), states,
    // key locker, AVX10, and two leaves of AMD.
    constexpr unsigned leaves[][2] = {{0, 0},          {1, 0},         {7, 0},    {7, 1},
                                      {13, 1},         {0x14, 0},      {0x19, 0}, {0x24, 0},
                                      {0x80000001, 0}, {0x80000008, 0}};
    for (const auto& [leaf, part] : leaves) {
        unsigned a = 0, b = 0, c = 0, d = 0;
        __get_cpuid_count(leaf, part, &a, &b, &c, &d);
        // Contains the number of the core that executes CPUID.
        if (leaf == 1) b = 0;
        if (leaf == 13) b = 0;                  // Contains the current state.
        if (leaf == 0x80000008) a = c = d = 0;  // Widths of addresses, and the number of cores.
        for (const unsigned word : {a, b, c, d}) add(word);
    }
    const std::uint64_t registers = kept_registers();
    add(static_cast<unsigned>(registers));
    add(static_cast<unsigned>(registers >> 32));
    return identity;
}

#else

int host_lanes() { return 4; }

std::string host_identity() {
    std::ostringstream text;
    text << std::ifstream("/proc/cpuinfo").rdbuf();
    return kinds_of_cores(text.str());
}

#endif

std::string kinds_of_cores(const std::string& cpuinfo) {
    std::set<std::string> kinds;  // Only a few, because many cores are of the same kind.
    std::istringstream lines(cpuinfo);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("CPU ") || line.starts_with("Features")) kinds.insert(line);
    }
    return fmt::format("{}", fmt::join(kinds, "|"));
}

}  // namespace cascade

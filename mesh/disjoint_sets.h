// Union-find.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace cascade {

/// A partition of the numbers 0 … count − 1, of which each is at first a set of its own: R.
/// Tarjan's union-find with path halving. A set is represented by its smallest number, unless
/// put_under() has chosen another number.
class DisjointSets {
public:
    explicit DisjointSets(std::size_t count) : above_(count) {
        std::iota(above_.begin(), above_.end(), std::uint32_t{0});
    }
    std::uint32_t find(std::uint32_t a) {
        while (above_[a] != a) a = above_[a] = above_[above_[a]];
        return a;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        put_under(std::max(a, b), std::min(a, b));
    }
    /// Joins two sets, given by the numbers that represent them. The second number then represents
    /// the joined set.
    void put_under(std::uint32_t lower, std::uint32_t upper) { above_[lower] = upper; }

private:
    std::vector<std::uint32_t> above_;
};

}  // namespace cascade

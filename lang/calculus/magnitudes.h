// Bounds of what the parts of rates are, from bounds of what they read: which products are too
// small or too large for single precision, and what a rate loses by that.
#pragma once

#include "lang/program/program.h"

#include <functional>
#include <limits>
#include <vector>

namespace cascade {

/// Bounds of the magnitudes of a value in all cells.
struct Magnitude {
    double least = 0;
    double most = std::numeric_limits<double>::infinity();
    bool is_positive = false;  ///< No value is below 0.

    static Magnitude of(double value) { return {std::abs(value), std::abs(value), value >= 0}; }
};

/// A part of a rate whose value single precision cannot hold, although it holds its operands.
struct LostProduct {
    ItemId species;  ///< In whose rate it is.
    Span span;       ///< Of the part.
    Formula part;
    double value = 0;           ///< A bound of its magnitude.
    double lost = 0;            ///< What the rate loses, if it is too small and counts as 0.
    double rate = 0;            ///< A bound of the rate without what operators add.
    bool is_too_large = false;  ///< It may be; the bound may be reached in no cell.
};

/// The products, quotients and powers of the rates, given the magnitudes of the items that they
/// read. Of each rate the one by which it loses most, and one that may be too large.
std::vector<LostProduct> find_lost_products(const Program& program, std::uint32_t stage,
                                            const std::function<Magnitude(ItemId)>& magnitude_of);

}  // namespace cascade

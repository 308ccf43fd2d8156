// The opponent's fields: starts from the values of our side, steps by a function of straight_cpp.h.
#pragma once

#include "bench/cascade_side.h"
#include "bench/straight_cpp.h"
#include "core/plane.h"

#include <cstdint>
#include <string>
#include <vector>

namespace cascade::bench {

class StraightSide {
public:
    /// `varying` names the parameter that varies, or is empty.
    StraightSide(const CascadeSide& like, const std::string& varying);

    void advance(StraightStep step, std::int64_t count);

    std::span<const Field> species() const { return now_; }

private:
    StraightConstants constants_;
    std::vector<Field> now_, next_;
    Field varying_;
    Mask frozen_;
    Grid grid_;
};

}  // namespace cascade::bench

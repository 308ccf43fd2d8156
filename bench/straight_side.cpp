// The opponent's fields.
#include "bench/straight_side.h"

namespace cascade::bench {

StraightSide::StraightSide(const CascadeSide& like, const std::string& varying)
    : grid_(like.grid()) {
    for (const Field& field : like.start().species) {
        now_.push_back(field.clone());
        next_.emplace_back(field.layout());
        fill_halo(now_.back().origin(), field.layout(), grid_.boundary);
    }
    if (!varying.empty()) varying_ = like.parameter(varying).clone();
    if (!like.start().frozen.empty()) frozen_ = like.start().frozen.clone();
}

void StraightSide::advance(StraightStep step, std::int64_t count) {
    StraightFields fields{};
    fields.width = grid_.width;
    fields.height = grid_.height;
    fields.stride = now_.front().layout().stride;
    fields.varying = varying_.empty() ? nullptr : varying_.origin();
    fields.frozen = frozen_.empty() ? nullptr : frozen_.origin();
    for (std::int64_t taken = 0; taken < count; ++taken) {
        for (std::size_t k = 0; k < now_.size(); ++k) {
            fields.now[k] = now_[k].origin();
            fields.next[k] = next_[k].origin();
        }
        step(fields, constants_);
        now_.swap(next_);
    }
}

}  // namespace cascade::bench

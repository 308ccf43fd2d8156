// The fields of straight C++.
#include "bench/straight_side.h"

namespace cascade::bench {

StraightSide::StraightSide(const CascadeSide& like, const std::string& varying)
    : grid_(like.grid()), layout_(grid_) {
    for (const Field& field : like.start().species()) {
        now_.emplace_back(field.plane());
        next_.emplace_back(field.plane());
        fill_halo(now_.back().origin(), layout_, grid_.boundary);
    }
    scratch_ = StraightPlane<float>(like.start().species()[0].plane());
    if (!varying.empty()) varying_ = StraightPlane<float>(like.parameter(varying).plane());
    if (!like.start().frozen().empty()) {
        frozen_ = StraightPlane<std::uint8_t>(like.start().frozen());
    }
}

std::vector<Field> StraightSide::species() const {
    std::vector<Field> copies;
    for (const StraightPlane<float>& plane : now_) {
        Field& copy = copies.emplace_back(layout_);
        for (std::int64_t row = 0; row < layout_.row_count(); ++row) {
            std::memcpy(copy.row(row), plane.origin() + layout_.row_start(row),
                        static_cast<std::size_t>(layout_.width) * sizeof(float));
        }
    }
    return copies;
}

void StraightSide::advance(StraightStep step, std::int64_t count) {
    StraightFields fields{};
    fields.width = grid_.width;
    fields.height = grid_.height;
    fields.depth = grid_.depth;
    fields.stride = layout_.stride;
    fields.slice_stride = layout_.slice_stride;
    fields.varying = varying_.empty() ? nullptr : varying_.origin();
    fields.frozen = frozen_.empty() ? nullptr : frozen_.origin();
    fields.scratch = scratch_.origin();
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

// Allocates every plane of every stage on a tiny grid.
#include "run/emit_c/placeholders.h"

namespace cascade {

Placeholders::Placeholders(const Program& program, std::uint32_t last) {
    const PlaneLayout layout(grid_);
    for (std::uint32_t k = 0; k <= last; ++k) {
        StageState& state = states_.emplace_back(empty_state(program.system_of(k)));
        for (Field& field : state.fields) field = Field(layout);
        for (Field& field : state.species) field = Field(layout);
        state.frozen = Mask(layout);
    }
    for (const TextId text : program.literals->text_ids()) {
        for (std::uint32_t k = 0; k < program.literals->reading_count(); ++k) {
            files_.add({Function::field, text, k}, Field(layout));
            files_.add({Function::image, text, k}, Field(layout));
        }
    }
    for (std::size_t k = 0; k < metric_plane_count; ++k) metric_.emplace_back(layout);
}

}  // namespace cascade

// Steps change planes in place. So a plane that another owner keeps is copied when it is put back.
#include "solvers/step_planes.h"

#include "core/check.h"
#include "core/shared_plane.h"

namespace cascade {

StepPlanes::StepPlanes(const PlaneLayout& layout, Precision precision, std::vector<Field> species,
                       bool keeps)
    : layout_(layout), precision_(precision), species_(species.size()) {
    put(0, std::move(species));
    for (std::size_t s = 0; s < species_; ++s) {
        copies_[1].emplace_back(layout_, precision_);
        if (keeps) copies_[2].emplace_back(layout_, precision_);
    }
}

void StepPlanes::put(int number, std::vector<Field> species) {
    CHECK(species.size() == species_, "all species come back");
    for (Field& field : species) {
        check(field);
        if (is_shared(field)) field = field.clone();
    }
    copy(number) = std::move(species);
}

void StepPlanes::make_registers(std::uint32_t count) {
    while (scratch_.size() + first_scratch_register.index() < count) {
        std::vector<Field>& planes = scratch_.emplace_back();
        for (std::size_t s = 0; s < species_; ++s) planes.emplace_back(layout_, precision_);
    }
}

void StepPlanes::exchange(RegisterId one, RegisterId other) {
    const std::uint32_t first = first_scratch_register.index();
    std::swap(scratch_[one.index() - first], scratch_[other.index() - first]);
}

void StepPlanes::list(CopyRoles roles, std::vector<std::span<Field>>& registers) {
    registers.clear();
    registers.emplace_back(copies_[static_cast<std::size_t>(roles.current)]);
    registers.emplace_back(copies_[static_cast<std::size_t>(roles.target())]);
    for (std::vector<Field>& planes : scratch_) registers.emplace_back(planes);
}

void StepPlanes::check(const Field& field) const {
    CHECK(field.layout() == layout_ && field.precision() == precision_,
          "species lie as the grid says, in the precision of their problem");
}

}  // namespace cascade

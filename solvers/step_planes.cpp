// Makes the copies and the scratch registers of steps.
#include "solvers/step_planes.h"

#include "core/check.h"

#include <utility>

namespace cascade {

StepPlanes::StepPlanes(const PlaneLayout& layout, Precision precision, std::vector<Field> species,
                       bool keeps)
    : layout_(layout), precision_(precision), species_(species.size()) {
    copies_[0] = std::move(species);
    for (const Field& field : copies_[0]) {
        CHECK(field.layout() == layout_ && field.precision() == precision_,
              "species lie as the grid says, in the precision of their problem");
        copies_[1].emplace_back(layout_, precision_);
        if (keeps) copies_[2].emplace_back(layout_, precision_);
    }
    if (!keeps) roles_.kept = CopyRoles::none;
    for (std::size_t copy = 0; copy < copies_.size(); ++copy) {
        for (Field& field : copies_[copy]) cells_[copy].push_back(field.address());
    }
}

void StepPlanes::back() {
    CHECK(keeps(), "there is a copy to go back to");
    if (roles_.current != roles_.kept) roles_.last = std::exchange(roles_.current, roles_.kept);
}

void StepPlanes::lend(std::vector<Field>& to) {
    to = std::move(copies_[static_cast<std::size_t>(roles_.current)]);
}

void StepPlanes::take_back(std::vector<Field>& from) {
    const auto current = static_cast<std::size_t>(roles_.current);
    copies_[current] = std::move(from);
    CHECK(copies_[current].size() == species_, "all species come back");
    for (std::size_t s = 0; s < species_; ++s) {
        CHECK(copies_[current][s].address() == cells_[current][s], "the same planes come back");
    }
}

void StepPlanes::make_registers(std::uint32_t count) {
    while (scratch_.size() + first_scratch < count) {
        std::vector<Field>& planes = scratch_.emplace_back();
        std::vector<void*>& cells = scratch_cells_.emplace_back();
        for (std::size_t s = 0; s < species_; ++s) {
            cells.push_back(planes.emplace_back(layout_, precision_).address());
        }
    }
}

void StepPlanes::exchange(std::uint32_t one, std::uint32_t other) {
    std::swap(scratch_[one - first_scratch], scratch_[other - first_scratch]);
    std::swap(scratch_cells_[one - first_scratch], scratch_cells_[other - first_scratch]);
}

void StepPlanes::list(CopyRoles roles, std::vector<std::span<void* const>>& registers) const {
    registers.clear();
    registers.emplace_back(cells_[static_cast<std::size_t>(roles.current)]);
    registers.emplace_back(cells_[static_cast<std::size_t>(roles.target())]);
    for (const std::vector<void*>& cells : scratch_cells_) registers.emplace_back(cells);
}

}  // namespace cascade

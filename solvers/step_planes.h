// The planes of steps in the memory of this process.
#pragma once

#include "core/plane.h"
#include "solvers/executor.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace cascade {

/// The planes that steps read and write: two or three copies of every species, and scratch
/// registers.
class StepPlanes {
public:
    /// The first copy is `species`. There are three copies if `keeps` is true, else two.
    StepPlanes(const PlaneLayout& layout, Precision precision, std::vector<Field> species,
               bool keeps);

    const PlaneLayout& layout() const { return layout_; }
    std::vector<Field>& copy(int number) { return copies_[static_cast<std::size_t>(number)]; }
    /// Gives copy `number` to the caller. Fields of the same layout must be put back before the
    /// next step.
    std::vector<Field> take(int number) { return std::move(copy(number)); }
    /// Puts fields back as a copy. Shared fields are copied first, because steps change planes in
    /// place.
    void put(int number, std::vector<Field> species);

    /// Makes planes for `count` registers, including the registers of the old and the new step.
    void make_registers(std::uint32_t count);
    /// The planes of a scratch register.
    const std::vector<Field>& scratch(RegisterId id) const {
        return scratch_[id.index() - first_scratch_register.index()];
    }
    /// Swaps two scratch registers.
    void exchange(RegisterId one, RegisterId other);

    /// Lists the planes of all registers of a step: the old step, the new one, then scratch.
    void list(CopyRoles roles, std::vector<std::span<Field>>& registers);

private:
    void check(const Field& field) const;

    PlaneLayout layout_;
    Precision precision_;
    std::size_t species_;
    std::array<std::vector<Field>, 3> copies_;  ///< The last one may be empty.
    std::vector<std::vector<Field>> scratch_;
};

}  // namespace cascade

// The planes that steps read and write: two or three copies of every species, and scratch.
//
// Two copies are swapped after each step. The third, if there is memory for it, is the kept one:
// keep() declares the current copy the kept one without moving a byte, and steps go on between the
// other two, so that back() can return to it. Keeping is therefore free.
#pragma once

#include "core/plane.h"
#include "solvers/pass_runner.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace cascade {

/// The roles of the copies.
struct CopyRoles {
    static constexpr int none = -1;
    int kept = 0;  ///< `none` if there are two copies.
    int current = 0;
    int last = 1;  ///< The copy that was current before; it is likely to be in the cache.

    /// The copy that the next step writes: neither kept nor current.
    int target() const { return kept == none || kept == current ? last : 3 - kept - current; }
    /// Called when a step is complete.
    void go_on() { last = std::exchange(current, target()); }
};

class StepPlanes {
public:
    /// Takes `species` as the current copy, and also as the kept one unless `keeps` is false.
    StepPlanes(const PlaneLayout& layout, Precision precision, std::vector<Field> species,
               bool keeps);

    const PlaneLayout& layout() const { return layout_; }
    CopyRoles roles() const { return roles_; }
    /// Swaps the copies after a step, or to undo it.
    void set_roles(CopyRoles roles) { roles_ = roles; }

    /// Is there a kept copy? Without one keep() does nothing, and back() must not be called.
    bool keeps() const { return roles_.kept != CopyRoles::none; }
    void keep() {
        if (keeps()) roles_.kept = roles_.current;
    }
    void back();

    const std::vector<Field>& current() const { return copy(roles_.current); }
    /// Lends the current copy to the caller's vector; fields of the same kind must come back before
    /// the next step.
    void lend(std::vector<Field>& to);
    void take_back(std::vector<Field>& from);
    const std::vector<Field>& copy(int number) const {
        return copies_[static_cast<std::size_t>(number)];
    }

    /// Makes planes for this number of registers, the old and the new step included.
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
    std::array<std::vector<Field>, 3> copies_;  ///< The last is empty where nothing is kept.
    std::vector<std::vector<Field>> scratch_;
    CopyRoles roles_;
};

/// Lends the current species to the caller's vector while it exists.
class SpeciesLoan {
public:
    SpeciesLoan(StepPlanes& planes, std::vector<Field>& to) : planes_(planes), to_(to) {
        planes_.lend(to_);
    }
    ~SpeciesLoan() { planes_.take_back(to_); }
    SpeciesLoan(const SpeciesLoan&) = delete;
    SpeciesLoan& operator=(const SpeciesLoan&) = delete;

private:
    StepPlanes& planes_;
    std::vector<Field>& to_;
};

}  // namespace cascade

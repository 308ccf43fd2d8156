// Decides how many passes parts of a grid compute between two exchanges of halos, and which halos
// these passes need.
//
// A pass reads the layers beside a cell. So a part that is to compute L passes by itself first gets
// a halo of L layers. The first pass computes the part's own layers and L − 1 layers of the halo on
// both sides, the next pass L − 2, and the last pass only the part's own layers. Both neighbours
// compute the layers around their border, from the same values with the same kernels, so their bits
// are equal. On a periodic axis the layers beyond the grid are copies of layers at its other end. A
// part computes these copies with the row numbers of the other end, but in the memory of the halo.
#pragma once

#include "solvers/exchange.h"
#include "solvers/step_problem.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <variant>
#include <vector>

namespace cascade {

/// Parts are at least this many times as thick as their halos. Computing the layers that both
/// neighbours compute then takes at most an eighth of the time for a part's own layers.
inline constexpr std::int64_t least_thickness = 8;

/// The largest number of passes that parts of these rows compute between two exchanges, at most 16.
/// Does not depend on the machine, because all parts need the same number. It is 1
/// - if a pass needs whole planes (constraints, convolutions, filters of waves), or every pass
///   needs an aggregate,
/// - on a periodic axis, if one plane wraps and another does not, or if sides change with time,
/// - if there is only one part, or parts are thinner than `thickness` times a halo of two layers.
int levels_of_halo(const StepProblem& problem, std::span<const RowRange> parts,
                   std::int64_t thickness = least_thickness);

/// Whether all planes that are read at neighbours are periodic along the axis that is divided among
/// parts.
bool wraps_between_parts(const StepProblem& problem);

/// Fills the halos of whole species that are periodic along the axis that is divided among parts:
/// the layers before and after the rows or slices of the grid. Parts leave these halos unfilled
/// after the last pass.
void fill_across(const StepProblem& problem, std::span<Field> species);

/// Collects the planes whose halos must be filled before several levels run: the planes that a
/// level reads before any level writes them.
class HaloReads {
public:
    /// `levels` is the number of levels that will be added.
    HaloReads(const StepProblem& problem, std::int64_t levels) : problem_(problem), left_(levels) {}

    /// Adds a pass as the next level. `plane_of` gives the memory of a plane.
    template <typename PlaneOf>
    void add(std::size_t pass, const PlaneOf& plane_of) {
        --left_;
        const StepProblem::Pass& of = problem_.get().passes[pass];
        for (const StepProblem::PlaneRef& ref : of.fields) {
            if (std::holds_alternative<const Field*>(ref)) continue;
            add(plane_of(ref), left_ + (is_read_at_neighbours(ref) ? 1 : 0));
        }
        for (const StepProblem::Result& result : of.results) {
            written_.push_back(plane_of(result.plane));
        }
    }

    /// The planes, each once.
    const std::vector<Field*>& planes() const { return planes_; }
    /// The width of the widest halo that a level reads, in units of the layers that one pass
    /// reaches.
    std::int64_t width() const { return width_; }

private:
    void add(Field* plane, std::int64_t width);
    bool is_read_at_neighbours(const StepProblem::PlaneRef& ref) const;

    std::reference_wrapper<const StepProblem> problem_;
    std::int64_t left_, width_ = 0;
    std::vector<Field*> planes_, written_;
};

}  // namespace cascade

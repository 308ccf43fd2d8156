// The equations of a steady state of a stage: all rates are 0 in all cells.
//
// The unknowns are the values of the species in the cells of the grid. The unknown of species s in
// cell k has the number k · species + s.
#pragma once

#include "continuation/field_expressions.h"
#include "continuation/padded_grid.h"
#include "core/result.h"
#include "lang/program/program.h"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace cascade::continuation {

/// The rates at a state, and their derivatives.
struct Linearised {
    Vector rates;
    SparseColumns jacobian;  ///< By the unknowns.
    Vector by_parameter;
};

/// Checks whether a stage can have steady states that this room can compute. Fails with the reason,
/// the rest of a sentence that begins with the stage. Fails before anything is run.
Result<void> check_steady(const Program& program, std::uint32_t stage);

class SteadyProblem {
public:
    /// `varied` is a parameter that is the same in all cells. Parameters that depend on it follow
    /// it. Fails like check_steady(), and if an expression is not supported. The program must
    /// outlive the problem.
    static Result<SteadyProblem> create(const Program& program, std::uint32_t stage, ItemId varied,
                                        const ConstantValues& constants);

    Index size() const { return cell_count() * species_count(); }
    Index cell_count() const { return grid_->cell_count(); }
    Index species_count() const { return static_cast<Index>(species_.size()); }

    Vector rates(const Vector& state, double parameter);
    Linearised linearised(const Vector& state, double parameter);

    /// The totals that no rate changes, one in each column: weights of the unknowns. They are
    /// totals of species and of sums of species. Looks at another state near the given one, at
    /// which no rate has an accidental slope of 0.
    Matrix conserved_near(const Vector& state, double parameter);
    /// The derivatives of a state along the axes along which a steady state can be moved: those
    /// that are periodic, if no rate depends on the position.
    std::vector<Vector> translations(const Vector& state) const;
    /// Changes of the species that `like` changes most, symmetric about the first cell. For each
    /// axis one changes all cells at position 0. The last one changes only the first cell.
    std::vector<Vector> even_shapes(const Vector& like) const;

private:
    SteadyProblem() = default;

    /// A species with its values beyond sides.
    struct Species {
        ItemId item;
        SparseRows inside;  ///< From the unknowns to the padded grid.
        /// For each side with a value: the number of the root in `sides_`, and its effect on the
        /// halo.
        std::vector<std::pair<std::size_t, SparseRows>> by_side;
    };
    void prepare_sides(lowering::Expressions& sides, const Program& program, std::uint32_t stage,
                       Flattening& flattening);
    void extend(Species& species, Index number, const lowering::SideKinds& kinds,
                const std::map<int, std::size_t>& values);
    void find_free_axes();
    Vector assembled(const std::vector<Part>& roots) const;
    ItemParts parts_at(const Vector& state, double parameter, bool with_slopes);

    std::shared_ptr<const PaddedGrid> grid_;
    ItemId varied_;
    std::vector<Species> species_;
    std::array<bool, 3> is_periodic_{true, true, true};
    std::vector<int> free_axes_;  ///< The axes along which states can be moved.
    std::shared_ptr<FieldExpressions> rates_, sides_;
};

}  // namespace cascade::continuation

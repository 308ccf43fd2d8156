// Our side of the benchmarks: a Cascade text, parsed, checked, lowered, compiled and stepped.
#pragma once

#include "core/grid.h"
#include "ir/backend.h"
#include "lang/lower/lower.h"
#include "run/domain/input_files.h"
#include "run/script/script.h"
#include "run/simulation/simulation.h"
#include "solvers/stepper.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cascade::bench {

/// The texts that are measured, for a grid of squares or cubes.
std::string turing_text(const GridSize& grid);  ///< beta and frozen vary over the cells.
std::string gray_scott_text(const GridSize& grid);
std::string stripes_text(const GridSize& grid);        ///< ai varies.
std::string cahn_hilliard_text(const GridSize& grid);  ///< Two passes a step.
std::string chemotaxis_text(const GridSize& grid);     ///< Fluxes at faces.
std::string tensor_text(const GridSize& grid);         ///< Diffusion with a direction, flux form.
std::string allen_cahn_text(const GridSize& grid);  ///< One species: what least can be done a cell.
std::string rock_scissors_paper_text(const GridSize& grid);  ///< Three species.
std::string perona_malik_text(
    const GridSize& grid);  ///< An exponential a cell, fluxes, two passes.

/// Every operation by itself, or as with `--fast`.
enum class Rounding { strict, fast };

/// The first stage of a text, ready to step on one thread with kernels of `backend`. Ends the
/// program with a message where something fails: a benchmark has no user to talk to.
class CascadeSide {
public:
    CascadeSide(const std::string& text, Backend& backend, Rounding rounding = Rounding::strict);

    /// Takes steps and looks at them as a run does: once for all `count` (64 in a run).
    void advance(std::int64_t count);

    /// Another stepper at the starting values. Needs this object alive.
    Stepper fresh_stepper() const;

    std::span<const Field> species() { return stepper_->species(); }
    const StageState& start() const { return simulation_->state(0); }
    const Grid& grid() const { return simulation_->domain().grid; }
    /// A parameter that varies, by name.
    const Field& parameter(const std::string& name) const;

private:
    std::vector<Field> start_species() const;

    Script script_;
    std::unique_ptr<Simulation> simulation_;
    InputFiles files_;
    StepProblem problem_;
    std::optional<Stepper> stepper_;
    std::int64_t steps_ = 0;
};

std::int64_t cell_count(const GridSize& grid);

/// As a run takes them: 64, but fewer where they would take more than half a second, and then as
/// many as a tile has.
std::int64_t steps_between_looks(const GridSize& grid);

/// Between cells of two states of a grid, over all species; infinite where one is not a number.
double largest_difference(std::span<const Field> a, std::span<const Field> b);

}  // namespace cascade::bench

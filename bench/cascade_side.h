// Cascade's side of the benchmarks: a script that is parsed, checked, lowered, compiled and
// stepped.
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

/// The scripts that are measured, on a grid of squares or cubes.
std::string turing_text(const GridSize& grid);  ///< beta and frozen vary by cell.
std::string gray_scott_text(const GridSize& grid);
std::string stripes_text(const GridSize& grid);        ///< ai varies by cell.
std::string cahn_hilliard_text(const GridSize& grid);  ///< Two passes per step.
std::string chemotaxis_text(const GridSize& grid);     ///< Fluxes at faces.
/// Diffusion with a direction, in flux form.
std::string tensor_text(const GridSize& grid);
std::string allen_cahn_text(const GridSize& grid);  ///< One species: the least work per cell.
std::string rock_scissors_paper_text(const GridSize& grid);  ///< Three species.
std::string perona_malik_text(
    const GridSize& grid);  ///< An exponential per cell, fluxes, two passes.

/// Whether every operation is rounded by itself, or some are fused as with `--fast`.
enum class Rounding { strict, fast };

/// The first stage of a script, ready to step on one thread with kernels of `backend`. If something
/// fails, ends the program with a message, because a benchmark has no user who could correct it.
class CascadeSide {
public:
    CascadeSide(const std::string& text, Backend& backend, Rounding rounding = Rounding::strict);

    /// Takes `count` steps and checks their values once at the end, as a run does after every 64
    /// steps.
    void advance(std::int64_t count);

    /// Another stepper, at the starting values. This object must outlive the stepper.
    Stepper fresh_stepper() const;

    std::span<const Field> species() { return stepper_->species(); }
    const StageState& start() const { return simulation_->state(0); }
    const Grid& grid() const { return simulation_->domain().grid; }
    /// The field of a parameter that varies by cell.
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

/// The number of steps between two checks in a run: 64, or the steps of one tile if 64 steps would
/// take more than half a second.
std::int64_t steps_between_looks(const GridSize& grid);

/// The largest difference between the cells of two states of a grid, over all species. Infinite if
/// a value is NaN.
double largest_difference(std::span<const Field> a, std::span<const Field> b);

}  // namespace cascade::bench

// Whole states are restricted by core/resample, or divided as for finer cells (finer_state.h).
#include "run/simulation/coarser_grid.h"

#include "core/resample.h"
#include "lang/program/scaled_lengths.h"
#include "run/domain/field_values.h"
#include "run/simulation/finer_state.h"
#include "run/simulation/regridded_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace cascade {

namespace {

/// The cells beside a side of an axis as a grid of their own, in the same order.
Grid face_of(const Grid& grid, std::size_t axis) {
    return {axis == 0 ? grid.height : grid.width, axis == 2 ? grid.height : grid.depth};
}

/// Values of a side on a coarser grid: means along the side.
std::shared_ptr<const SideValues> restricted(const SideValues& fine, const Grid& fine_grid,
                                             const Grid& coarse_grid, std::size_t axis) {
    const Grid face = face_of(fine_grid, axis), coarse_face = face_of(coarse_grid, axis);
    Plane<double> numbers{PlaneLayout(face)};
    for (std::int64_t j = 0; j < face.height; ++j) {
        std::copy_n(fine.numbers.begin() + j * face.width, face.width, numbers.row(j));
    }
    const Plane<double> means = restricted(numbers, face, coarse_face);
    SideValues coarse;
    for (std::int64_t j = 0; j < coarse_face.height; ++j) {
        coarse.numbers.insert(coarse.numbers.end(), means.row(j), means.row(j) + coarse_face.width);
    }
    return std::make_shared<const SideValues>(std::move(coarse));
}

StageState restricted(const StageState& fine, const Grid& fine_grid, const Grid& coarse_grid) {
    StageState result = regridded(
        fine, {coarse_grid.spacing,
               [&](const Field& plane) { return restricted_field(plane, fine_grid, coarse_grid); },
               [&](const SideValues& values, std::size_t side) {
                   return restricted(values, fine_grid, coarse_grid, side / 2);
               }});
    if (!fine.frozen.empty()) {
        Field& flags = result.fields[frozen_item(result)];
        flags = restricted_flags(fine.frozen, fine_grid, coarse_grid, flags.precision());
        result.frozen = to_mask(flags);
    }
    return result;
}

}  // namespace

Program coarser_program(const Script& script, const Program& fine, std::int64_t times) {
    Program result = script.coarser(fine.domain.coarse * times);
    for (std::uint32_t k = 0; k < result.stages.size(); ++k) {
        const auto& size = fine.stages[k].size;
        if (size && size->factor != 1) result = with_lengths(result, k, size->factor);
    }
    return result;
}

Program program_of_stage(const Script& script, const Program& program, std::uint32_t stage) {
    const std::int64_t times = program.stages[stage].coarse;
    return times == 1 ? program : coarser_program(script, program, times);
}

Field restricted_field(const Field& fine, const Grid& from, const Grid& to) {
    return fine.visit([&](const auto& plane) { return Field(restricted(plane, from, to)); });
}

Field restricted_flags(const Mask& fine, const Grid& from, const Grid& to, Precision precision) {
    Field shares = restricted_field(to_field(fine, precision), from, to);
    shares.visit([]<typename Number>(Plane<Number>& plane) {
        for (std::int64_t row = 0; row < plane.layout().row_count(); ++row) {
            for (std::int64_t i = 0; i < plane.layout().width; ++i) {
                Number& share = plane.row(row)[i];
                share = static_cast<Number>(share >= Number(0.5) ? 1 : 0);
            }
        }
    });
    return shares;
}

std::unique_ptr<Environment> on_coarser_grid(const Environment& fine, std::int64_t times,
                                             TimeAccount* account) {
    auto made = std::make_unique<Environment>();
    Environment& here = *made;
    here.script = fine.script;
    here.own_program = coarser_program(*fine.script, *fine.program, times);
    here.program = &*here.own_program;
    here.progress_note = fmt::format(", cells {} times as wide", here.program->domain.coarse);
    here.grid = here.program->domain.grid;
    here.threads = fine.threads;
    here.tiling = fine.tiling;
    here.plans = std::make_unique<StagePlans>(*here.program, fine.plans->options());
    here.kernels = std::make_unique<KernelMaker>(here.grid, fine.kernels->stepper(),
                                                 fine.kernels->starts_interpreted(), account);
    here.team = std::make_unique<Team>(here.kernels->is_small() ? 1 : here.threads);
    here.account = account;
    here.files = fine.files.mapped(
        [&](const Field& plane) { return restricted_field(plane, fine.grid, here.grid); });
    return made;
}

StageState on_grid(const StageState& state, const Grid& from, const Grid& to) {
    const std::int64_t before = from.longest_side(), now = to.longest_side();
    if (before == now) return StageState(state);
    if (before > now) return restricted(state, from, to);
    const std::int64_t times = now / before;
    return finer_state(state, *carrier_on_grid(from, times, nullptr, nullptr), from, to, times);
}

std::string note_of_cells(const Program& program) {
    if (program.domain.coarse == 1) return "";
    return fmt::format(" (on the grid with cells {} times as wide)", program.domain.coarse);
}

}  // namespace cascade

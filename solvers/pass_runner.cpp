// Computes rows in bands that fit into a cache, and fills the halo of a band while the band is
// cached.
#include "solvers/pass_runner.h"

#include "core/check.h"
#include "core/floating_point.h"
#include "core/overloaded.h"
#include "ir/draw_of_step.h"
#include "solvers/constraint_solver.h"
#include "solvers/layers_in_memory.h"
#include "solvers/tiling.h"

#include <algorithm>

namespace cascade {
namespace {

/// The number of rows in a band. The halo columns beside the rows of a band are filled as soon as
/// the band has been written, while its rows are still in the cache.
template <typename Number>
std::int64_t rows_of_a_band(const PlaneLayout& layout, std::size_t results) {
    // The number of values that fit into a quarter of a MiB.
    constexpr auto elements_in_cache = static_cast<std::int64_t>(262144 / sizeof(Number));
    return std::max<std::int64_t>(8, elements_in_cache /
                                         (layout.stride * static_cast<std::int64_t>(results)));
}

}  // namespace

std::optional<HaloColumns> PassRunner::copied_columns(const SideRules& sides, std::int64_t width) {
    const auto wraps = [&](Side side) { return sides[side].kind == SideKind::periodic; };
    if (sides[Side::left].has_value() || sides[Side::right].has_value()) return std::nullopt;
    return HaloColumns{wraps(Side::left) ? width - 1 : 0, wraps(Side::right) ? 0 : width - 1};
}

void PassRunner::prepare(Worker& worker, int number, int count) const {
    worker.number = number;
    worker.count = count;
    const RowRange own = split_rows(rows_.count(), number, count);
    worker.rows = {rows_.begin + own.begin, rows_.begin + own.end};
    worker.cells = others_ != nullptr ? Patch{worker.rows} : share_of(problem_.grid, number, count);
    with_number(problem_.precision, [&](auto zero) {
        using Number = decltype(zero);
        auto& arguments = worker.arguments.emplace<Arguments<Number>>();
        arguments.aggregates.assign(problem_.aggregates, Number{0});
        for (const StepProblem::Pass& pass : problem_.passes) {
            std::vector<Number>& of_pass = arguments.uniforms.emplace_back();
            for (const double value : pass.uniforms) of_pass.push_back(static_cast<Number>(value));
        }
    });
}

const Field& PassRunner::read(const StepProblem::PlaneRef& ref, Registers registers) const {
    if (const auto* const fixed = std::get_if<const Field*>(&ref)) return **fixed;
    if (const auto* const temporary = std::get_if<TemporaryId>(&ref)) {
        return temporaries_[*temporary];
    }
    const auto own = std::get<StepProblem::SpeciesPlane>(ref);
    return registers[own.in_register.index()][own.species.index()];
}

Field& PassRunner::written(const StepProblem::PlaneRef& ref, Registers registers) {
    CHECK(!std::holds_alternative<const Field*>(ref), "no pass writes a fixed plane");
    if (const auto* const temporary = std::get_if<TemporaryId>(&ref)) {
        return temporaries_[*temporary];
    }
    const auto own = std::get<StepProblem::SpeciesPlane>(ref);
    return registers[own.in_register.index()][own.species.index()];
}

void PassRunner::run(Worker& worker, Team& team, Registers registers, const StepMoment& moment) {
    for (std::size_t pass = 0; pass < problem_.passes.size(); ++pass) {
        if (pass > 0) team.barrier();
        prepare_pass(worker, team, pass, registers, moment);
        bind(worker, 0, pass, registers, moment, {});
        run_cells(worker, 0, {worker.rows});
    }
}

template <typename Number>
void PassRunner::set_uniforms(std::vector<Number>& uniforms, const StepProblem::Pass& pass,
                              const StepMoment& moment) const {
    for (const StepProblem::ChangingUniform& uniform : pass.changing) {
        Number& value = uniforms[uniform.slot.index()];
        const Overloaded set{
            [&](StepProblem::CompleteSteps) { value = static_cast<Number>(moment.complete); },
            [&](StepProblem::StepDraw) { value = draw_uniform<Number>(moment.complete); },
            [&](StepProblem::MomentAt at) {
                value = static_cast<Number>(moment.t + at.part * moment.length);
            },
            [&](Sweep::Coefficient by) {
                value = static_cast<Number>(by.times_step ? by.value * moment.length : by.value);
            },
            [](AggregateId) {},  // The reduction has already set this uniform.
        };
        std::visit(set, uniform.value);
    }
}

void PassRunner::bind(Worker& worker, std::size_t level, std::size_t pass, Registers registers,
                      const StepMoment& moment, const LevelOptions& options) {
    std::visit(
        [&](auto& arguments) { bind_as(arguments, level, pass, registers, moment, options); },
        worker.arguments);
}

template <typename Number>
void PassRunner::bind_as(Arguments<Number>& arguments, std::size_t number, std::size_t pass,
                         Registers registers, const StepMoment& moment,
                         const LevelOptions& options) {
    const auto bind = [&](std::vector<Level<Number>>& levels, int beyond) {
        if (levels.size() <= number) levels.resize(number + 1);
        bind_level(levels[number], arguments, pass, registers, moment, options, beyond);
    };
    bind(arguments.levels, 0);
    if (layout_.rows.begin < 0) bind(arguments.before, -1);
    if (layout_.rows.end > layout_.row_count()) bind(arguments.after, 1);
}

RowRange PassRunner::rows_with(std::int64_t followers) const {
    if (others_ == nullptr) return rows_;
    return with_neighbours(problem_.grid, rows_, followers * reach_, wraps_);
}

/// Rows before a periodic grid have the numbers of its last rows, but their values lie in the halo
/// before its first row.
template <typename Number>
void PassRunner::bind_level(Level<Number>& level, Arguments<Number>& arguments,
                            std::size_t pass_number, Registers registers, const StepMoment& moment,
                            const LevelOptions& options, int beyond) {
    const StepProblem::Pass& pass = problem_.passes[pass_number];
    level.pass = pass_number;
    level.moment = moment;
    level.rows = rows_with(options.followers);
    level.when_written = options.when_written;
    level.uniforms = arguments.uniforms[pass_number];
    set_uniforms(level.uniforms, pass, moment);
    PlaneLayout layout = layout_;
    if (beyond != 0) {
        const std::int64_t all = layout_.row_count();
        layout = PlaneLayout(problem_.grid, {layout_.rows.begin - beyond * all,  //
                                             layout_.rows.end - beyond * all});
    }
    const std::int64_t shift = beyond * layout_.row_start(layout_.row_count());
    level.fields.clear();
    for (const StepProblem::PlaneRef& ref : pass.fields) {
        const bool is_whole = std::holds_alternative<const Field*>(ref);
        level.fields.push_back(read(ref, registers).template origin<Number>() +
                               (is_whole ? 0 : shift));
    }
    level.masks.clear();
    for (const Mask* const mask : pass.masks) level.masks.push_back(mask->origin());
    level.results.clear();
    level.written.clear();
    for (const StepProblem::Result& result : pass.results) {
        Field& plane = written(result.plane, registers);
        level.results.push_back(plane.template origin<Number>() + shift);
        level.written.push_back(&plane);
    }
    const LinkTable<Number> links =
        problem_.links ? problem_.links->template table<Number>() : LinkTable<Number>{};
    level.given = {level.fields, level.masks, level.uniforms,  level.results,
                   layout,       links,       options.is_near, sides_[pass_number].copied};
}

void PassRunner::run_cells(Worker& worker, std::size_t level, const Patch& cells) const {
    std::visit(
        [&](const auto& arguments) {
            const auto& within = arguments.levels[level];
            if (others_ == nullptr) return run_level(within, cells);
            const RowRange rows = common(cells.rows, within.rows);
            const std::int64_t all = layout_.row_count();
            const auto run = [&](const auto& bound, RowRange part, std::int64_t shift) {
                if (part.empty()) return;
                run_level(bound, {{part.begin + shift, part.end + shift}, cells.columns});
            };
            run(within, common(rows, {0, all}), 0);
            if (rows.begin < 0) {
                run(arguments.before[level], common(rows, {rows.begin, 0}), all);
            }
            if (rows.end > all) run(arguments.after[level], common(rows, {all, rows.end}), -all);
        },
        worker.arguments);
}

void PassRunner::run_share(Worker& worker, std::size_t level) const {
    const RowRange rows =
        std::visit([&](const auto& arguments) { return arguments.levels[level].rows; },
                   worker.arguments);
    const RowRange own = split_rows(rows.count(), worker.number, worker.count);
    run_cells(worker, level, {{rows.begin + own.begin, rows.begin + own.end}});
}

template <typename Number>
void PassRunner::run_level(const Level<Number>& level, const Patch& cells) const {
    const StepProblem::Pass& pass = problem_.passes[level.pass];
    const std::int64_t band =
        problem_.has_halo() || level.when_written != nullptr
            ? rows_of_a_band<Number>(layout_, std::max<std::size_t>(1, level.results.size()))
            : cells.rows.count();
    const ColumnRange columns = cells.columns.within(layout_.width);
    const bool is_whole = columns.begin == 0 && columns.end == layout_.width;
    for (std::int64_t row = cells.rows.begin; row < cells.rows.end; row += band) {
        const Patch part{{row, std::min(row + band, cells.rows.end)}, cells.columns};
        level.moment.leave_if_cancelled();
        const bool fills_columns = is_whole && pass.kernel->fills_columns();
        pass.kernel->run(level.given, part);
        for (std::size_t k = 0; k < level.results.size(); ++k) {
            if (!pass.results[k].needs_halo || !problem_.has_halo()) continue;
            if (!fills_columns || !has_copied_columns(level, k)) {
                fill_halo_of(level, k, part);
                continue;
            }
            // Only the first and the last row are copied to rows of the halo.
            const std::int64_t last = layout_.height - 1;
            if (part.rows.begin == 0) fill_halo_of(level, k, {{0, 1}, part.columns});
            if (part.rows.end == last + 1) fill_halo_of(level, k, {{last, last + 1}, part.columns});
        }
        if (level.when_written != nullptr) (*level.when_written)(part.rows);
    }
}

/// Whether the kernel itself fills the halo columns of a result.
template <typename Number>
bool PassRunner::has_copied_columns(const Level<Number>& level, std::size_t number) const {
    const auto& [rules, copied] = sides_[level.pass];
    return copied && copied_columns(rules[number], layout_.width) == copied;
}

/// Fills a result's halo for the moment at which neighbours will read it.
template <typename Number>
void PassRunner::fill_halo_of(const Level<Number>& level, std::size_t number,
                              const Patch& cells) const {
    const StepProblem::Result& result = problem_.passes[level.pass].results[number];
    const auto fill = [&](const SideRules& rules) {
        fill_halo_from(level.results[number], level.given.layout, rules, cells);
    };
    const SideRules& rules = sides_[level.pass].rules[number];
    const auto* const own = std::get_if<StepProblem::SpeciesPlane>(&result.plane);
    const bool has_rules = own != nullptr || result.rules;
    if (!has_rules || problem_.changing_sides.empty()) return fill(rules);
    const StepMoment& moment = level.moment;
    const bool is_next = result.read_at == StepProblem::Result::next_step;
    const SideMoment when{is_next ? moment.complete + 1 : moment.complete,
                          is_next ? moment.next_t : moment.t + result.read_at * moment.length};
    // The rules at sides read the species in the cells beside the side. This pass has just written
    // these cells into the same register.
    SpeciesPlanes present(problem_.species_needs_halo.size());
    const std::vector<StepProblem::Result>& results = problem_.passes[level.pass].results;
    for (std::size_t k = 0; k < results.size(); ++k) {
        const auto* const other = std::get_if<StepProblem::SpeciesPlane>(&results[k].plane);
        if (own == nullptr || other == nullptr || other->in_register != own->in_register) continue;
        present[other->species.index()] = level.written[k];
    }
    fill(problem_.sides_of(own != nullptr ? own->species : *result.rules, when, present, cells));
}

void PassRunner::run_once(Team& team, Registers registers, const StepMoment& moment) {
    team.run([&](int index) {
        const FlushDenormals environment;
        Worker worker;
        prepare(worker, index, team.size());
        run(worker, team, registers, moment);
    });
}

}  // namespace cascade

// Rows are computed in bands that fit into a cache, and the halo of a band is filled while the band
// is cached. Each thread folds the aggregates of all rows itself, which takes one barrier instead
// of two.
#include "solvers/pass_runner.h"

#include "core/check.h"
#include "core/floating_point.h"
#include "core/overloaded.h"
#include "ir/draw_of_step.h"
#include "solvers/constraint_solver.h"
#include "solvers/tiling.h"

#include <algorithm>

namespace cascade {
namespace {

/// The halo's columns are beside rows that were just written. If they are filled band by band, the
/// rows are still in the cache.
template <typename Number>
std::int64_t rows_of_a_band(const PlaneLayout& layout, std::size_t results) {
    // A quarter of a MiB of results.
    constexpr auto elements_in_cache = static_cast<std::int64_t>(262144 / sizeof(Number));
    return std::max<std::int64_t>(8, elements_in_cache /
                                         (layout.stride * static_cast<std::int64_t>(results)));
}

/// The cells that columns of the halo copy; nullopt if a side has a value of its own.
std::optional<HaloColumns> copied_columns(const SideRules& sides, std::int64_t width) {
    const auto wraps = [&](Side side) { return sides[side].kind == SideKind::periodic; };
    if (sides[Side::left].has_value() || sides[Side::right].has_value()) return std::nullopt;
    return HaloColumns{wraps(Side::left) ? width - 1 : 0, wraps(Side::right) ? 0 : width - 1};
}

}  // namespace

PlaneLayout layout_of(const StepProblem& problem, const Exchange* others) {
    if (others == nullptr) return PlaneLayout(problem.grid);
    if (!problem.grid.linked) return PlaneLayout(problem.grid, others->rows());
    return PlaneLayout(problem.grid,
                       with_neighbours(problem.grid, others->rows(), rows_reached(problem), false));
}

struct PassRunner::WholeGrid {
    PassRunner runner;
    std::vector<std::vector<Field>> planes;
    std::vector<std::span<Field>> registers;
    std::vector<Worker> workers;

    /// Planes for these registers, and a worker for each of `threads` threads.
    WholeGrid(const StepProblem& problem, Registers parts, int threads)
        : runner(problem), workers(static_cast<std::size_t>(threads)) {
        for (const std::span<Field> part : parts) {
            std::vector<Field>& of_register = planes.emplace_back();
            for (std::size_t k = 0; k < part.size(); ++k) {
                of_register.emplace_back(PlaneLayout(problem.grid), problem.precision);
            }
        }
        for (std::vector<Field>& each : planes) registers.emplace_back(each);
        for (int k = 0; k < threads; ++k) {
            runner.prepare(workers[static_cast<std::size_t>(k)], k, threads);
        }
    }
};

PassRunner::PassRunner(const StepProblem& problem, Exchange* others)
    : problem_(problem),
      others_(others),
      layout_(layout_of(problem, others)),
      rows_(others != nullptr ? others->rows() : layout_.rows) {
    CHECK(!problem.passes.empty(), "a step has a pass");
    CHECK(!problem.links ||
              (problem.grid.linked && problem.links->precision() == problem.precision),
          "links are those of a linked grid, in the precision of its problem");
    for (std::uint32_t k = 0; k < problem.temporaries; ++k) {
        temporaries_.emplace_back(layout_, problem.precision);
    }
    for (const StepProblem::Pass& pass : problem.passes) {
        PassSides& of_pass = sides_.emplace_back();
        for (const StepProblem::Result& result : pass.results) {
            of_pass.rules.push_back(problem.sides_of(result));
            const bool needs_columns = result.needs_halo && problem.has_halo();
            if (!needs_columns || of_pass.copied) continue;
            of_pass.copied = copied_columns(of_pass.rules.back(), layout_.width);
        }
    }
    row_values_.assign(problem.aggregates,
                       std::vector<double>(static_cast<std::size_t>(layout_.row_count())));
    with_number(problem.precision, [&](auto zero) {
        using Number = decltype(zero);
        auto& helpers = helpers_.emplace<Helpers<Number>>();
        std::vector<std::pair<const WeightedLags*, std::shared_ptr<ConvolutionRunner<Number>>>> all;
        const auto runner_of = [&](const WeightedLags& weights) {
            for (const auto& [known, runner] : all) {
                if (*known == weights) return runner;
            }
            const auto made = std::make_shared<ConvolutionRunner<Number>>(problem.grid, weights);
            return all.emplace_back(&weights, made).second;
        };
        if (others != nullptr) return;  // The whole grid's runner has them.
        for (const StepProblem::Pass& pass : problem.passes) {
            auto& solvers = helpers.solvers.emplace_back();
            for (const StepProblem::Solve& each : pass.solves) {
                solvers.push_back(std::make_unique<ConstraintSolver<Number>>(each, problem));
            }
            auto& convolutions = helpers.convolutions.emplace_back();
            for (const StepProblem::Convolution& each : pass.convolutions) {
                convolutions.push_back(runner_of(*each.weights));
            }
        }
        if (problem.diffusion.empty()) return;
        std::vector<SideRules> sides;
        for (const SpeciesId id : ids_below<SpeciesId>(problem.diffusion.size())) {
            sides.push_back(problem.sides_of(id));
        }
        helpers.waves.emplace(problem.grid, sides);
    });
}

PassRunner::~PassRunner() = default;

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
        bind(worker, 0, pass, registers, moment);
        run_cells(worker, 0, {worker.rows});
    }
}

void PassRunner::prepare_pass(Worker& worker, Team& team, std::size_t number, Registers registers,
                              const StepMoment& moment) {
    moment.leave_if_cancelled();
    const StepProblem::Pass& pass = problem_.passes[number];
    std::visit(
        [&]<typename Number>(Arguments<Number>& arguments) {
            const auto sum_around = [&](PassRunner& runner, Worker& own, Registers planes) {
                if (!pass.solves.empty()) runner.solve<Number>(own, number, team, planes, moment);
                if (!pass.convolutions.empty()) runner.convolve<Number>(own, number, team, planes);
            };
            const auto damp = [&](PassRunner& runner, Worker& own, Registers planes) {
                auto& of_whole = std::get<Arguments<Number>>(own.arguments);
                of_whole.aggregates = arguments.aggregates;
                runner.filter(own, of_whole, *pass.filter, team, planes, moment);
            };
            if (!pass.solves.empty() || !pass.convolutions.empty()) {
                on_whole_grid(worker, team, registers, sum_around);
            }
            if (!pass.reductions.empty()) reduce(worker, arguments, number, team, registers);
            if (pass.filter) on_whole_grid(worker, team, registers, damp);
        },
        worker.arguments);
}

template <typename Work>
void PassRunner::on_whole_grid(Worker& worker, Team& team, Registers registers, const Work& work) {
    if (others_ == nullptr) return work(*this, worker, registers);
    std::vector<Field*> own, whole;
    const auto list = [](Registers planes, IdVector<TemporaryId, Field>& temporaries,
                         std::vector<Field*>& all) {
        for (const std::span<Field> of_register : planes) {
            for (Field& field : of_register) all.push_back(&field);
        }
        for (Field& field : temporaries) all.push_back(&field);
    };
    team.barrier();
    if (worker.number == 0) {
        if (others_->is_root() &&
            (!whole_ || whole_->registers.size() != registers.size() ||
             whole_->workers.size() != static_cast<std::size_t>(worker.count))) {
            whole_ = std::make_unique<WholeGrid>(problem_, registers, worker.count);
        }
        list(registers, temporaries_, own);
        if (whole_) list(whole_->registers, whole_->runner.temporaries_, whole);
        others_->gather(own, whole);
    }
    team.barrier();
    if (whole_) {
        work(whole_->runner, whole_->workers[static_cast<std::size_t>(worker.number)],
             whole_->registers);
        team.barrier();
    }
    if (worker.number == 0) others_->scatter(whole, own);
    team.barrier();
}

bool PassRunner::wraps(const SideRules& sides) const {
    return !problem_.grid.linked &&
           sides[problem_.grid.depth > 1 ? Side::front : Side::top].kind == SideKind::periodic;
}

void PassRunner::share(std::span<const Exchange::Shared> planes) const {
    others_->fill_halos(planes, rows_reached(problem_));
}

void PassRunner::share_results(std::size_t pass, Registers registers) {
    std::vector<Exchange::Shared> planes;
    const std::vector<StepProblem::Result>& results = problem_.passes[pass].results;
    for (std::size_t k = 0; k < results.size(); ++k) {
        if (!results[k].needs_halo && problem_.has_halo()) continue;
        planes.push_back({&written(results[k].plane, registers), wraps(sides_[pass].rules[k])});
    }
    share(planes);
}

void PassRunner::share_species(std::span<Field> species) const {
    std::vector<Exchange::Shared> planes;
    for (std::size_t k = 0; k < species.size(); ++k) {
        planes.push_back({&species[k], wraps(problem_.sides_of(SpeciesId(k)))});
    }
    share(planes);
}

template <typename Number>
void PassRunner::solve(const Worker& worker, std::size_t pass_number, Team& team,
                       Registers registers, const StepMoment& moment) {
    const auto& solvers = std::get<Helpers<Number>>(helpers_).solvers[pass_number];
    const std::vector<StepProblem::Solve>& all = problem_.passes[pass_number].solves;
    for (std::size_t k = 0; k < all.size(); ++k) {
        solvers[k]->solve(team, worker.number, worker.count, registers, moment,
                          temporaries_[all[k].target]);
    }
}

/// The threads that wrote the rows beside the halo fill it.
template <typename Number>
void PassRunner::convolve(const Worker& worker, std::size_t pass_number, Team& team,
                          Registers registers) {
    const auto& runners = std::get<Helpers<Number>>(helpers_).convolutions[pass_number];
    const std::vector<StepProblem::Convolution>& all = problem_.passes[pass_number].convolutions;
    for (std::size_t k = 0; k < all.size(); ++k) {
        Number* const target = temporaries_[all[k].target].template origin<Number>();
        runners[k]->apply(team, worker.number, worker.count,
                          read(all[k].operand, registers).template origin<Number>(), target);
        if (!all[k].needs_halo || !problem_.has_halo()) continue;
        fill_halo_from(target, layout_, all[k].boundary, {worker.rows});
        team.barrier();
    }
}

/// Every thread reduces its rows. Then each thread folds the sums of all rows, which are
/// overwritten only after the next barrier of the team.
template <typename Number>
void PassRunner::reduce(Worker& worker, Arguments<Number>& arguments, std::size_t pass_number,
                        Team& team, Registers registers) {
    const StepProblem::Pass& pass = problem_.passes[pass_number];
    for (const StepProblem::Reduction& reduction : pass.reductions) {
        const Number* cells = read(reduction.operand, registers).template origin<Number>();
        std::vector<double>& rows = row_values_[reduction.aggregate];
        for (std::int64_t row = worker.rows.begin; row < worker.rows.end; ++row) {
            rows[static_cast<std::size_t>(row)] =
                reduce_row(reduction.kind, cells + layout_.row_start(row), layout_.width);
        }
    }
    team.barrier();
    if (others_ != nullptr) {
        std::vector<std::vector<double>*> rows;
        for (const StepProblem::Reduction& reduction : pass.reductions) {
            rows.push_back(&row_values_[reduction.aggregate]);
        }
        if (worker.number == 0) others_->share_rows(rows);
        team.barrier();
    }
    const std::int64_t cells = problem_.counted_cells();
    for (const StepProblem::Reduction& reduction : pass.reductions) {
        worker.row_values = row_values_[reduction.aggregate];
        const auto value =
            static_cast<Number>(reduce_rows(reduction.kind, worker.row_values, cells));
        arguments.aggregates[reduction.aggregate] = value;
        for (std::size_t later = pass_number; later < problem_.passes.size(); ++later) {
            for (const StepProblem::ChangingUniform& uniform : problem_.passes[later].changing) {
                const auto* const id = std::get_if<AggregateId>(&uniform.value);
                if (id == nullptr || *id != reduction.aggregate) continue;
                arguments.uniforms[later][uniform.slot.index()] = value;
            }
        }
    }
}

/// Every thread knows all aggregates, so all threads damp the same waves.
template <typename Number>
void PassRunner::filter(Worker& worker, Arguments<Number>& arguments, const SweepFilter& filter,
                        Team& team, Registers registers, const StepMoment& moment) const {
    worker.symbols.resize(problem_.diffusion.size());
    for (std::size_t k = 0; k < worker.symbols.size(); ++k) {
        for (std::size_t term = 0; term < diffusion_terms; ++term) {
            const StepProblem::DiffusionFactor& factor = problem_.diffusion[k][term];
            worker.symbols[k][term] =
                factor.aggregate ? double{arguments.aggregates[*factor.aggregate]} : factor.value;
        }
    }
    const auto planes_of = [&](RegisterId id) {
        std::vector<Number*> planes;
        for (Field& field : registers[id.index()]) {
            planes.push_back(field.template origin<Number>());
        }
        return planes;
    };
    typename WaveFilter<Number>::FilteredPlanes planes{planes_of(filter.in_register), {}, {}};
    for (const RegisterId id : filter.kept) planes.kept.push_back(planes_of(id));
    if (filter.error) planes.error = planes_of(*filter.error);
    std::get<Helpers<Number>>(helpers_).waves->apply(team, worker.number, worker.count, planes,
                                                     worker.symbols, filter.response,
                                                     moment.length);
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
            [](AggregateId) {},  // Its reduction sets it.
        };
        std::visit(set, uniform.value);
    }
}

void PassRunner::bind(Worker& worker, std::size_t level, std::size_t pass, Registers registers,
                      const StepMoment& moment, bool is_near, const RowsWritten* when_written) {
    std::visit(
        [&](auto& arguments) {
            bind_as(arguments, level, pass, registers, moment, is_near, when_written);
        },
        worker.arguments);
}

template <typename Number>
void PassRunner::bind_as(Arguments<Number>& arguments, std::size_t number, std::size_t pass_number,
                         Registers registers, const StepMoment& moment, bool is_near,
                         const RowsWritten* when_written) {
    if (arguments.levels.size() <= number) arguments.levels.resize(number + 1);
    const StepProblem::Pass& pass = problem_.passes[pass_number];
    Level<Number>& level = arguments.levels[number];
    level.pass = pass_number;
    level.moment = moment;
    level.when_written = when_written;
    level.uniforms = arguments.uniforms[pass_number];
    set_uniforms(level.uniforms, pass, moment);
    level.fields.clear();
    for (const StepProblem::PlaneRef& ref : pass.fields) {
        level.fields.push_back(read(ref, registers).template origin<Number>());
    }
    level.masks.clear();
    for (const Mask* const mask : pass.masks) level.masks.push_back(mask->origin());
    level.results.clear();
    level.written.clear();
    for (const StepProblem::Result& result : pass.results) {
        Field& plane = written(result.plane, registers);
        level.results.push_back(plane.template origin<Number>());
        level.written.push_back(&plane);
    }
    const LinkTable<Number> links =
        problem_.links ? problem_.links->template table<Number>() : LinkTable<Number>{};
    level.given = {level.fields, level.masks, level.uniforms, level.results,
                   layout_,      links,       is_near,        sides_[pass_number].copied};
}

void PassRunner::run_cells(Worker& worker, std::size_t level, const Patch& cells) const {
    std::visit([&](const auto& arguments) { run_level(arguments.levels[level], cells); },
               worker.arguments);
}

template <typename Number>
void PassRunner::run_level(const Level<Number>& level, const Patch& cells) const {
    const StepProblem::Pass& pass = problem_.passes[level.pass];
    const std::int64_t band =
        problem_.has_halo() || level.when_written != nullptr
            ? rows_of_a_band<Number>(layout_, std::max<std::size_t>(1, level.results.size()))
            : cells.rows.end - cells.rows.begin;
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
            // Only the first and the last row have copies in rows of the halo.
            const std::int64_t last = layout_.height - 1;
            if (part.rows.begin == 0) fill_halo_of(level, k, {{0, 1}, part.columns});
            if (part.rows.end == last + 1) fill_halo_of(level, k, {{last, last + 1}, part.columns});
        }
        if (level.when_written != nullptr) (*level.when_written)(part.rows);
    }
}

/// Does a kernel fill these columns of a result's halo?
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
        fill_halo_from(level.results[number], layout_, rules, cells);
    };
    const SideRules& rules = sides_[level.pass].rules[number];
    const auto* const own = std::get_if<StepProblem::SpeciesPlane>(&result.plane);
    const bool has_rules = own != nullptr || result.rules;
    if (!has_rules || problem_.changing_sides.empty()) return fill(rules);
    const StepMoment& moment = level.moment;
    const bool is_next = result.read_at == StepProblem::Result::next_step;
    const SideMoment when{is_next ? moment.complete + 1 : moment.complete,
                          is_next ? moment.next_t : moment.t + result.read_at * moment.length};
    // Sides read the species that this pass has written beside them into the same register.
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

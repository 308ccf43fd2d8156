// Computes what must precede the kernel of a pass: constraints, convolutions, aggregates and
// filters of waves. Each thread itself adds up the aggregates of all rows, which takes one barrier
// instead of two. If the grid is in parts, the root does the computations that need all cells, on
// whole planes.
#include "solvers/constraint_solver.h"
#include "solvers/pass_runner.h"
#include "solvers/tiling.h"

#include "core/check.h"

#include <utility>

namespace cascade {

PlaneLayout layout_of(const StepProblem& problem, const Exchange* others) {
    if (others == nullptr) return PlaneLayout(problem.grid);
    // Beyond these rows, planes have a halo of one more layer.
    const std::int64_t layers =
        problem.grid.linked ? others->levels() * rows_reached(problem) : others->levels() - 1;
    return PlaneLayout(problem.grid, with_neighbours(problem.grid, others->rows(), layers,
                                                     wraps_between_parts(problem)));
}

struct PassRunner::WholeGrid {
    PassRunner runner;
    std::vector<std::vector<Field>> planes;
    std::vector<std::span<Field>> registers;
    std::vector<Worker> workers;

    /// Makes whole planes for the registers `parts`, and a worker for each of `threads` threads.
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
      rows_(others != nullptr ? others->rows() : layout_.rows),
      wraps_(others != nullptr && wraps_between_parts(problem)),
      reach_(others != nullptr ? rows_reached(problem) : 1) {
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
        // If the grid is in parts, only the runner of the whole grid needs these helpers.
        if (others != nullptr) return;
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

void PassRunner::prepare_pass(Worker& worker, Team& team, std::size_t number, Registers registers,
                              const StepMoment& moment) {
    moment.leave_if_cancelled();
    const StepProblem::Pass& pass = problem_.passes[number];
    std::visit(
        [&]<typename Number>(Arguments<Number>& arguments) {
            const auto sum_around = [&](PassRunner& runner, Worker& own, Registers planes) {
                if (!pass.solves.empty()) runner.solve<Number>(own, number, team, planes, moment);
                if (!pass.convolutions.empty()) {
                    runner.convolve<Number>(own, number, team, planes, moment);
                }
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
    others_->fill_halos(planes, reach_);
}

void PassRunner::add_reads(std::size_t pass, Registers registers, HaloReads& reads) {
    reads.add(pass, [&](const StepProblem::PlaneRef& ref) { return &written(ref, registers); });
}

void PassRunner::share_reads(const HaloReads& reads) const {
    std::vector<Exchange::Shared> planes;
    for (Field* const plane : reads.planes()) planes.push_back({plane, wraps_});
    if (!planes.empty()) others_->fill_halos(planes, reads.width() * reach_);
}

void PassRunner::fill_sides(std::span<Field> species, SideMoment moment) const {
    if (!problem_.has_halo()) return;
    const SpeciesPlanes present = planes_of(species);
    for (std::size_t s = 0; s < species.size(); ++s) {
        const SideRules rules = problem_.sides_of(SpeciesId(s), moment, present, {rows_});
        species[s].visit(
            [&](auto& plane) { fill_halo_from(plane.origin(), plane.layout(), rules, {rows_}); });
    }
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

/// Computes the convolutions of a pass and fills the halos of their results. Each halo is filled by
/// the threads that wrote the rows beside it.
template <typename Number>
void PassRunner::convolve(const Worker& worker, std::size_t pass_number, Team& team,
                          Registers registers, const StepMoment& moment) {
    const auto& runners = std::get<Helpers<Number>>(helpers_).convolutions[pass_number];
    const std::vector<StepProblem::Convolution>& all = problem_.passes[pass_number].convolutions;
    for (std::size_t k = 0; k < all.size(); ++k) {
        Number* const target = temporaries_[all[k].target].template origin<Number>();
        runners[k]->apply(team, worker.number, worker.count,
                          read(all[k].operand, registers).template origin<Number>(), target,
                          moment.cancel);
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

/// Needs no barrier: every thread has computed all aggregates itself, so all threads use the same
/// factors.
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
                                                     worker.symbols, filter.response, moment.length,
                                                     moment.cancel);
}

}  // namespace cascade

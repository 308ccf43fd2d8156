#include "solvers/pass_runner.h"

#include "core/check.h"
#include "core/floating_point.h"

#include <algorithm>

namespace cascade {
namespace {

/// The halo's columns lie beside rows that were just written: filled a band at a time they are
/// still in the cache.
std::int64_t rows_of_a_band(const PlaneLayout& layout, std::size_t results) {
    constexpr std::int64_t elements_in_cache = 65536;  // A quarter of a MiB of results.
    return std::max<std::int64_t>(
        8, elements_in_cache / (layout.stride * static_cast<std::int64_t>(results)));
}

}  // namespace

PassRunner::PassRunner(const StepProblem& problem) : problem_(problem), layout_(problem.grid) {
    CHECK(!problem.passes.empty(), "a step has a pass");
    for (std::uint32_t k = 0; k < problem.temporaries; ++k) {
        temporaries_.emplace_back(layout_);
        temporary_cells_.push_back(temporaries_.back().origin());
    }
    row_values_.assign(problem.aggregates,
                       std::vector<double>(static_cast<std::size_t>(layout_.row_count())));
    if (problem.diffusion.empty()) return;
    std::vector<SideRules> sides;
    for (std::size_t k = 0; k < problem.diffusion.size(); ++k) sides.push_back(problem.sides_of(k));
    wave_filter_.emplace(problem.grid, sides);
}

void PassRunner::prepare(Worker& worker, int number, int count) const {
    worker.number = number;
    worker.count = count;
    worker.rows = split_rows(layout_.row_count(), number, count);
    worker.aggregates.assign(problem_.aggregates, 0.0F);
    worker.uniforms.clear();
    for (const StepProblem::Pass& pass : problem_.passes) worker.uniforms.push_back(pass.uniforms);
}

float* PassRunner::plane(const StepProblem::PlaneRef& ref, Registers registers) const {
    switch (ref.kind) {
        case StepProblem::PlaneRef::Kind::species: return registers[ref.in_register][ref.number];
        case StepProblem::PlaneRef::Kind::temporary: return temporary_cells_[ref.number];
        case StepProblem::PlaneRef::Kind::fixed: break;
    }
    return const_cast<float*>(ref.cells);  // Read only: no pass writes a fixed plane.
}

void PassRunner::run(Worker& worker, Team& team, Registers registers, const StepMoment& moment,
                     std::size_t first_pass) {
    for (std::size_t number = first_pass; number < problem_.passes.size(); ++number) {
        const StepProblem::Pass& pass = problem_.passes[number];
        if (number > first_pass) team.barrier();
        if (!pass.reductions.empty()) reduce(worker, pass, team, registers, number);
        if (pass.filter) filter(worker, *pass.filter, team, registers, moment);
        set_uniforms(worker.uniforms[number], pass, moment);
        run_kernel(worker, pass, number, registers);
    }
}

/// Every thread reduces its rows, then all threads take all rows together, each for itself. The
/// numbers of rows are written again only behind the next meeting of the team.
void PassRunner::reduce(Worker& worker, const StepProblem::Pass& pass, Team& team,
                        Registers registers, std::size_t pass_number) {
    for (const StepProblem::Reduction& reduction : pass.reductions) {
        const float* cells = plane(reduction.operand, registers);
        std::vector<double>& rows = row_values_[reduction.aggregate];
        for (std::int64_t row = worker.rows.begin; row < worker.rows.end; ++row) {
            rows[static_cast<std::size_t>(row)] =
                reduce_row(reduction.kind, cells + layout_.row_start(row), layout_.width);
        }
    }
    team.barrier();
    const std::int64_t cells = problem_.counted_cells();
    for (const StepProblem::Reduction& reduction : pass.reductions) {
        worker.row_values = row_values_[reduction.aggregate];
        const float value = reduce_rows(reduction.kind, worker.row_values, cells);
        worker.aggregates[reduction.aggregate] = value;
        for (std::size_t later = pass_number; later < problem_.passes.size(); ++later) {
            for (const StepProblem::ChangingUniform& uniform : problem_.passes[later].changing) {
                if (uniform.kind != StepProblem::ChangingUniform::Kind::aggregate) continue;
                if (uniform.number != reduction.aggregate) continue;
                worker.uniforms[later][uniform.slot] = value;
            }
        }
    }
}

/// Every thread knows all aggregates, so all take the same waves to be damped.
void PassRunner::filter(Worker& worker, const SweepFilter& filter, Team& team, Registers registers,
                        const StepMoment& moment) const {
    worker.symbols.resize(problem_.diffusion.size());
    for (std::size_t k = 0; k < worker.symbols.size(); ++k) {
        for (std::size_t term = 0; term < diffusion_terms; ++term) {
            const StepProblem::DiffusionFactor& factor = problem_.diffusion[k][term];
            const float value =
                factor.is_aggregate ? worker.aggregates[factor.aggregate] : factor.value;
            worker.symbols[k][term] = value;
        }
    }
    wave_filter_->apply(team, worker.number, worker.count, registers[filter.in_register],
                        worker.symbols, filter.response, filter.part * moment.length);
}

void PassRunner::set_uniforms(std::vector<float>& uniforms, const StepProblem::Pass& pass,
                              const StepMoment& moment) const {
    for (const StepProblem::ChangingUniform& uniform : pass.changing) {
        float& value = uniforms[uniform.slot];
        switch (uniform.kind) {
            case StepProblem::ChangingUniform::Kind::step:
                value = static_cast<float>(moment.complete);
                break;
            case StepProblem::ChangingUniform::Kind::time:
                value = static_cast<float>(moment.t + uniform.value * moment.length);
                break;
            case StepProblem::ChangingUniform::Kind::coefficient:
                value = static_cast<float>(uniform.times_step ? uniform.value * moment.length
                                                              : uniform.value);
                break;
            case StepProblem::ChangingUniform::Kind::aggregate: break;  // Set by its reduction.
        }
    }
}

void PassRunner::run_kernel(Worker& worker, const StepProblem::Pass& pass, std::size_t number,
                            Registers registers) {
    worker.fields.clear();
    for (const StepProblem::PlaneRef& ref : pass.fields) {
        worker.fields.push_back(plane(ref, registers));
    }
    worker.results.clear();
    for (const StepProblem::Result& result : pass.results) {
        worker.results.push_back(plane(result.plane, registers));
    }
    const KernelArguments arguments{worker.fields, pass.masks, worker.uniforms[number],
                                    worker.results, layout_};
    const std::int64_t band = rows_of_a_band(layout_, std::max<std::size_t>(1, pass.results.size()));
    for (std::int64_t row = worker.rows.begin; row < worker.rows.end; row += band) {
        const RowRange rows{row, std::min(row + band, worker.rows.end)};
        pass.kernel->run(arguments, rows);
        for (std::size_t k = 0; k < pass.results.size(); ++k) {
            if (!pass.results[k].needs_halo) continue;
            fill_halo_from_rows(worker.results[k], layout_,
                                problem_.sides_of(pass.results[k].plane), rows.begin, rows.end);
        }
    }
}

void run_once(const StepProblem& problem, Team& team, Registers registers,
              const StepMoment& moment) {
    PassRunner runner(problem);
    team.run([&](int index) {
        const FlushDenormals environment;
        PassRunner::Worker worker;
        runner.prepare(worker, index, team.size());
        runner.run(worker, team, registers, moment);
    });
}

}  // namespace cascade

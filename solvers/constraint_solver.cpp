// All threads take the same decisions, because all add the same sums of rows.
#include "solvers/constraint_solver.h"

#include "ir/reduction.h"
#include "solvers/bicgstab.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace cascade {
namespace {

constexpr int most_iterations_on_grids = 200, most_iterations_on_links = 2000;
/// The Laplacian is not used as a preconditioner if its part of L is smaller than this fraction of
/// the rest of L. Both parts are measured on a field that alternates from cell to cell.
constexpr double least_laplacian = 1e-3;
/// The number s in a (Δ − s) is rounded to this many binary digits, so that the factors of Δ − s
/// can be reused when s changes a little.
constexpr int digits_of_shift = 5;
/// The solver stops when the norm of e is at most this fraction of the norm of b.
template <typename Number>
constexpr double tolerance = sizeof(Number) == sizeof(float) ? 1e-5 : 1e-12;

double rounded(double value, int digits) {
    int exponent = 0;
    const double part = std::frexp(value, &exponent);
    return std::ldexp(std::round(std::ldexp(part, digits)), exponent - digits);
}

}  // namespace

template <typename Number>
struct ConstraintSolver<Number>::Worker {
    Team& team;
    int thread, threads;
    Registers registers;
    StepMoment moment;
    RowRange rows;
    PassRunner::Worker whole, linear, parts;
    std::size_t next_sum = 0;
    bool knows_factors = false;
};

template <typename Number>
template <typename Act>
void ConstraintSolver<Number>::each_row(const Worker& worker, const Act& act) const {
    for (std::int64_t row = worker.rows.begin; row < worker.rows.end; ++row) {
        act(layout_.row_start(row));
    }
}

/// Calls `act` with the index of each cell of the worker, counted from cell (0, 0, 0).
template <typename Number>
template <typename Act>
void ConstraintSolver<Number>::each_cell(const Worker& worker, const Act& act) const {
    each_row(worker, [&](std::int64_t start) {
        for (std::int64_t cell = start; cell < start + layout_.width; ++cell) act(cell);
    });
}

template <typename Number>
ConstraintSolver<Number>::ConstraintSolver(const StepProblem::Solve& solve,
                                           const StepProblem& outer)
    : problem_(solve),
      outer_(outer),
      layout_(outer.grid),
      whole_(*solve.whole),
      linear_(*solve.linear) {
    if (solve.parts) parts_.emplace(*solve.parts);
    for (Field* field : {&residual_, &shadow_, &direction_, &image_, &other_image_}) {
        *field = Field(layout_, outer.precision);
    }
    for (std::vector<double>& sums : row_sums_) {
        sums.resize(static_cast<std::size_t>(layout_.row_count()));
    }
    if (outer.grid.linked && outer.counted_cells() <= LinkedLaplacian::most_cells) {
        laplacian_ = std::make_unique<LinkedLaplacian>(*outer.links, layout_, problem_.areas.get());
    }
    if (outer.grid.linked || outer.grid.cell_count() == 1) return;
    stencil_.emplace(outer.grid, problem_.sides, areas_of_cells());
}

/// Runs the passes of a problem and copies the problem's results to `results`.
template <typename Number>
void ConstraintSolver<Number>::apply(Worker& worker, PassRunner& runner,
                                     PassRunner::Worker& of_runner, std::vector<Field*> results) {
    runner.run(of_runner, worker.team, worker.registers, worker.moment);
    const StepProblem& problem = runner.problem();
    for (std::size_t k = 0; k < results.size(); ++k) {
        const TemporaryId id(problem.temporaries - results.size() + k);
        const Number* const from = runner.temporary(id).template origin<Number>();
        Number* const to = results[k]->template origin<Number>();
        each_row(worker, [&](std::int64_t start) {
            std::copy(from + start, from + start + layout_.width, to + start);
        });
    }
}

/// The rules at the field's sides, with values for the moment at which e must be 0.
template <typename Number>
SideRules ConstraintSolver<Number>::sides_at(const Worker& worker) const {
    if (!problem_.rules || outer_.changing_sides.empty()) return problem_.sides;
    const SideMoment moment{worker.moment.complete,
                            worker.moment.t + problem_.read_at * worker.moment.length};
    const SpeciesPlanes present = planes_of(worker.registers[problem_.in_register.index()]);
    return outer_.sides_of(*problem_.rules, moment, present, {{0, layout_.row_count()}});
}

/// Fills the halo by the rules at the field's sides. With `is_linear`, the plane is a change of the
/// field, so values at sides are 0.
template <typename Number>
void ConstraintSolver<Number>::fill_halo_of_unknown(Worker& worker, bool is_linear) {
    worker.team.barrier();
    if (worker.thread == 0 && outer_.has_halo()) {
        SideRules rules = is_linear ? problem_.sides : sides_at(worker);
        if (is_linear) {
            for (SideRule& rule : rules.at) {
                rule.value = 0;
                rule.values = nullptr;
            }
        }
        problem_.unknown->fill_halo(rules);
    }
    worker.team.barrier();
}

/// Applies L to the plane `unknown` and writes the result to `result`. All threads must already
/// have written their rows of `unknown`.
template <typename Number>
void ConstraintSolver<Number>::apply_linear(Worker& worker, Field& result) {
    fill_halo_of_unknown(worker, true);
    apply(worker, linear_, worker.linear, {&result});
    const Number* const areas = areas_of_cells();
    if (areas == nullptr || !outer_.grid.linked) return;
    // Padding cells have the links of the last cell, but must not count in sums.
    Number* const cells = result.template origin<Number>();
    each_cell(worker, [&](std::int64_t i) {
        if (areas[i] == 0) cells[i] = 0;
    });
}

/// The sum of a · b over all cells, added in the same tree for any number of threads.
template <typename Number>
double ConstraintSolver<Number>::dot(Worker& worker, const Field& a, const Field& b) {
    std::vector<double>& sums = row_sums_[worker.next_sum++ % sums_in_use];
    const Number* const first = a.origin<Number>();
    const Number* const second = b.origin<Number>();
    for (std::int64_t row = worker.rows.begin; row < worker.rows.end; ++row) {
        const std::int64_t start = layout_.row_start(row);
        std::array<double, 8> partial{};
        std::int64_t i = start;
        for (const std::int64_t end = start + layout_.width / 8 * 8; i < end; i += 8) {
            for (std::int64_t k = 0; k < 8; ++k) {
                partial[static_cast<std::size_t>(k)] +=
                    static_cast<double>(first[i + k]) * static_cast<double>(second[i + k]);
            }
        }
        for (; i < start + layout_.width; ++i) {
            partial[0] += static_cast<double>(first[i]) * static_cast<double>(second[i]);
        }
        double sum = 0;
        for (const double part : partial) sum += part;
        sums[static_cast<std::size_t>(row)] = sum;
    }
    worker.team.barrier();
    std::vector<double> rows = sums;
    return reduce_rows(ReductionKind::sum, rows, 1);
}

/// Subtracts the mean over the domain, and returns it.
template <typename Number>
double ConstraintSolver<Number>::subtract_mean(Worker& worker, Field& from) {
    const Number* const areas = areas_of_cells();
    Number* const cells = from.origin<Number>();
    std::vector<double>& sums = row_sums_[worker.next_sum++ % sums_in_use];
    std::vector<double>& areas_of_rows = row_sums_[worker.next_sum++ % sums_in_use];
    for (std::int64_t row = worker.rows.begin; row < worker.rows.end; ++row) {
        const std::int64_t start = layout_.row_start(row);
        double sum = 0, area = 0;
        for (std::int64_t i = start; i < start + layout_.width; ++i) {
            const double weight = areas == nullptr ? 1 : static_cast<double>(areas[i]);
            sum += weight * static_cast<double>(cells[i]);
            area += weight;
        }
        sums[static_cast<std::size_t>(row)] = sum;
        areas_of_rows[static_cast<std::size_t>(row)] = area;
    }
    worker.team.barrier();
    std::vector<double> all = sums, all_areas = areas_of_rows;
    const double mean =
        reduce_rows(ReductionKind::sum, all, 1) / reduce_rows(ReductionKind::sum, all_areas, 1);
    each_cell(worker, [&](std::int64_t i) {
        if (areas == nullptr || areas[i] != 0) cells[i] -= static_cast<Number>(mean);
    });
    return mean;
}

/// Sets column i of every row of the plane `unknown` to `value(i)`, and writes L of this plane to
/// `image_`. Cells with area 0 are set to 0.
template <typename Number>
template <typename Value>
void ConstraintSolver<Number>::respond(Worker& worker, const Value& value) {
    const Number* const areas = areas_of_cells();
    Number* const unknown = problem_.unknown->template origin<Number>();
    each_row(worker, [&](std::int64_t start) {
        for (std::int64_t i = 0; i < layout_.width; ++i) {
            const bool counts = areas == nullptr || areas[start + i] != 0;
            unknown[start + i] = counts ? value(i) : Number{0};
        }
    });
    apply_linear(worker, image_);
}

/// Finds the preconditioner of linked cells. Returns whether L of a constant is 0. For operators of
/// derivatives, L of a constant is computed exactly.
template <typename Number>
bool ConstraintSolver<Number>::probe(Worker& worker) {
    respond(worker, [](std::int64_t) { return Number{1}; });
    const double of_constant = dot(worker, image_, image_);
    if (of_constant == 0 && !laplacian_) return true;
    const Field& unknown = *problem_.unknown;
    const double constant = dot(worker, image_, unknown) / dot(worker, unknown, unknown);
    respond(worker, [](std::int64_t i) { return static_cast<Number>(i % 2 == 0 ? 1 : -1); });
    const double of_waves = dot(worker, image_, image_);
    if (laplacian_) find_shift(worker, constant);
    constexpr double part = StencilInverse<Number>::least_factor;
    return of_constant == 0 || of_constant <= part * part * of_waves;
}

/// Finds the preconditioner of grids.
template <typename Number>
void ConstraintSolver<Number>::find_stencil(Worker& worker) {
    Number* const unknown = problem_.unknown->template origin<Number>();
    each_row(worker, [&](std::int64_t start) {
        std::fill(unknown + start, unknown + start + layout_.width, Number{0});
    });
    worker.team.barrier();
    if (worker.thread == 0) stencil_->put_probes(unknown);
    apply_linear(worker, image_);
    worker.team.barrier();
    if (worker.thread == 0) stencil_->learn(image_.template origin<Number>());
    worker.team.barrier();
}

/// Finds a and s for which a (Δ − s) approximates L, from the factor `constant` by which L
/// multiplies a constant and from L of a wave, which is in `image_`.
template <typename Number>
void ConstraintSolver<Number>::find_shift(Worker& worker, double constant) {
    const Number* const unknown = problem_.unknown->template origin<Number>();
    const Number* const image = image_.template origin<Number>();
    laplacian_->apply(unknown, other_image_.template origin<Number>(), worker.rows);
    each_cell(worker, [&](std::int64_t i) {
        residual_.template origin<Number>()[i] =
            image[i] - static_cast<Number>(constant) * unknown[i];
    });
    const double size = dot(worker, other_image_, other_image_);
    const double both = dot(worker, other_image_, residual_);
    const double waves = dot(worker, *problem_.unknown, *problem_.unknown);
    if (worker.thread == 0) {
        factor_ = both / size;
        const bool helps =
            std::abs(factor_) * std::sqrt(size / waves) > least_laplacian * std::abs(constant);
        const double shift = std::abs(constant / factor_);
        const bool works =
            helps && std::isfinite(shift) && laplacian_->factorise(rounded(shift, digits_of_shift));
        if (!works) factor_ = 0;
    }
    worker.team.barrier();
}

/// Applies the inverse of the preconditioner to `from` and writes the result into the plane
/// `unknown`.
template <typename Number>
void ConstraintSolver<Number>::precondition(Worker& worker, const Field& from) {
    Number* const to = problem_.unknown->template origin<Number>();
    const Number* const cells = from.template origin<Number>();
    if (factor_ != 0) {
        worker.team.barrier();
        if (worker.thread == 0) laplacian_->solve(cells, to, factor_);
        worker.team.barrier();
        return;
    }
    each_row(worker, [&](std::int64_t start) {
        std::copy(cells + start, cells + start + layout_.width, to + start);
    });
    if (!stencil_) return;
    stencil_->apply(worker.team, worker.thread, worker.threads, worker.knows_factors, to,
                    worker.moment.cancel);
    worker.knows_factors = true;
    const Number* const areas = areas_of_cells();
    if (areas == nullptr) return;
    each_cell(worker, [&](std::int64_t i) {
        if (areas[i] == 0) to[i] = 0;
    });
}

/// The operator L for Bicgstab.
template <typename Number>
struct ConstraintSolver<Number>::System {
    ConstraintSolver& solver;
    Worker& worker;

    double dot(const Field& a, const Field& b) { return solver.dot(worker, a, b); }
    void precondition(const Field& from) { solver.precondition(worker, from); }
    void apply(Field& result) { solver.apply_linear(worker, result); }
    void each_cell(const auto& act) { solver.each_cell(worker, act); }
    void leave_if_cancelled() { worker.moment.leave_if_cancelled(); }
};

/// Improves the solution until `residual_` is small.
template <typename Number>
void ConstraintSolver<Number>::iterate(Worker& worker, Field& solution) {
    System system{*this, worker};
    Bicgstab<Number, System> iteration(system, {solution, residual_, shadow_, direction_, image_,
                                                other_image_, *problem_.unknown});
    const BicgstabOutcome outcome =
        iteration.run(tolerance<Number>,
                      stencil_ ? most_iterations_on_grids : most_iterations_on_links);
    if (worker.thread != 0) return;
    SolveReport& report = *problem_.report;
    report.most_iterations = std::max(report.most_iterations, outcome.iterations);
    report.largest_rest = std::isfinite(outcome.rest) ? std::max(report.largest_rest, outcome.rest)
                                                      : std::numeric_limits<double>::infinity();
}

/// Copies the last cell's value to the padding cells of the last row of linked cells.
template <typename Number>
void ConstraintSolver<Number>::pad(Number* cells) const {
    const std::int64_t last = outer_.counted_cells() - 1;
    const std::int64_t start = layout_.row_start(last / layout_.width);
    const std::int64_t column = last % layout_.width;
    std::fill(cells + start + column, cells + start + layout_.width, cells[start + column]);
}

template <typename Number>
void ConstraintSolver<Number>::solve(Team& team, int thread, int threads, Registers registers,
                                     const StepMoment& moment, Field& target) {
    Worker worker{team, thread, threads, registers, moment, {}, {}, {}, {}, 0, false};
    worker.rows = split_rows(layout_.row_count(), thread, threads);
    whole_.prepare(worker.whole, thread, threads);
    linear_.prepare(worker.linear, thread, threads);
    team.barrier();
    if (parts_) {
        parts_->prepare(worker.parts, thread, threads);
        std::vector<Field*> parts;
        for (const auto& part : problem_.constant) parts.push_back(part.plane.get());
        apply(worker, *parts_, worker.parts, parts);
        team.barrier();
        if (thread == 0 && outer_.has_halo()) {
            for (const auto& part : problem_.constant) part.plane->fill_halo(part.boundary);
        }
        team.barrier();
    }
    if (stencil_) find_stencil(worker);
    worker.knows_factors = stencil_ && stencil_->has_factors();
    const bool is_singular = probe(worker);
    // b is the value of e when the field is 0.
    Number* const unknown = problem_.unknown->template origin<Number>();
    Number* const x = target.origin<Number>();
    each_row(worker, [&](std::int64_t start) {
        std::fill(unknown + start, unknown + start + layout_.width, Number{0});
        std::fill(x + start, x + start + layout_.width, Number{0});
    });
    fill_halo_of_unknown(worker, false);
    apply(worker, whole_, worker.whole, {&residual_});
    Number* const r = residual_.template origin<Number>();
    const Number* const areas = areas_of_cells();
    each_cell(worker, [&](std::int64_t i) {
        r[i] = areas == nullptr || areas[i] != 0 ? -r[i] : Number{0};
    });
    // If L of a constant is 0, L u has mean 0.
    if (is_singular) {
        const double size = std::sqrt(dot(worker, residual_, residual_) /
                                      static_cast<double>(outer_.counted_cells()));
        const double all = subtract_mean(worker, residual_);
        if (thread == 0 && size > 0) {
            SolveReport& report = *problem_.report;
            report.largest_mean = std::max(report.largest_mean, std::abs(all) / size);
        }
    }
    iterate(worker, target);
    if (worker.knows_factors && thread == 0) stencil_->keep_factors();
    if (is_singular) subtract_mean(worker, target);
    team.barrier();
    if (thread == 0 && outer_.grid.linked) pad(x);
    if (thread == 0 && outer_.has_halo() && problem_.needs_halo) {
        target.fill_halo(sides_at(worker));
    }
    team.barrier();
}

template class ConstraintSolver<float>;
template class ConstraintSolver<double>;

}  // namespace cascade

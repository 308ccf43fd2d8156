// Rules of a tissue that are C++ functions of a cell, for tests. They need no script, so the time
// loop is tested without the parts of the program that make kernels.
#pragma once

#include "solvers/error_estimate.h"
#include "tissue/sense_kernel.h"
#include "tissue/tissue_loop.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <list>
#include <memory>
#include <utility>
#include <vector>

namespace cascade::test {

/// What a function of a cell may read.
class CellState {
public:
    /// `value(species, element)` is the value of a species in a cell, and `target(link)` the
    /// element of the cell at the end of a link.
    std::function<double(std::size_t species, std::int64_t element)> value;
    std::function<void(const std::function<void(std::int64_t element)>&)> each_link;
    std::array<double, 3> period{};
    std::int64_t element = 0;
    double off = 0;
    Vector3d normal;
    double t = 0;

    double own(std::size_t species) const { return value(species, element); }
    Vector3d place(std::int64_t at) const { return {value(0, at), value(1, at), value(2, at)}; }
    double radius(std::int64_t at) const { return value(3, at); }
    /// Calls `use(element, direction, distance)` for each link, with the direction to the other
    /// cell.
    void each_neighbour(const auto& use) const {
        each_link([&](std::int64_t other) {
            Vector3d way = place(other) - place(element);
            if (period[0] > 0) way.x = std::remainder(way.x, period[0]);
            if (period[1] > 0) way.y = std::remainder(way.y, period[1]);
            use(other, unit(way), length(way));
        });
    }
};

/// Writes one number for each result.
using CellRates = std::function<void(const CellState& cell, double* results)>;

/// Evaluates functions of cells in double precision and combines their results by the form of a
/// scheme.
class FunctionKernel : public Kernel {
public:
    FunctionKernel(CellRates rates, std::size_t species, SweepForm form, bool senses,
                   std::array<double, 3> period)
        : rates_(std::move(rates)),
          species_(species),
          form_(std::move(form)),
          senses_(senses),
          period_(period) {}

    void run(const KernelArgumentsOf<double>& arguments, const Patch& cells) const override {
        run_as(arguments, cells);
    }
    void run(const KernelArgumentsOf<float>& arguments, const Patch& cells) const override {
        run_as(arguments, cells);
    }

private:
    template <typename Number>
    void run_as(const KernelArgumentsOf<Number>& arguments, const Patch& cells) const {
        const PlaneLayout& layout = arguments.layout;
        const auto field = [&](std::size_t input, std::size_t species, std::int64_t at) {
            return static_cast<double>(arguments.fields[input * species_ + species][at]);
        };
        CellState state;
        state.period = period_;
        state.value = [&](std::size_t species, std::int64_t at) { return field(0, species, at); };
        state.each_link = [&](const auto& use) {
            const LinkTable<Number>& links = arguments.links;
            const std::int64_t row = state.element / layout.stride,
                               column = state.element % layout.stride;
            const std::int64_t slice = row * ((layout.width + 15) / 16) + column / 16;
            for (std::uint32_t entry = links.starts[slice]; entry < links.starts[slice + 1];
                 ++entry) {
                if ((links.filled[entry] >> column % 16 & 1) == 0) continue;
                use(links.target(16 * std::int64_t{entry} + column % 16));
            }
        };
        if (!arguments.uniforms.empty()) state.t = static_cast<double>(arguments.uniforms.back());
        std::vector<double> rates(species_);
        for (std::int64_t row = cells.rows.begin; row < cells.rows.end; ++row) {
            for (std::int64_t column = 0; column < layout.width; ++column) {
                state.element = layout.row_start(row) + column;
                if (senses_) {
                    const std::size_t first = form_.inputs * species_;
                    const auto sensed = [&](std::size_t k) {
                        return static_cast<double>(arguments.fields[first + k][state.element]);
                    };
                    state.off = sensed(0);
                    state.normal = {sensed(1), sensed(2), sensed(3)};
                }
                if (form_.uses_rates()) rates_(state, rates.data());
                for (std::size_t s = 0; s < species_; ++s) {
                    for (std::size_t o = 0; o < form_.outputs.size(); ++o) {
                        double sum = 0;
                        for (const SweepTerm& term : form_.outputs[o].terms) {
                            sum += value_of(term, rates[s], arguments, [&](std::size_t input) {
                                return field(input, s, state.element);
                            });
                        }
                        arguments.results[o * species_ + s][state.element] =
                            static_cast<Number>(sum);
                    }
                }
            }
        }
    }

    double value_of(const SweepTerm& term, double rate, const auto& arguments,
                    const auto& own) const {
        double value = rate;
        if (term.source != SweepTerm::Source::rate) value = own(term.input);
        if (term.source == SweepTerm::Source::difference) value -= own(form_.base_input);
        if (term.weight == SweepTerm::Weight::coefficient) {
            value *= static_cast<double>(arguments.uniforms[term.coefficient]);
        }
        return value;
    }

    CellRates rates_;
    std::size_t species_;
    SweepForm form_;
    bool senses_;
    std::array<double, 3> period_;
};

/// Rules whose functions are set by tests. Species 0 to 2 are the place, and species 3 is the
/// radius.
class FunctionRules : public TissueRules {
public:
    std::size_t species = 4;
    Solver solver = Solver::rkl2;
    bool is_judged = true;
    CellRates rate = [](const CellState&, double*) {};  ///< The rates of all species.
    std::size_t condition_planes = 0;
    CellRates condition = {};      ///< The conditions for dividing and for dying.
    bool is_of_cell_alone = true;  ///< Whether the conditions read only the cell itself.
    std::size_t restarted_from = 0;
    CellRates restart = {};  ///< New values of the species from `restarted_from` on.
    CellRates direction = {};
    std::shared_ptr<const Surroundings> surroundings = in_box({2, 2, 2}, {});
    std::shared_ptr<NearTriangles> triangles = std::make_shared<NearTriangles>();
    bool senses = false;
    int binds = 0;

    void bind(const Tissue& tissue, const Links& links) override {
        ++binds;
        tissue_ = &tissue;
        links_ = &links;
        problems_.clear();
        rates_problem_ = conditions_ = restarts_ = along_ = nullptr;
    }
    TissueStep step(std::uint32_t stages) override {
        Scheme scheme = make_scheme(solver, static_cast<std::uint32_t>(species), false, stages);
        if (is_judged && !is_adaptive(solver)) scheme = with_error_estimate(std::move(scheme));
        return {&bound(scheme), state_registers(scheme)};
    }
    CellValues rates() override { return {values(rates_problem_, all_rates(), species), species}; }
    Conditions conditions() override {
        Conditions result;
        if (!condition) return result;
        result.values = {values(conditions_, condition, condition_planes), condition_planes,
                         is_of_cell_alone};
        result.divide = 0;
        if (condition_planes > 1) result.die = 1;
        return result;
    }
    CellValues along() override {
        if (!direction) return {};
        return {values(along_, direction, 3), 3};
    }
    Restarts restarts() override {
        Restarts result;
        if (!restart) return result;
        const std::size_t count = species - restarted_from;
        result.values = {values(restarts_, restart, count), count};
        for (std::size_t k = restarted_from; k < species; ++k) result.species.push_back(k);
        return result;
    }

private:
    using SpeciesPlane = StepProblem::SpeciesPlane;

    CellRates all_rates() const {
        return [this](const CellState& cell, double* results) {
            std::fill(results, results + species, 0.0);
            rate(cell, results);
        };
    }

    StepProblem empty_problem() const {
        StepProblem problem;
        problem.grid = tissue_->grid();
        problem.links = links_;
        problem.precision = tissue_->precision();
        problem.species_needs_halo.assign(species, false);
        return problem;
    }

    void sense(StepProblem& problem, RegisterId state) const {
        if (!senses) return;
        problem.temporaries = 4;
        StepProblem::Pass pass;
        pass.kernel = make_sense_kernel(surroundings,
                                        {{Sense::Kind::off},
                                         {Sense::Kind::normal_x},
                                         {Sense::Kind::normal_y},
                                         {Sense::Kind::normal_z}},
                                        triangles);
        for (std::uint32_t k = 0; k < 3; ++k)
            pass.fields.push_back(SpeciesPlane{SpeciesId(k), state});
        for (std::uint32_t k = 0; k < 4; ++k) pass.results.push_back({TemporaryId(k)});
        problem.passes.push_back(std::move(pass));
    }
    void read_sensed(StepProblem::Pass& pass) const {
        for (std::uint32_t k = 0; senses && k < 4; ++k) pass.fields.push_back(TemporaryId(k));
    }

    const StepProblem& bound(const Scheme& scheme) {
        StepProblem problem = empty_problem();
        problem.registers = scheme.registers;
        problem.error_register = scheme.error_register;
        problem.rate_registers = scheme.rate_registers;
        for (const Sweep& sweep : scheme.sweeps) {
            const SweepForm& form = scheme.forms[sweep.form];
            sense(problem, sweep.inputs[0]);
            StepProblem::Pass pass;
            pass.kernel = std::make_shared<FunctionKernel>(all_rates(), species, form, senses,
                                                           surroundings->period());
            for (const RegisterId input : sweep.inputs) {
                for (std::size_t s = 0; s < species; ++s) {
                    pass.fields.push_back(SpeciesPlane{SpeciesId(s), input});
                }
            }
            read_sensed(pass);
            for (const RegisterId output : sweep.outputs) {
                for (std::size_t s = 0; s < species; ++s) {
                    pass.results.push_back({SpeciesPlane{SpeciesId(s), output}});
                }
            }
            std::uint32_t slot = 0;
            for (const Sweep::Coefficient& coefficient : sweep.coefficients) {
                pass.changing.push_back({UniformSlot(slot++), coefficient});
            }
            pass.changing.push_back({UniformSlot(slot++), StepProblem::MomentAt{sweep.time}});
            pass.uniforms.assign(slot, 0);
            problem.passes.push_back(std::move(pass));
            if (problem.rate_registers && &sweep == &scheme.sweeps[0]) {
                problem.first_rate_passes = problem.passes.size();
            }
        }
        return problems_.emplace_back(std::move(problem));
    }

    /// A problem that writes the results of a function to register 1.
    const StepProblem* values(const StepProblem*& known, const CellRates& function,
                              std::size_t count) {
        if (known != nullptr) return known;
        StepProblem problem = empty_problem();
        sense(problem, old_register);
        StepProblem::Pass pass;
        pass.kernel = std::make_shared<FunctionKernel>(function, species, rate_form(), senses,
                                                       surroundings->period());
        for (std::size_t s = 0; s < species; ++s) {
            pass.fields.push_back(SpeciesPlane{SpeciesId(s), old_register});
        }
        read_sensed(pass);
        // The kernel writes as many results as there are species.
        problem.temporaries = 4 + static_cast<std::uint32_t>(species);
        for (std::uint32_t s = 0; s < species; ++s) {
            if (s < count) {
                pass.results.push_back({SpeciesPlane{SpeciesId(s), new_register}});
            } else {
                pass.results.push_back({TemporaryId(4 + s)});
            }
        }
        problem.passes.push_back(std::move(pass));
        return known = &problems_.emplace_back(std::move(problem));
    }
    const Tissue* tissue_ = nullptr;
    const Links* links_ = nullptr;
    std::list<StepProblem> problems_;
    const StepProblem *rates_problem_ = nullptr, *conditions_ = nullptr, *restarts_ = nullptr,
                      *along_ = nullptr;
};

/// Cells at these places with equal radii. All other species are 0.
inline TissueRecord cells_at(const std::vector<Vector3d>& places, double radius,
                             std::size_t species) {
    TissueRecord record;
    record.species.assign(species, std::vector<double>(places.size(), 0));
    for (std::size_t k = 0; k < places.size(); ++k) {
        record.numbers.push_back(static_cast<std::uint32_t>(k));
        record.species[0][k] = places[k].x;
        record.species[1][k] = places[k].y;
        record.species[2][k] = places[k].z;
        record.species[3][k] = radius;
    }
    record.next_number = static_cast<std::uint32_t>(places.size());
    return record;
}

/// Adds the rates of a cell's place by collisions: −k Σ overlap · direction.
inline void push(const CellState& cell, double k, double* rates) {
    cell.each_neighbour([&](std::int64_t other, Vector3d direction, double distance) {
        const double overlap =
            std::max(0.0, cell.radius(cell.element) + cell.radius(other) - distance);
        rates[0] -= k * overlap * direction.x;
        rates[1] -= k * overlap * direction.y;
        rates[2] -= k * overlap * direction.z;
    });
}

/// A tissue with its time loop.
class Growth {
public:
    Growth(FunctionRules& rules, const TissueRecord& record, TissueSchedule schedule,
           Precision precision = Precision::binary64)
        : tissue_(record, precision),
          loop_(rules, *rules.surroundings, tissue_, rules.triangles, {}, with(rules, schedule),
                {}) {}

    TissueOutcome go(std::int64_t steps = 1'000'000, const TissueObserver& observe = {}) {
        return loop_.advance(steps, observe ? 1 : 0, control, observe);
    }
    RunControl control;
    Tissue& tissue() { return tissue_; }
    Vector3d place(std::size_t cell) const { return place_of(tissue_, {}, cell); }

private:
    static TissueSchedule with(const FunctionRules& rules, TissueSchedule schedule) {
        schedule.solver = rules.solver;
        if (!rules.is_judged) schedule.tolerance = 0;
        return schedule;
    }
    Tissue tissue_;
    TissueLoop loop_;
};

inline void expect_equal_records(const TissueRecord& a, const TissueRecord& b) {
    EXPECT_TRUE(a.numbers == b.numbers);
    EXPECT_TRUE(a.species == b.species);
    EXPECT_TRUE(a.stiffest == b.stiffest);
    EXPECT_TRUE(a.triangles == b.triangles);
    EXPECT_EQ(a.next_number, b.next_number);
    EXPECT_EQ(a.births, b.births);
    EXPECT_EQ(a.deaths, b.deaths);
    EXPECT_EQ(a.time.t, b.time.t);
    EXPECT_EQ(a.time.steps, b.time.steps);
    EXPECT_EQ(a.time.control.step, b.time.control.step);
    EXPECT_EQ(a.time.control.error_before, b.time.control.error_before);
    EXPECT_EQ(a.time.stiffness, b.time.stiffness);
    EXPECT_EQ(a.time.last_event, b.time.last_event);
    EXPECT_EQ(a.time.progress, b.time.progress);
}

}  // namespace cascade::test

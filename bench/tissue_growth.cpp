// The case `growth` of cascade_tissue_bench: on a torus, 6 founders divide until 3,200 cells cover
// it, on one core. Includes everything that a stage of cells does.
#include "ir/expression.h"
#include "jit/jit.h"
#include "mesh/shapes.h"
#include "solvers/error_estimate.h"
#include "tissue/founders.h"
#include "tissue/sense_kernel.h"
#include "tissue/tissue_loop.h"

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <list>
#include <memory>
#include <string>
#include <vector>

namespace cascade::bench {
namespace {

/// Species are the position, the radius, and the ripeness of a cell, which divides if ripeness is
/// above 1.
constexpr std::uint32_t species = 5, senses = 4, ripe = 4;
constexpr double radius = 0.0136, reach = 1.2, stiffness = 10, hold = 4;

using SpeciesPlane = StepProblem::SpeciesPlane;

/// Cells push each other away, stay at the surface, and ripen where there is room.
class GrowingCells : public TissueRules {
public:
    GrowingCells(std::shared_ptr<const Surroundings> around,
                 std::shared_ptr<NearTriangles> triangles)
        : sense_(make_sense_kernel(std::move(around),
                                   {{Sense::Kind::off},
                                    {Sense::Kind::normal_x},
                                    {Sense::Kind::normal_y},
                                    {Sense::Kind::normal_z}},
                                   std::move(triangles))),
          jit_(*make_jit({0, 2})) {}

    void bind(const Tissue& tissue, const Links& links) override {
        tissue_ = &tissue;
        links_ = &links;
        problems_.clear();
        rates_ = conditions_ = restarts_ = nullptr;
    }

    TissueStep step(std::uint32_t stages) override {
        const Scheme scheme = make_scheme(Solver::rkl2, species, false, stages);
        const Scheme judged = scheme.error_register ? scheme : with_error_estimate(scheme);
        StepProblem problem = empty_problem();
        problem.registers = judged.registers;
        problem.error_register = judged.error_register;
        problem.rate_registers = judged.rate_registers;
        for (const Sweep& sweep : judged.sweeps) {
            const SweepForm& form = judged.forms[sweep.form];
            if (form.uses_rates()) add_sense(problem, sweep.inputs[0]);
            StepProblem::Pass pass;
            pass.kernel = kernel_of(form);
            for (const RegisterId input : sweep.inputs) read_species(pass, input);
            read_sensed(pass);
            for (const RegisterId output : sweep.outputs) {
                for (std::uint32_t s = 0; s < species; ++s) {
                    pass.results.push_back({SpeciesPlane{SpeciesId(s), output}});
                }
            }
            std::uint32_t slot = 0;
            for (const Sweep::Coefficient& coefficient : sweep.coefficients) {
                pass.changing.push_back({UniformSlot(slot++), coefficient});
            }
            pass.uniforms.assign(slot, 0);
            problem.passes.push_back(std::move(pass));
            if (problem.rate_registers && &sweep == &judged.sweeps[0]) {
                problem.first_rate_passes = problem.passes.size();
            }
        }
        return {&problems_.emplace_back(std::move(problem)), state_registers(judged)};
    }

    CellValues rates() override {
        return {values(rates_, kernel_of(rate_form()), species), species};
    }
    Conditions conditions() override {
        if (!margins_)
            margins_ = compiled([](Kit& kit) {
                kit.b.result("divide", (kit.own(0, ripe) - 1.0).id());
                kit.b.result("die", (kit.sensed(0).absolute() - kit.own(0, 3) * 0.5).id());
            });
        return {{values(conditions_, margins_, 2), 2, true}, 0, 1};
    }
    CellValues along() override { return {}; }
    Restarts restarts() override {
        if (!zero_) zero_ = compiled([](Kit& kit) { kit.b.result("ripe", kit.b.number(0)); });
        return {{values(restarts_, zero_, 1), 1}, {ripe}};
    }

private:
    /// A kernel under construction. Its fields are the species of each input and the values that
    /// cells sense.
    struct Kit {
        explicit Kit(std::uint32_t inputs) {
            for (std::uint32_t k = 0; k < inputs * species + senses; ++k) {
                slots.push_back(b.field_slot("field " + std::to_string(k)));
            }
        }
        Expression own(std::uint32_t input, std::uint32_t s) {
            return {b, b.field(slots[input * species + s])};
        }
        Expression theirs(std::uint32_t s) { return {b, b.theirs(slots[s])}; }
        Expression sensed(std::uint32_t k) {
            return {b, b.field(slots[slots.size() - senses + k])};
        }
        Expression sum(Expression of_link) { return {b, b.link_sum(of_link.id())}; }

        KernelBuilder b;
        std::vector<FieldSlot> slots;
    };

    static std::vector<Expression> rates_of(Kit& kit) {
        const Expression dx = kit.theirs(0) - kit.own(0, 0), dy = kit.theirs(1) - kit.own(0, 1),
                         dz = kit.theirs(2) - kit.own(0, 2);
        const Expression distance = (dx * dx + dy * dy + dz * dz).unary(Op::square_root);
        const Expression both = kit.own(0, 3) + kit.theirs(3), gap = distance - both;
        const Expression none = both.number(0);
        const Expression push = (gap < 0.0).choose(gap * stiffness / distance, none);
        const Expression contact = (1.0 - gap / (both * (reach - 1))).clamped(0, 1);
        const Expression cling = kit.sensed(0) * -hold;
        const Expression room = 2.6 - kit.sum((distance < both * reach).choose(contact, none));
        const Expression more{kit.b, kit.b.hyperbolic_tangent(room.id())};
        return {kit.sum(push * dx) + cling * kit.sensed(1),
                kit.sum(push * dy) + cling * kit.sensed(2),
                kit.sum(push * dz) + cling * kit.sensed(3), none,
                (more + 1.0) * 2.0 - kit.own(0, ripe)};
    }

    KernelPointer compiled(const auto& write, std::uint32_t inputs = 1) {
        Kit kit(inputs);
        write(kit);
        auto kernel = jit_->compile(std::move(kit.b).finish(), Stencil::linked);
        if (!kernel) std::abort();
        return *kernel;
    }

    KernelPointer kernel_of(const SweepForm& form) {
        for (const auto& [known, kernel] : kernels_) {
            if (known == form) return kernel;
        }
        const auto write = [&](Kit& kit) {
            std::vector<Expression> rates, weights;
            if (form.uses_rates()) rates = rates_of(kit);
            for (std::uint32_t k = 0; k < form.coefficients; ++k) {
                const UniformSlot slot = kit.b.uniform_slot("weight " + std::to_string(k));
                weights.push_back({kit.b, kit.b.uniform(slot)});
            }
            const auto value_of = [&](const SweepTerm& term, std::uint32_t s) {
                using Source = SweepTerm::Source;
                Expression value = term.source == Source::rate ? rates[s] : kit.own(term.input, s);
                if (term.source == Source::difference) {
                    value = value - kit.own(form.base_input, s);
                }
                const bool is_weighted = term.weight == SweepTerm::Weight::coefficient;
                return is_weighted ? value * weights[term.coefficient] : value;
            };
            for (std::size_t o = 0; o < form.outputs.size(); ++o) {
                const std::vector<SweepTerm>& terms = form.outputs[o].terms;
                for (std::uint32_t s = 0; s < species; ++s) {
                    Expression sum = value_of(terms[0], s);
                    for (std::size_t k = 1; k < terms.size(); ++k) {
                        sum = sum + value_of(terms[k], s);
                    }
                    kit.b.result(std::to_string(o) + " " + std::to_string(s), sum.id());
                }
            }
        };
        return kernels_.emplace_back(form, compiled(write, form.inputs)).second;
    }

    StepProblem empty_problem() const {
        StepProblem problem;
        problem.grid = tissue_->grid();
        problem.links = links_;
        problem.temporaries = senses;
        problem.species_needs_halo.assign(species, false);
        return problem;
    }
    void add_sense(StepProblem& problem, RegisterId state) const {
        StepProblem::Pass pass;
        pass.kernel = sense_;
        for (std::uint32_t k = 0; k < 3; ++k) {
            pass.fields.push_back(SpeciesPlane{SpeciesId(k), state});
        }
        for (std::uint32_t k = 0; k < senses; ++k) pass.results.push_back({TemporaryId(k)});
        problem.passes.push_back(std::move(pass));
    }
    static void read_species(StepProblem::Pass& pass, RegisterId state) {
        for (std::uint32_t s = 0; s < species; ++s) {
            pass.fields.push_back(SpeciesPlane{SpeciesId(s), state});
        }
    }
    static void read_sensed(StepProblem::Pass& pass) {
        for (std::uint32_t k = 0; k < senses; ++k) pass.fields.push_back(TemporaryId(k));
    }
    const StepProblem* values(const StepProblem*& known, const KernelPointer& kernel,
                              std::uint32_t count) {
        if (known != nullptr) return known;
        StepProblem problem = empty_problem();
        add_sense(problem, old_register);
        StepProblem::Pass pass;
        pass.kernel = kernel;
        read_species(pass, old_register);
        read_sensed(pass);
        for (std::uint32_t k = 0; k < count; ++k) {
            pass.results.push_back({SpeciesPlane{SpeciesId(k), new_register}});
        }
        problem.passes.push_back(std::move(pass));
        return known = &problems_.emplace_back(std::move(problem));
    }

    KernelPointer sense_;
    std::unique_ptr<Backend> jit_;
    std::list<std::pair<SweepForm, KernelPointer>> kernels_;
    KernelPointer margins_, zero_;
    const Tissue* tissue_ = nullptr;
    const Links* links_ = nullptr;
    std::list<StepProblem> problems_;
    const StepProblem *rates_ = nullptr, *conditions_ = nullptr, *restarts_ = nullptr;
};

void growth(benchmark::State& state) {
    const SurfaceMesh mesh = *torus_mesh(0.35, 0.15, 0.01);
    const std::shared_ptr<const Surroundings> around = around_surface(mesh);
    const auto triangles = std::make_shared<NearTriangles>();
    GrowingCells rules(around, triangles);
    for (auto unused : state) {
        TissueRecord founders;
        founders.species.resize(species);
        const std::vector<NearPlace> places = *random_founders(*around, 6, 1, 0);
        for (const NearPlace& founder : places) {
            const Vector3d p = founder.position;
            const std::array<double, species> values{p.x, p.y, p.z, radius, 0};
            for (std::uint32_t s = 0; s < species; ++s) founders.species[s].push_back(values[s]);
            founders.triangles.push_back(founder.place.triangle);
            founders.numbers.push_back(founders.next_number++);
        }
        Tissue tissue(founders, Precision::single);
        TissueSchedule schedule;
        schedule.end_time = 40;
        TissueLoop loop(rules, *around, tissue, triangles, {}, schedule, {});
        RunControl control;
        const TissueOutcome outcome = loop.advance(1'000'000, 0, control, {});
        if (outcome.failure) state.SkipWithError("the tissue failed");
        state.counters["cells"] = static_cast<double>(tissue.count());
        state.counters["steps"] = static_cast<double>(outcome.steps);
        state.counters["lists"] = static_cast<double>(outcome.list_builds);
    }
}

BENCHMARK(growth)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
}  // namespace cascade::bench

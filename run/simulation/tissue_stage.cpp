// Cells get their positions first. All other values are computed from the positions and from
// earlier stages.
#include "run/simulation/tissue_stage.h"

#include "core/counted_cells.h"
#include "lang/calculus/algebra.h"
#include "lang/program/stage_kinds.h"
#include "run/domain/field_values.h"
#include "run/domain/free_memory.h"
#include "run/simulation/stage_start.h"
#include "run/stage/plan_runner.h"
#include "run/tissue/grown_body.h"
#include "tissue/founders.h"
#include "tissue/random_direction.h"
#include "tissue/tissue.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <numeric>
#include <utility>
#include <variant>

namespace cascade {

namespace {

/// Returns the surroundings of a stage's cells. If the stage has a body, grows it. Otherwise they
/// are the model or plane for a stage with founders, and the surroundings of the previous stage of
/// cells for any other stage.
Result<std::shared_ptr<const TissueGround>> ground_of(const Environment& here,
                                                      std::span<const StageState> states,
                                                      std::uint32_t k,
                                                      const std::atomic<bool>& cancel) {
    const Stage& stage = here.stage(k);
    if (stage.body.nodes.empty()) {
        if (stage.founders) return here.crawling->ground;
        return states[*stage_of_cells_before(*here.program, k)].ground();
    }
    std::uint32_t last = 0;  // The last stage that the body's formula reads.
    for (const Node& node : stage.body.nodes) {
        if (const auto* item = node.as<StageItem>()) last = std::max(last, item->stage);
    }
    const std::vector<Field> values = StageView(here, states, last).evaluate(stage.body);
    if (const double most = largest_value(values[0], here.inside()); most <= 0) {
        return failure(fmt::format("the body of stage '{}' is empty: its formula is at most {:.4g}",
                                   stage.name, most),
                       "cells lie where the formula of the body becomes larger than 0");
    }
    auto body = grown_body(values[0], here.grid.boundary, cancel);
    if (cancel) {
        return failure(fmt::format("stopped while the body of stage '{}' was made", stage.name));
    }
    if (!body) {
        return failure(fmt::format("the body of stage '{}': {}", stage.name, body.error().message),
                       "its triangles are as large as the cells of the grid");
    }
    return std::make_shared<TissueGround>(here.grid, *std::move(body));
}

/// Draws a random number from 0 to 1 for a cell, which is the angle of a random direction in a
/// plane, divided by 2π.
double uniform_of(std::uint32_t seed, std::uint32_t stage, std::uint32_t number) {
    const Vector3d direction = random_direction({seed, stage, number, ~number}, {0, 0, 1});
    return std::atan2(direction.y, direction.x) / (2 * std::numbers::pi) + 0.5;
}

/// Starts one stage of cells.
class TissueStart {
public:
    TissueStart(const Environment& environment, std::span<StageState> states, std::uint32_t k)
        : here_(environment),
          states_(states),
          k_(k),
          view_(environment, states, k),
          state_(states[k]),
          stage_(tissue_stage(environment, states, k)) {}

    Result<void> run() {
        start_uniform_items(view_, state_);
        const bool founds = view_.stage().founders.has_value();
        if (auto made = founds ? found() : go_on(); !made) return made;
        if (auto good = evaluate_items(); !good) return good;
        return leave_out(
            view_.stage().remove, [](double value, std::size_t) { return value != 0; },
            "'remove' takes all cells");
    }

private:
    Tissue& tissue() { return *state_.tissue(); }

    void make_tissue(TissueRecord record) {
        std::get<TissueState>(state_.values).tissue =
            std::make_shared<Tissue>(blank(std::move(record)), here_.precision());
    }

    /// Returns a copy of a record with the same cells, all values 0, and no history.
    TissueRecord blank(TissueRecord record) const {
        record.species.assign(view_.system().species_count(),
                              std::vector<double>(record.numbers.size()));
        record.stiffest.clear();
        record.kept.assign(view_.system().item_count(), {});
        record.frozen.reset();
        record.births = record.deaths = 0;
        record.time = {};
        return record;
    }

    Result<void> found() {
        const Founders& founders = *view_.stage().founders;
        const std::size_t most = most_cells_in_memory(view_.system(), here_.precision());
        if (static_cast<std::uint64_t>(founders.count) > most) {
            return failure(
                fmt::format("stage '{}' would start with {} cells, but there is memory only for {}",
                            view_.stage().name, founders.count, most),
                "start with fewer founders, which can divide until there are enough cells");
        }
        std::vector<NearPlace> places;
        if (founders.places.empty()) {
            auto found = random_founders(*state_.ground()->surroundings(),
                                         static_cast<std::size_t>(founders.count),
                                         here_.program->domain.seed, k_);
            if (!found) return tl::unexpected(found.error());
            places = std::move(*found);
        } else {
            std::vector<Vector3d> wanted;
            for (std::size_t k = 0; k + 2 < founders.places.size(); k += 3) {
                wanted.push_back(
                    {founders.places[k], founders.places[k + 1], founders.places[k + 2]});
            }
            places = founders_at(*state_.ground()->surroundings(), wanted);
        }
        place(places);
        // All positions are chosen before some of them are left out by chance. So position k does
        // not depend on which positions are left out.
        const auto is_left_out = [&](double chance, std::size_t cell) {
            return !(uniform_of(here_.program->domain.seed, k_, tissue().numbers()[cell]) < chance);
        };
        return leave_out(founders.chance, is_left_out, "the chance accepts no founder");
    }

    /// Makes a cell at each position.
    void place(std::span<const NearPlace> places) {
        TissueRecord record;
        record.numbers.resize(places.size());
        std::iota(record.numbers.begin(), record.numbers.end(), std::uint32_t{0});
        for (const NearPlace& each : places) record.triangles.push_back(each.place.triangle);
        record.next_number = static_cast<std::uint32_t>(places.size());
        make_tissue(std::move(record));
        for (std::size_t cell = 0; cell < places.size(); ++cell) {
            const Vector3d& at = places[cell].position;
            const std::array components{at.x, at.y, at.z};
            for (std::size_t k = 0; k < 3; ++k) {
                tissue().set(stage_.species_of(stage_.rules().place, k).index(), cell,
                             components[k]);
            }
        }
        tissue().pad();
    }

    /// Takes over the cells of the previous stage in the same order, so that values can be read
    /// cell by cell.
    Result<void> go_on() {
        const auto before = stage_of_cells_before(view_.program(), k_);
        CHECK(before && states_[*before].tissue(), "the checker knows which cells go on");
        Tissue& earlier = *states_[*before].tissue();
        TissueRecord record = earlier.record();
        earlier = Tissue(record, here_.precision());
        make_tissue(std::move(record));
        const ItemId place = here_.program->system_of(*before).cells->place;
        for (std::uint32_t k = 0; k < 3; ++k) {
            tissue().species[stage_.species_of(stage_.rules().place, k).index()] =
                states_[*before].field(ItemId(place.index() + k)).clone();
        }
        return {};
    }

    Result<std::vector<Field>> evaluate(const StepPlan& plan) {
        return evaluate_in(tissue(), plan, stage_, neighbours_of(stage_, 0),
                           here_.crawling->kernels.once(), here_.team);
    }

    Result<void> evaluate_items() {
        const StepPlan& plan = here_.plans.start(k_);
        auto values = evaluate(plan);
        if (!values) return tl::unexpected(values.error());
        take_values(state_, view_.program(), k_, plan.results, *values);
        return {};
    }

    /// Removes each cell for which `is_left_out`, called with the formula's value in that cell,
    /// returns true. Does nothing if the formula is empty.
    Result<void> leave_out(const Formula& formula, const auto& is_left_out, const char* why) {
        if (formula.nodes.empty()) return {};
        const Formula* const formulas[] = {&formula};
        auto values = evaluate(plan_view(view_.program(), formulas, k_));
        if (!values) return tl::unexpected(values.error());
        std::vector<std::uint32_t> left;
        for (std::size_t cell = 0; cell < tissue().count(); ++cell) {
            const double value = (*values)[0].visit([&](const auto& plane) {
                return static_cast<double>(plane.origin()[tissue().element(cell)]);
            });
            if (!is_left_out(value, cell)) left.push_back(static_cast<std::uint32_t>(cell));
        }
        if (left.empty()) {
            return failure(
                fmt::format("stage '{}' starts without cells: {}", view_.stage().name, why));
        }
        tissue().rearrange(left);
        return {};
    }

    const Environment& here_;
    std::span<StageState> states_;
    std::uint32_t k_;
    StageView view_;
    StageState& state_;
    TissueStage stage_;
};

/// Whether a plan reads the cells of an earlier stage.
bool reads_earlier_cells(const StepPlan& plan, std::uint32_t stage) {
    const auto is_earlier = [stage](const PlaneSource& source) {
        const auto* const item = std::get_if<StageItem>(&source);
        return item != nullptr && item->stage != stage;
    };
    return std::ranges::any_of(plan.passes, [&](const Pass& pass) {
        return std::ranges::any_of(pass.bound.fields, is_earlier);
    });
}

}  // namespace

TissueStage tissue_stage(const Environment& environment, std::span<const StageState> states,
                         std::uint32_t stage) {
    const StageView view(environment, states, stage);
    return {*environment.program, stage, *states[stage].ground(), view.context()};
}

std::size_t most_cells_in_memory(const System& system, Precision precision) {
    // The bytes of a cell: the planes of all registers, and the lists of neighbours.
    constexpr std::uint64_t registers = 12, bytes_of_lists = 600;
    const std::uint64_t each =
        registers * system.species_count() * bytes_of(precision) + bytes_of_lists;
    constexpr std::uint64_t most = 100'000'000;
    const std::uint64_t free = available_memory();
    return free > 0 ? std::min(most, free / each) : most;
}

double widest_near(const StageView& view, std::span<const Formula* const> others) {
    double widest = 0;
    std::vector<Formula> distances = view.system().cells->near;
    for (const Formula* other : others) {
        std::ranges::move(near_distances(*other), std::back_inserter(distances));
    }
    for (const Formula& distance : distances) {
        const Formula* const formulas[] = {&distance};
        const Grid one{1, 1, Boundary::periodic};
        const Environment& here = view.environment();
        const StepPlan plan = plan_view(view.program(), formulas, view.number());
        const std::vector<Field> value =
            run_plan(plan, here.kernels.interpreted_on(one), view.context(), one, here.team);
        widest = std::max(widest, value[0].number_at(0, 0));
    }
    return widest;
}

std::vector<Field> evaluate_in_cells(const StageView& view, const StepPlan& plan,
                                     std::span<const Formula* const> formulas) {
    const Environment& here = view.environment();
    const Tissue& tissue = *view.state().tissue();
    const TissueStage stage{view.program(), view.number(), *view.state().ground(), view.context()};
    const double widest = widest_near(view, formulas);
    auto values = evaluate_in(tissue, plan, stage, neighbours_of(stage, widest),
                              here.crawling->kernels.once(), here.team);
    if (values) return std::move(*values);
    std::vector<Field> undefined;
    for (std::uint32_t k = 0; k < plan.result_count; ++k) {
        Field& field = undefined.emplace_back(tissue.layout(), tissue.precision());
        field.visit([](auto& plane) { for_each_cell([](auto& value) { value = NAN; }, plane); });
    }
    return undefined;
}

std::shared_ptr<const SurfaceMesh> body_under_cells(const StageState& state) {
    const auto ground = state.ground();
    return ground ? ground->body() : nullptr;
}

Result<void> start_tissue(const Environment& environment, std::span<StageState> states,
                          std::uint32_t stage, const std::atomic<bool>& cancel) {
    const TimeAccount::Scope spent(environment.account, Spent::starting, stage);
    auto ground = ground_of(environment, states, stage, cancel);
    if (!ground) return tl::unexpected(ground.error());
    states[stage] = empty_state(environment.program->system_of(stage));
    states[stage].values = TissueState{std::move(*ground), nullptr};
    auto started = TissueStart(environment, states, stage).run();
    if (started) states[stage].started = true;
    return started;
}

std::vector<std::vector<double>> values_of_start(const StageView& view) {
    const Environment& here = view.environment();
    const std::uint32_t k = view.number();
    const Tissue& tissue = *view.state().tissue();
    const StepPlan& plan = here.plans.start(k);
    if (tissue.count() == 0 || reads_earlier_cells(plan, k)) return {};
    const TissueStage stage = tissue_stage(here, view.states(), k);
    const auto values = evaluate_in(tissue, plan, stage, neighbours_of(stage, 0),
                                    here.crawling->kernels.once(), here.team);
    if (!values) return {};
    std::vector<std::vector<double>> by_item(view.system().item_count());
    for (std::size_t r = 0; r < values->size(); ++r) {
        const ItemId item = plan.results[r];
        if (view.stage().uniform[item]) continue;
        for (const std::uint32_t cell : tissue.by_number()) {
            by_item[item.index()].push_back(value_in((*values)[r], tissue, cell));
        }
    }
    return by_item;
}

std::size_t remove_cells(Tissue& tissue, const Field& chosen) {
    std::vector<std::uint32_t> left;
    for (std::uint32_t cell = 0; cell < tissue.count(); ++cell) {
        if (value_in(chosen, tissue, cell) == 0) left.push_back(cell);
    }
    if (!left.empty()) tissue.rearrange(left);
    return left.size();
}

}  // namespace cascade

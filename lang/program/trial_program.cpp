// Makes the trial program by replacing the formulas that need the script's domain or the patterns
// of other stages.
#include "lang/program/trial_program.h"

#include "lang/program/nodes_of_rates.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace cascade {

namespace {

Formula number(double value) { return {{Node{value}}}; }

/// Whether the node depends on the cell's position in the domain.
bool is_of_place(const Node& node) {
    if (const auto* builtin = node.as<Builtin>()) return !is_moment(node) && *builtin >= Builtin::x;
    if (node.is<SurfaceValueId>()) return true;
    if (!node.is<Call>()) return false;
    const FunctionKind kind = info(node.function).kind;
    return kind == FunctionKind::shape || kind == FunctionKind::pattern ||
           kind == FunctionKind::text || kind == FunctionKind::landmarks;
}

/// Whether the node needs a file or the surface of a model. A trial run has neither.
bool is_of_domain_alone(const Node& node) {
    return node.is<TextId>() || node.is<SurfaceValueId>() ||
           (node.is<Call>() && (reads_file(node.function) || needs_model(node.function)));
}

bool differentiates_or_sums(const Node& node) {
    return node.is<Call>() &&
           (differentiates(node.function) || is_nonlocal(node) || is_aggregate(node));
}

class TrialMaker {
public:
    TrialMaker(const Program& program, std::uint32_t stage)
        : program_(program), number_(stage), trial_(program) {}

    tl::expected<Program, SizeObstacle> make() {
        const Stage& stage = program_.stages[number_];
        const System& system = program_.system_of(number_);
        const Span size = stage.size->span;
        const auto has_length = [](const Node& node) {
            return node.is<Call>() && (differentiates(node.function) || is_nonlocal(node));
        };
        if (!holds_in_rates(system, has_length)) {
            return obstacle(size,
                            fmt::format("'size' cannot be used, because no rate of {} reads "
                                        "neighbouring cells",
                                        system.name),
                            "'size' sets the wavelength of a pattern, which only forms between "
                            "neighbouring cells");
        }
        if (holds_in_rates(system, is_of_place) || holds_in_rates(system, is_of_domain_alone)) {
            return obstacle(
                size,
                fmt::format("'size' cannot be used, because the equations of {} depend on the "
                            "position",
                            system.name),
                "with 'size', equations must be the same everywhere");
        }
        if (has_kernel_of_file()) {
            return obstacle(size,
                            fmt::format("'size' cannot be used, because a convolution of {} has a "
                                        "kernel from a file",
                                        system.name),
                            "with 'size', kernels must be formulas");
        }
        trial_.stages.resize(number_ + 1);
        trial_.stages[number_].time.every = 0;
        make_domain();
        for (std::uint32_t k = 0; k < number_; ++k) make_earlier(k);
        if (auto made = make_items(); !made) return tl::unexpected(made.error());
        make_stage();
        return std::move(trial_);
    }

private:
    static tl::unexpected<SizeObstacle> obstacle(Span span, std::string message, std::string hint) {
        return tl::unexpected<SizeObstacle>({span, std::move(message), std::move(hint)});
    }

    bool has_kernel_of_file() const {
        bool found = false;
        for_each_kernel_of_stage(program_, number_, [&](const ConvolutionKernel& kernel) {
            found = found || holds_in(kernel.weight, is_of_domain_alone);
        });
        return found;
    }

    void make_domain() {
        DomainSettings& domain = trial_.domain;
        domain.model.reset();
        domain.surface.reset();
        domain.mask.reset();
        domain.sides = {};
        domain.grid.linked = false;
        domain.grid.boundary = Boundary::periodic;
        domain.seed = 1;
        domain.precision = Precision::single;
        domain.fast = false;
    }

    /// The first node that makes the value of a parameter depend on positions or on an earlier
    /// pattern. Null if the value can be computed on any plane.
    const Node* hindrance(const Formula& formula) const {
        const auto found = std::ranges::find_if(formula.nodes, [&](const Node& node) {
            if (is_of_place(node) || is_of_domain_alone(node) || differentiates_or_sums(node)) {
                return true;
            }
            const auto* read = node.as<StageItem>();
            return node.is<SensedItem>() || (read != nullptr && is_hindered(*read));
        });
        return found == formula.nodes.end() ? nullptr : &*found;
    }

    /// Whether the value of this item of an earlier stage is unknown. Only parameters of a stage
    /// are known before it has run.
    bool is_hindered(const StageItem& read) const {
        const System& system = program_.system_of(read.stage);
        return system.cells || read.item >= system.frozen_item() || system.is_species(read.item) ||
               hindrance(program_.stages[read.stage].items[read.item]) != nullptr;
    }

    /// Whether a species can start with this formula. The formula may depend on positions if it has
    /// a meaning on every plane.
    bool can_start(const Formula& formula) const {
        return std::ranges::none_of(formula.nodes, [&](const Node& node) {
            const auto* read = node.as<StageItem>();
            const auto* builtin = node.as<Builtin>();
            return is_of_domain_alone(node) || differentiates_or_sums(node) ||
                   node.is<SensedItem>() || (builtin != nullptr && is_of_model(*builtin)) ||
                   (read != nullptr && is_hindered(*read));
        });
    }

    void make_earlier(std::uint32_t k) {
        Stage& stage = trial_.stages[k];
        const System& system = trial_.system_of(k);
        stage.sides = {};
        stage.definition_sides = {};
        stage.size.reset();
        for (const ItemId item : stage.items.ids()) {
            const bool is_known = !is_hindered({k, item});
            if (!is_known) stage.items[item] = number(item == system.speed_item() ? 1 : 0);
        }
    }

    tl::expected<void, SizeObstacle> make_items() {
        Stage& stage = trial_.stages[number_];
        const System& system = trial_.system_of(number_);
        for (const ItemId item : stage.items.ids()) {
            Formula& formula = stage.items[item];
            const std::string name(system.item_name(item));
            if (item == system.frozen_item()) {
                formula = number(0);
                stage.uniform[item] = true;
            } else if (system.is_species(item)) {
                // On a model the starting value is lost if it depends on positions, because these
                // are positions in space.
                const auto is_placed = [](const Node& node) { return is_of_place(node); };
                const bool is_lost = program_.domain.model && holds_in(formula, is_placed);
                if (!is_lost && can_start(formula)) continue;
                formula = system.quantities[item].start;
                if (formula.nodes.empty()) formula = number(0);
                if (can_start(formula)) continue;
                return obstacle(
                    stage.size->span,
                    fmt::format(
                        "'size' cannot be used, because the starting value of '{}' cannot be "
                        "computed in a trial run on another plane",
                        name),
                    fmt::format(
                        "the starting value of '{}' in {} must read neither files nor operators",
                        name, system.name));
            } else if (const Node* why = hindrance(formula)) {
                return obstacle(why->span.source == stage.size->span.source ? why->span
                                                                            : stage.size->span,
                                fmt::format("'size' cannot be used, because '{}' varies over the "
                                            "domain and changes the wavelength",
                                            name),
                                "with 'size', parameters must be random or the same in all cells");
            }
        }
        return {};
    }

    void make_stage() {
        Stage& stage = trial_.stages[number_];
        const System& system = trial_.system_of(number_);
        stage.sides = {};
        stage.definition_sides = {};
        stage.time.until.reset();
        stage.time.coarse = 1;
        const auto reads_others = [](const Node& node) { return node.is<StageItem>(); };
        if (holds_in(stage.show, reads_others) || holds_in(stage.show, is_of_domain_alone) ||
            stage.show.nodes.back().type != ValueType::number) {
            stage.show = {{Node{system.species().front()}}};
        }
    }

    const Program& program_;
    std::uint32_t number_;
    Program trial_;
};

std::string cells_in_words(double cells, double cell) {
    if (cell == 1) return fmt::format("{:.4g}", cells);
    return fmt::format("{:.4g}, {:.4g} cells,", cells * cell, cells);
}

}  // namespace

tl::expected<Program, SizeObstacle> trial_program(const Program& program, std::uint32_t stage) {
    return TrialMaker(program, stage).make();
}

std::optional<SizeObstacle> unfit_size(const StageSize& size, double cell, double most_cells) {
    const double cells = size.wanted / cell;
    if (cells < fewest_cells_of_size) {
        return SizeObstacle{size.span,
                            fmt::format("a wavelength of {:.3g} cells is too short to be computed",
                                        cells),
                            fmt::format("size must be at least {} here",
                                        cells_in_words(fewest_cells_of_size, cell))};
    }
    if (cells <= most_cells) return std::nullopt;
    return SizeObstacle{
        size.span, fmt::format("a wavelength of {:.4g} cells is longer than the domain", cells),
        fmt::format("size must be at most {} here", cells_in_words(most_cells, cell))};
}

}  // namespace cascade

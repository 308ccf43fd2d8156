// Reads a simulation of VisualPDE.
//
// A species u has the equation T u_t = div(D_uu grad(u) + D_uv grad(v) + …) + f. The last species
// may be algebraic: w = div(…) + f.
#include "import/visual_pde.h"

#include "import/xml.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cascade::importing {

namespace {

using Where = VisualPdeNames::Where;

/// The condition that a cell is inside the domain: VisualPDE's function is above 0 there.
std::optional<Expression> condition_of_mask(VisualPdeNames& names, Where where) {
    auto inside = names.option("domainIndicatorFun", where);
    if (!inside) return std::nullopt;
    constexpr std::string_view conditions[] = {"<",  "<=",  ">",  ">=", "==",
                                               "!=", "and", "or", "not"};
    const bool is_condition = std::find(std::begin(conditions), std::end(conditions),
                                        inside->text) != std::end(conditions);
    return is_condition ? *inside : operation(*inside, ">", number(0));
}

class SystemOfPde {
public:
    SystemOfPde(VisualPdeNames& names, Import& import, const VisualPdeOptions& options,
                Draft& draft)
        : names_(names), import_(import), options_(options), draft_(draft) {}

    bool add() {
        const auto& species = names_.species();
        bool is_flat = true;
        if (!names_.inside().empty() && !add_moving_mask()) return false;
        for (std::size_t k = 0; k < species.size(); ++k) {
            const bool is_algebraic = k >= species.size() - names_.algebraic();
            const bool is_map = k >= species.size() - names_.maps();
            auto rate = rate_of(k, is_algebraic || is_map);
            if (!rate) return false;
            if (is_algebraic) {
                draft_.definitions.push_back(
                    fmt::format("{} = {}", species[k], write_formula(*rate)));
                continue;
            }
            if (is_map) rate = towards(*rate, species[k]);
            auto start = names_.option(fmt::format("initCond_{}", k + 1), Where::start);
            if (!start) return false;
            is_flat &= names_.is_uniform(*start);
            if (!names_.inside().empty() && !confine(k, *rate, *start)) return false;
            draft_.rates.push_back(fmt::format("{}' = {}", species[k], write_formula(*rate)));
            draft_.starts.push_back(fmt::format("{}: {}", species[k], write_formula(*start)));
        }
        draft_.may_shorten = names_.maps() == 0;
        draft_.waits_for_click = is_flat;
        return true;
    }

private:
    /// The rate with which the species reaches this value after one step.
    static Expression towards(const Expression& value, const std::string& species) {
        return operation(operation(value, "-", name(species)), "/", name("speed"));
    }

    /// Adds a definition that is 1 inside a mask that changes.
    bool add_moving_mask() {
        const auto inside = condition_of_mask(names_, Where::rate);
        if (!inside) return false;
        draft_.definitions.push_back(
            fmt::format("{} = {}", names_.inside(), write_formula(*inside)));
        Diagnostics ignored;
        Import quiet{import_.sources, ignored};
        Draft scratch;
        VisualPdeNames other(quiet, options_, scratch);
        // If the mask reads a species, the cells outside of it get their values in the first step.
        if (other.declare() && condition_of_mask(other, Where::start)) {
            begins_ = names_.fresh_name("begins");
            draft_.starts.push_back(fmt::format(
                "{}: {}", begins_, write_formula(*condition_of_mask(names_, Where::start))));
        }
        draft_.remarks.push_back(fmt::format(
            "The domain changes, so its mask is the definition '{}'; cells outside have the value "
            "that VisualPDE gives them.",
            names_.inside()));
        return true;
    }

    /// Gives a species its value outside of a mask that changes: 0, or the value of the condition
    /// 'dirichlet'.
    bool confine(std::size_t k, Expression& rate, Expression& start) {
        const std::string& u = names_.species()[k];
        const bool has_value = names_.kind_of_sides(k) == "dirichlet";
        const std::string key = fmt::format("dirichletStr_{}", k + 1);
        const auto outside = has_value ? names_.option(key, Where::rate) : number(0);
        if (!outside) return false;
        const std::string slope = names_.kind_of_sides(k) + "Str_" + std::to_string(k + 1);
        if (names_.is_closed(u)) {
            const auto value = names_.option(slope, Where::side);
            if (!value) return false;
            if (!value->is_number("0")) {
                names_.fail(options_.source(import_, slope),
                            "a slope at a border that moves has no counterpart in Cascade");
                return false;
            }
        }
        const Expression rest = outside->is_name(u) ? number(0) : towards(*outside, u);
        const bool is_still = rate.is_number("0") && rest.is_number("0");
        if (!is_still) rate = call("if", {name(names_.inside()), rate, rest});
        if (begins_.empty() || outside->is_name(u)) return true;
        const auto value = has_value ? names_.option(key, Where::start) : number(0);
        if (!value) return false;
        if (write_formula(start) != write_formula(*value)) {
            start = call("if", {name(begins_), start, *value});
        }
        return true;
    }

    /// The diffusion coefficients of the term D grad(u) as a factor of grad(u), or of lap(u) if
    /// they are the same in all cells.
    bool add_diffusion(std::size_t row, std::size_t column, Expression& uniform,
                       Expression& fluxes) {
        const Span whole =
            options_.source(import_, fmt::format("diffusionStr_{}_{}", row + 1, column + 1));
        const std::string_view text = import_.sources.text(whole);
        const std::string& u = names_.species()[column];
        const std::size_t mark = std::min(text.find(';'), text.size());
        const auto part = [&](std::size_t begin, std::size_t end) {
            return names_.formula({whole.source, static_cast<std::uint32_t>(begin),
                                   static_cast<std::uint32_t>(end)},
                                  Where::rate);
        };
        const auto along_x = part(0, mark);
        if (!along_x) return false;
        const std::size_t begin = std::min(mark + 1, text.size());
        const std::size_t end = std::min(text.find(';', begin), text.size());
        const bool has_two =
            !names_.is_line() && !plain_line(text.substr(begin, end - begin)).empty();
        if (!has_two && along_x->is_number("0")) return true;
        if (!has_two && names_.is_uniform(*along_x)) {
            uniform = operation(uniform, "+", operation(*along_x, "*", names_.operate("lap", u)));
            return true;
        }
        Expression factor = *along_x;
        if (has_two) {
            const auto along_y = part(begin, end);
            if (!along_y) return false;
            factor = call("symmetric", {*along_x, number(0), *along_y});
        }
        if (!names_.is_closed(u)) {
            names_.differentiate(u);
            fluxes = operation(fluxes, "+", operation(factor, "*", call("grad", {name(u)})));
            return true;
        }
        const auto flow = names_.flow(std::move(factor), u);
        if (!flow) {
            names_.fail(whole,
                        "two coefficients of diffusion in a domain that changes have no "
                        "counterpart");
            return false;
        }
        uniform = operation(uniform, "+", *flow);
        return true;
    }

    std::optional<Expression> rate_of(std::size_t row, bool is_algebraic) {
        Expression uniform, fluxes;
        const bool has_cross_terms = options_.is_true("crossDiffusion");
        for (std::size_t column = 0; column < names_.species().size(); ++column) {
            if (column != row && !has_cross_terms) continue;
            if (column == row && is_algebraic) continue;
            if (!add_diffusion(row, column, uniform, fluxes)) return std::nullopt;
        }
        const auto reaction = names_.option(fmt::format("reactionStr_{}", row + 1), Where::rate);
        if (!reaction) return std::nullopt;
        Expression rate = uniform;
        if (!fluxes.is_number("0")) rate = operation(rate, "+", call("div", {fluxes}));
        rate = operation(rate, "+", *reaction);
        if (options_.is_true("timescales")) {
            const auto scale = names_.option(fmt::format("timescale_{}", row + 1), Where::rate);
            if (!scale) return std::nullopt;
            rate = operation(rate, "/", *scale);
        }
        return rate;
    }

    VisualPdeNames& names_;
    Import& import_;
    const VisualPdeOptions& options_;
    Draft& draft_;
    /// The parameter that is 1 inside the mask at the start. Empty if the start of the mask is
    /// unknown.
    std::string begins_;
};

bool add_mask(VisualPdeNames& names, const VisualPdeOptions& options, Draft& draft) {
    if (!options.is_true("domainViaIndicatorFun") || !names.inside().empty()) return true;
    const auto inside = condition_of_mask(names, Where::mask);
    if (!inside) return false;
    draft.domain.push_back("mask: " + write_formula(*inside));
    return true;
}

/// The value that VisualPDE shows, if pictures can show it, otherwise the first species.
std::string shown_value(VisualPdeNames& names, Import& import, const VisualPdeOptions& options,
                        Draft& draft) {
    Diagnostics ignored;
    Import quiet{import.sources, ignored};
    Draft scratch;
    VisualPdeNames other(quiet, options, scratch);
    const bool is_declared = other.declare();
    const auto shown = is_declared ? other.option("whatToPlot", Where::picture) : std::nullopt;
    const bool is_possible = shown && scratch.functions.empty() && scratch.parameters.empty() &&
                             write_formula(*shown).find("random(") == std::string::npos &&
                             write_formula(*shown).find("normal(") == std::string::npos;
    if (is_possible) {
        return write_formula(*names.option("whatToPlot", Where::picture));
    }
    draft.remarks.push_back(fmt::format("VisualPDE shows '{}', this script {}.",
                                        plain_line(options.text("whatToPlot")),
                                        names.species()[0]));
    return names.species()[0];
}

/// The solver of the stage. Returns "" after an error.
std::string solver_of_pde(VisualPdeNames& names, Import& import, const VisualPdeOptions& options,
                          Draft& draft) {
    const std::string scheme = options.text("timesteppingScheme");
    constexpr std::pair<std::string_view, std::string_view> solvers[] = {
        {"Euler", "euler"}, {"AB2", "rk2"}, {"Mid", "rk2"}, {"RK4", "rk4"}};
    for (const auto& [theirs, own] : solvers) {
        if (scheme != theirs) continue;
        if (own == "rk2") {
            draft.remarks.push_back(fmt::format(
                "VisualPDE uses the scheme '{}', and this script another scheme of second order.",
                scheme));
        }
        return std::string(own);
    }
    names.fail(options.source(import, "timesteppingScheme"), "this scheme is unknown");
    return "";
}

bool add_domain_and_stage(VisualPdeNames& names, Import& import, const VisualPdeOptions& options,
                          Draft& draft) {
    const std::string grid = names.is_line()
                                 ? fmt::format("grid: {}", names.columns)
                                 : fmt::format("grid: {}, {}", names.columns, names.rows);
    draft.domain = {grid, "spacing: " + number_text(names.spacing)};
    if (!names.is_line() && !options.is_true("squareCanvas")) {
        draft.remarks.push_back(
            "VisualPDE gives the domain the shape of its window, here it is square.");
    }
    if (!add_visual_pde_sides(names, import, options, draft)) return false;
    if (!add_mask(names, options, draft)) return false;
    if (const auto seed = plain_number(options.text("randSeed"));
        seed && (options.is_true("setSeed") || options.is_true("fixRandSeed")) && *seed >= 0 &&
        *seed <= 4294967295.0 && *seed == std::floor(*seed)) {
        draft.domain.push_back(fmt::format("seed: {}", number_text(*seed)));
    }
    const auto step = plain_number(options.text("dt"));
    if (!step || !(*step > 0)) {
        names.fail(options.source(import, "dt"), "a step above 0 is expected");
        return false;
    }
    draft.speed = *step;
    const std::string solver = solver_of_pde(names, import, options, draft);
    if (solver.empty()) return false;
    draft.stage = {"iterations: 2000"};
    if (solver != "euler") draft.stage.push_back("solver: " + solver);
    draft.stage.push_back("show: " + shown_value(names, import, options, draft));
    return !names.has_failed();
}

}  // namespace

std::optional<Draft> read_visual_pde(Import& import) {
    const auto options = VisualPdeOptions::read(import);
    if (!options) return std::nullopt;
    Draft draft;
    VisualPdeNames names(import, *options, draft);
    if (!options->text("initialState").empty()) {
        names.fail(options->source(import, "initialState"),
                   "a state that VisualPDE reads from a file has no counterpart in Cascade");
        return std::nullopt;
    }
    std::string title = plain_line(options->text("simTitle"));
    if (title.empty()) title = plain_line(options->text("preset"));
    if (title.empty() || title == "Custom") title = "Simulation";
    draft.about = {fmt::format("{}, imported from VisualPDE: {}", title, plain_line(import.name))};
    const bool is_read = names.declare() && SystemOfPde(names, import, *options, draft).add() &&
                         add_domain_and_stage(names, import, *options, draft);
    if (!is_read) return std::nullopt;
    names.add_parameters();
    if (names.has_failed()) return std::nullopt;
    return draft;
}

}  // namespace cascade::importing

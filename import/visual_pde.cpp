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

class SystemOfPde {
public:
    SystemOfPde(VisualPdeNames& names, Import& import, const VisualPdeOptions& options,
                Draft& draft)
        : names_(names), import_(import), options_(options), draft_(draft) {}

    bool add() {
        const auto& species = names_.species();
        bool is_flat = true;
        for (std::size_t k = 0; k < species.size(); ++k) {
            const bool is_algebraic = k >= species.size() - names_.algebraic();
            const auto rate = rate_of(k, is_algebraic);
            if (!rate) return false;
            if (is_algebraic) {
                draft_.definitions.push_back(
                    fmt::format("{} = {}", species[k], write_formula(*rate)));
                continue;
            }
            draft_.rates.push_back(fmt::format("{}' = {}", species[k], write_formula(*rate)));
            const auto start = names_.option(fmt::format("initCond_{}", k + 1), Where::start);
            if (!start) return false;
            is_flat &= names_.is_uniform(*start);
            draft_.starts.push_back(fmt::format("{}: {}", species[k], write_formula(*start)));
        }
        draft_.waits_for_click = is_flat;
        return true;
    }

private:
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
        names_.differentiate(u);
        if (!has_two && names_.is_uniform(*along_x)) {
            uniform = operation(uniform, "+", operation(*along_x, "*", call("lap", {name(u)})));
            return true;
        }
        Expression factor = *along_x;
        if (has_two) {
            const auto along_y = part(begin, end);
            if (!along_y) return false;
            factor = call("symmetric", {*along_x, number(0), *along_y});
        }
        fluxes = operation(fluxes, "+", operation(factor, "*", call("grad", {name(u)})));
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
        if (!is_algebraic && options_.is_true("timescales")) {
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
};

/// The condition that a cell is inside the domain: VisualPDE's function is above 0 there.
bool add_mask(VisualPdeNames& names, const VisualPdeOptions& options, Draft& draft) {
    if (!options.is_true("domainViaIndicatorFun")) return true;
    auto inside = names.option("domainIndicatorFun", Where::mask);
    if (!inside) return false;
    constexpr std::string_view conditions[] = {"<",  "<=",  ">",  ">=", "==",
                                               "!=", "and", "or", "not"};
    const bool is_condition = std::find(std::begin(conditions), std::end(conditions),
                                        inside->text) != std::end(conditions);
    if (!is_condition) inside = operation(*inside, ">", number(0));
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
    for (const char* const key : {"automataMode", "initialState"}) {
        if (options->text(key).empty() || options->text(key) == "false") continue;
        names.fail(options->source(import, key), fmt::format("'{}' has no counterpart", key));
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

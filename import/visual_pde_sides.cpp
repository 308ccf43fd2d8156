// Boundary conditions of simulations of VisualPDE.
//
// VisualPDE's sides pass through the centres of the outermost cells. Neumann and Robin conditions
// give the derivative along the outward normal, which is slope(…) here. A condition `Ghost` gives
// the value g beyond the side. Formulas of sides read the value at the face, f = (c + g) / 2, where
// c is the value of the cell. So slope(2 (g - u) / h) gives g.
#include "import/visual_pde.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace cascade::importing {

namespace {

enum class SideOfPde : std::uint8_t { periodic, noflux, written };

struct ConditionOfPde {
    SideOfPde kind = SideOfPde::periodic;
    std::string text = "periodic";
};
using ConditionsOfPde = std::array<ConditionOfPde, 4>;
constexpr std::string_view names_of_sides[] = {"left", "right", "top", "bottom"};

std::string lower_line(std::string_view text) {
    std::string line = plain_line(text);
    std::transform(line.begin(), line.end(), line.begin(), [](char c) {
        return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    });
    return line;
}

class SidesOfPde {
public:
    SidesOfPde(VisualPdeNames& names, Import& import, const VisualPdeOptions& options, Draft& draft)
        : names_(names), import_(import), options_(options), draft_(draft) {}

    bool add() {
        const std::size_t count = names_.species().size();
        std::vector<ConditionsOfPde> all(count);
        for (std::size_t k = 0; k < count; ++k) {
            if (!read(k, all[k])) return false;
        }
        const std::size_t used = names_.is_line() ? 2 : 4;
        bool has_walls = options_.is_true("domainViaIndicatorFun");
        std::array<bool, 2> is_periodic{};
        for (std::size_t k = 0; k < count; ++k) {
            if (!reads_sides(k)) continue;
            for (std::size_t side = 0; side < used; ++side) {
                const bool goes_round = all[k][side].kind == SideOfPde::periodic;
                is_periodic[side / 2] |= goes_round;
                has_walls |= !goes_round;
            }
        }
        if (used == 2) is_periodic[1] = is_periodic[0];
        constexpr std::string_view words[] = {"noflux", "periodic"};
        draft_.domain.push_back(
            is_periodic[0] == is_periodic[1]
                ? fmt::format("boundary: {}", words[is_periodic[0]])
                : fmt::format("boundary: {}, {}", words[is_periodic[0]], words[is_periodic[1]]));
        if (has_walls) {
            draft_.remarks.push_back(
                "VisualPDE's sides pass through the middle of the outermost cells, here they are "
                "the edges of these cells.");
        }
        for (std::size_t k = 0; k < count; ++k) write(k, all[k], used, is_periodic);
        return !names_.has_failed();
    }

private:
    /// Sets `made` to a condition such as "dirichlet", whose formula is at `span`.
    bool condition(const std::string& kind, Span span, std::size_t species, ConditionOfPde& made) {
        if (kind == "periodic") {
            made = {};
            return true;
        }
        auto value = names_.formula(span, VisualPdeNames::Where::side);
        if (!value) return false;
        const std::string& u = names_.species()[species];
        if (kind == "dirichlet") {
            made = {SideOfPde::written, fmt::format("fixed({})", write_formula(*value))};
        } else if ((kind == "neumann" || kind == "robin") && value->is_number("0")) {
            made = {SideOfPde::noflux, "noflux"};
        } else if (kind == "neumann" || kind == "robin") {
            made = {SideOfPde::written, fmt::format("slope({})", write_formula(*value))};
        } else if (kind == "ghost") {
            if (mentions(*value, u)) {
                names_.fail(
                    span,
                    "a value beyond a side that depends on the species itself has no counterpart "
                    "in Cascade");
                return false;
            }
            const Expression slope =
                operation(operation(number(2), "*", operation(*value, "-", name(u))), "/",
                          name("domain.spacing"));
            made = {SideOfPde::written, fmt::format("slope({})", write_formula(slope))};
        } else {
            names_.fail(span, fmt::format("the boundary condition '{}' is unknown", kind));
            return false;
        }
        return true;
    }

    bool read(std::size_t species, ConditionsOfPde& all) {
        const std::string kind = lower_line(options_.text("boundaryConditions", species));
        if (kind == "combo") return read_sides(species, all);
        const std::string key = fmt::format("{}Str_{}", kind, species + 1);
        ConditionOfPde made;
        if (!condition(kind, options_.source(import_, key), species, made)) return false;
        all.fill(made);
        return true;
    }

    /// Reads "Left: Dirichlet = 0; Right: Neumann = 1;".
    bool read_sides(std::size_t species, ConditionsOfPde& all) {
        const Span whole = options_.source(import_, fmt::format("comboStr_{}", species + 1));
        const std::string_view text = import_.sources.text(whole);
        std::array<bool, 4> is_given{};
        for (std::size_t begin = 0; begin < text.size();) {
            const std::size_t end = std::min(text.find(';', begin), text.size());
            const std::string_view part = text.substr(begin, end - begin);
            const std::size_t colon = part.find(':');
            if (colon != std::string_view::npos) {
                const std::size_t sign = std::min(part.find('=', colon), part.size());
                const std::string side = lower_line(part.substr(0, colon));
                const auto* const found =
                    std::find(std::begin(names_of_sides), std::end(names_of_sides), side);
                if (found == std::end(names_of_sides)) {
                    names_.fail(whole, fmt::format("'{}' is not a side", side));
                    return false;
                }
                const auto index = static_cast<std::size_t>(found - std::begin(names_of_sides));
                const Span value{whole.source,
                                 static_cast<std::uint32_t>(begin +
                                                            std::min(sign + 1, part.size())),
                                 static_cast<std::uint32_t>(end)};
                is_given[index] = true;
                const std::string kind = lower_line(part.substr(colon + 1, sign - colon - 1));
                if (!condition(kind, value, species, all[index])) return false;
            }
            begin = end + 1;
        }
        for (std::size_t side = 0; side < 4; ++side) {
            // A side without a condition is periodic if the opposite side is.
            const std::size_t opposite = side ^ 1U;
            if (is_given[side] || !is_given[opposite]) continue;
            if (all[opposite].kind != SideOfPde::periodic) {
                all[side] = {SideOfPde::noflux, "noflux"};
            }
        }
        return true;
    }

    bool is_definition(std::size_t species) const {
        return species >= names_.species().size() - names_.algebraic();
    }
    bool reads_sides(std::size_t species) const {
        return !is_definition(species) || names_.is_differentiated(names_.species()[species]);
    }

    void write(std::size_t species, const ConditionsOfPde& all, std::size_t used,
               const std::array<bool, 2>& is_periodic) {
        const std::string& u = names_.species()[species];
        const bool are_same =
            std::all_of(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(used),
                        [&](const ConditionOfPde& each) { return each.text == all[0].text; });
        if (!reads_sides(species)) return;
        const bool has_mask = options_.is_true("domainViaIndicatorFun") && names_.inside().empty();
        const std::string kind = names_.kind_of_sides(species);
        if (has_mask && are_same && all[0].kind == SideOfPde::written && kind != "combo") {
            draft_.sides.push_back(fmt::format("{}.border: {}", u, all[0].text));
        } else if (has_mask && (kind == "combo" || kind == "periodic")) {
            // In VisualPDE, operators read the zeros outside of the mask.
            draft_.sides.push_back(fmt::format("{}.border: fixed(0)", u));
        }
        for (std::size_t side = 0; side < (are_same ? 1 : used); ++side) {
            const bool is_same_on_both = !are_same || is_periodic[0] == is_periodic[1];
            const SideOfPde usual = is_periodic[side / 2] ? SideOfPde::periodic : SideOfPde::noflux;
            if (all[side].kind == usual && is_same_on_both) continue;
            if (is_definition(species) && all[side].kind == SideOfPde::noflux) continue;
            draft_.sides.push_back(
                fmt::format("{}.{}: {}", u, are_same ? "sides" : std::string(names_of_sides[side]),
                            all[side].text));
        }
    }

    VisualPdeNames& names_;
    Import& import_;
    const VisualPdeOptions& options_;
    Draft& draft_;
};

}  // namespace

bool add_visual_pde_sides(VisualPdeNames& names, Import& import, const VisualPdeOptions& options,
                          Draft& draft) {
    return SidesOfPde(names, import, options, draft).add();
}

}  // namespace cascade::importing

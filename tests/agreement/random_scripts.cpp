#include "random_scripts.h"

#include "lang/program/program.h"
#include "support/random_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

namespace cascade::test {

namespace {

struct FunctionRow {
    std::string_view spelling;
    Arity arity;
    Contexts places;
};

/// Returns all functions except those that only lowering creates and those for crawling cells,
/// which these scripts do not contain.
std::vector<FunctionRow> functions_of_fields() {
    std::vector<FunctionRow> rows;
    const auto add = [&](Function function, const FunctionRow& row) {
        const bool is_made = row.spelling.starts_with('(');
        if (info(function).domains != Domains::crawling && !is_made) rows.push_back(row);
    };
#define CASCADE_FUNCTION(id, spelling, arity, places) \
    add(Function::id, FunctionRow{spelling, arity, Contexts::places});
#include "lang/vocabulary/functions.def"
    return rows;
}

const std::vector<FunctionRow> rows = functions_of_fields();

bool is_word(std::string_view spelling) {
    return spelling.front() >= 'a' && spelling.front() <= 'z' && spelling != "and" &&
           spelling != "or" && spelling != "not";
}

/// Writes one script.
class Writer {
public:
    explicit Writer(std::uint64_t seed)
        : stream_(seed), mask_stream_(~seed), stencil_stream_(~seed + 1) {}

    std::string write() {
        const int systems = 1 + static_cast<int>(stream_.below(2));
        static constexpr std::array<std::string_view, 3> boundaries = {"periodic", "noflux",
                                                                       "periodic, noflux"};
        const bool has_slices = stream_.chance(25);
        const std::string masked = mask(), with_stencil = stencil();
        text_ = fmt::format(
            "domain {{ grid: {}, {}{}; boundary: {}; spacing: {}; seed: {}{}{} }}\n",
            2 + stream_.below(37), (has_slices ? 2 : 1) + stream_.below(9),
            has_slices ? fmt::format(", {}", 2 + stream_.below(5)) : "",
            has_slices ? boundaries[stream_.below(2)] : stream_.pick<std::string_view>(boundaries),
            stream_.chance(50) ? "1" : "0.75", stream_.below(1000), masked, with_stencil);
        write_functions();
        for (int s = 0; s < systems; ++s) write_system(s);
        const int stages = 1 + static_cast<int>(stream_.below(3));
        for (int k = 0; k < stages; ++k)
            write_stage(k, stream_.below(static_cast<std::uint64_t>(systems)));
        return text_;
    }

private:
    enum class Place { value, rate };
    struct SystemNames {
        std::vector<std::string> species, parameters;
    };

    /// A mask, in every third script. The first cell is always inside.
    std::string mask() {
        static constexpr std::array<std::string_view, 5> masks = {
            "random(0, 1) > -0.3 or sx + sy < 0.76", "disc(0.4, 0.1, 0.3) or sx + sy < 0.76",
            "noise(0.3) > 0 or sx + sy < 0.76", "1", "not ring(0.3, 0.2, 0.2, 0.1) or sx < 0.26"};
        has_mask_ = mask_stream_.chance(33);
        if (!has_mask_) return "";
        return fmt::format("; mask: {}", mask_stream_.pick<std::string_view>(masks));
    }

    /// A stencil, in every third script without a mask.
    std::string stencil() {
        if (has_mask_ || !stencil_stream_.chance(33)) return "";
        is_fourth_ = stencil_stream_.chance(50);
        return is_fourth_ ? "; stencil: fourth" : "; stencil: isotropic";
    }

    std::string number() {
        static constexpr std::array<std::string_view, 12> numbers = {"0",   "1",    "2",  "0.5",
                                                                     "1/8", ".25",  "3",  "1e-3",
                                                                     "12",  "7.75", "pi", "1e30"};
        return std::string(stream_.pick<std::string_view>(numbers));
    }

    /// A name, a number, or a coordinate.
    std::string leaf(Place place) {
        static constexpr std::array<std::string_view, 6> coordinates = {"x",  "y",  "z",
                                                                        "sx", "sy", "sz"};
        static constexpr std::array<std::string_view, 2> times = {"t", "step"};
        const std::uint32_t kind = stream_.below(10);
        if (kind < 5 && !readable_.empty()) return stream_.pick<std::string>(readable_);
        if (kind == 5) return std::string(stream_.pick<std::string_view>(coordinates));
        if (kind == 6 && place == Place::rate) {
            return std::string(stream_.pick<std::string_view>(times));
        }
        return number();
    }

    /// Writes an expression that is above −0.1 if it is outside of functions.
    std::string scale(Place place) { return function_count_ < 2 ? number() : leaf(place); }

    std::string call(const FunctionRow& row, Place place, int depth) {
        // A literal divisor of 0 is an error. A varying divisor may be 0.
        if (row.spelling == "/") {
            return fmt::format("({}) / (0.75 + {})", expression(place, depth - 1), leaf(place));
        }
        if (row.spelling == "mod") {
            return fmt::format("mod({}, 0.75 + {})", expression(place, depth - 1), leaf(place));
        }
        if (row.spelling.ends_with(" over domain")) {
            const std::string_view name = row.spelling.substr(0, row.spelling.find(' '));
            return fmt::format("{}({} over domain)", name, expression(place, depth - 1));
        }
        if (row.spelling == "div" || row.spelling == "along") {
            return fmt::format("{}({})", row.spelling, flux(place, depth - 1));
        }
        if (row.spelling == "dot") {
            return fmt::format("dot({}, {})", flux(place, depth - 1), flux(place, depth - 1));
        }
        if (row.spelling == "length") {
            static constexpr std::array<std::string_view, 3> components = {"x", "y", "z"};
            if (stream_.chance(50)) return fmt::format("length({})", flux(place, depth - 1));
            return fmt::format("({}).{}", flux(place, depth - 1),
                               stream_.pick<std::string_view>(components));
        }
        if (row.spelling == "convolve") {
            // Convolutions over few cells are summed directly, others use transforms.
            return fmt::format("convolve(1 - 0.2 * distance, {}, {})", expression(place, depth - 1),
                               1 + stream_.below(4));
        }
        if (is_stencil(row.spelling)) return stencil(row, place, depth);
        std::string arguments = expression(place, depth - 1);
        if (!is_word(row.spelling) && row.arity.most == 1) {
            return fmt::format("({} ({}))", row.spelling, arguments);
        }
        if (!is_word(row.spelling)) {
            const std::string right = row.spelling == "^" && stream_.chance(70)
                                          ? std::to_string(stream_.below(6))
                                          : expression(place, depth - 1);
            return fmt::format("(({}) {} ({}))", arguments, row.spelling, right);
        }
        if (row.spelling == "noise") {
            return fmt::format("noise(0.1 + {}, {})", scale(place), 1 + stream_.below(2));
        }
        const bool is_lattice = row.spelling == "lattice" || row.spelling == "diamond";
        if (is_lattice) arguments = "0.1 + " + scale(place);
        const int count = stream_.chance(50) ? row.arity.least : row.arity.most;
        for (int k = 1; k < count; ++k) arguments += ", " + expression(place, depth - 1);
        return fmt::format("{}({})", row.spelling, arguments);
    }

    static bool is_stencil(std::string_view spelling) {
        static constexpr std::array<std::string_view, 15> stencils = {
            "lap", "dx",  "dy",    "dz",     "dxx",     "dyy",       "dzz",    "dxy",
            "dxz", "dyz", "grad2", "advect", "diffuse", "transport", "shifted"};
        return std::find(stencils.begin(), stencils.end(), spelling) != stencils.end();
    }

    /// An expression that is not constant, since derivatives of constants are refused.
    std::string varying(Place place, int depth) {
        return fmt::format("(x * {} + {})", leaf(place), expression(place, depth));
    }

    std::string stencil(const FunctionRow& row, Place place, int depth) {
        if (row.spelling == "diffuse") {
            return fmt::format("diffuse({}, {}, {}, {})", varying(place, depth - 1), leaf(place),
                               leaf(place), expression(place, depth - 2));
        }
        if (row.spelling == "shifted") {
            return fmt::format("shifted({}, {}, {})", varying(place, depth - 1),
                               static_cast<int>(stream_.below(5)) - 2,
                               static_cast<int>(stream_.below(5)) - 2);
        }
        const bool carries = row.spelling == "advect" || row.spelling == "transport";
        if (!carries) {
            return fmt::format("{}({})", row.spelling, varying(place, depth - 1));
        }
        if (stream_.chance(25)) {
            return fmt::format("{}({}, {})", row.spelling, flux(place, depth - 2),
                               varying(place, depth - 1));
        }
        return fmt::format("{}({}, {}, {}{})", row.spelling, expression(place, depth - 2),
                           leaf(place), stream_.chance(50) ? "0.5, " : "",
                           varying(place, depth - 1));
    }

    /// A vector.
    std::string flux(Place place, int depth) {
        const auto inner = [&] { return flux(place, depth - 1); };
        switch (depth > 0 ? stream_.below(14) : 0) {
            case 1: return fmt::format("{} * ({})", leaf(place), flux(place, depth - 1));
            case 2: return fmt::format("({}) / (0.75 + {})", flux(place, depth - 1), leaf(place));
            case 3: return fmt::format("-({})", flux(place, depth - 1));
            case 4:
                return fmt::format("({}) + ({})", flux(place, depth - 1), flux(place, depth - 1));
            case 5:
                return fmt::format("({}) - ({})", flux(place, depth - 1), flux(place, depth - 1));
            case 6: return fmt::format("vector({}, {})", expression(place, depth - 1), leaf(place));
            case 7:
                return fmt::format("tensor({}, {}, {}) * ({})", leaf(place), leaf(place),
                                   expression(place, depth - 1), flux(place, depth - 1));
            case 8: return fmt::format("unit({})", inner());
            case 9: return fmt::format("cross({}, {})", inner(), inner());
            case 10: return fmt::format("if({}, {}, {})", leaf(place), inner(), inner());
            case 11: return fmt::format("mix({}, {}, {})", inner(), inner(), leaf(place));
            case 12:
                return fmt::format("symmetric({}, {}, {}) * ({})", leaf(place),
                                   expression(place, depth - 1), leaf(place), inner());
            case 13:
                return fmt::format("(symmetric({}, {}, 1, 2, x, {}) - {} * tensor(1, 2, y)) * ({})",
                                   leaf(place), leaf(place), leaf(place), leaf(place), inner());
            default: return fmt::format("grad({})", varying(place, depth - 1));
        }
    }

    bool fits(const FunctionRow& row, Place place) const {
        // Functions that are allowed only in fluxes or only with constant points.
        static constexpr std::array<std::string_view, 9> only_elsewhere = {
            "grad", "vector", "tensor", "symmetric", "cross", "unit", "curl", "distance", "keys"};
        if (std::ranges::find(only_elsewhere, row.spelling) != only_elsewhere.end()) return false;
        switch (row.places) {
            case Contexts::any:
            case Contexts::cells: return true;
            case Contexts::steps:
            case Contexts::rates: return place == Place::rate && !species_.empty();
            case Contexts::noisy: return true;
            case Contexts::values:
            case Contexts::picture: return false;
        }
        return false;
    }

    /// Writes the functions f0 of one value and f1 of two values. f1 calls f0.
    void write_functions() {
        readable_ = {"a"};
        text_ += fmt::format("fn f0(a) = {}\n", expression(Place::value, 2));
        function_count_ = 1;
        readable_ = {"a", "b"};
        text_ += fmt::format("fn f1(a, b) = {}\n", expression(Place::value, 3));
        function_count_ = 2;
        readable_.clear();
    }

    std::string own_call(Place place, int depth) {
        if (function_count_ == 1 || stream_.chance(50)) {
            return fmt::format("f0({})", expression(place, depth - 1));
        }
        return fmt::format("f1({}, {})", expression(place, depth - 1),
                           expression(place, depth - 1));
    }

    std::string expression(Place place, int depth) {
        if (depth <= 0 || stream_.chance(25)) return leaf(place);
        if (function_count_ > 0 && stream_.chance(6)) return own_call(place, depth);
        for (;;) {
            const FunctionRow& row = rows[stream_.below(rows.size())];
            if (fits(row, place)) return call(row, place, depth);
        }
    }

    void write_system(int s) {
        SystemNames names;
        const int species = 1 + static_cast<int>(stream_.below(3));
        const int parameters = static_cast<int>(stream_.below(4));
        readable_.clear();
        species_.clear();
        text_ += fmt::format("system s{} {{\n", s);
        for (int k = 0; k < parameters; ++k) {
            const std::string name = fmt::format("p{}", k);
            text_ += fmt::format("  {}: {}\n", name, expression(Place::value, 3));
            readable_.push_back(name);
            names.parameters.push_back(name);
        }
        for (int k = 0; k < species; ++k) {
            const std::string name = fmt::format("u{}", k);
            text_ += fmt::format("  {}: {}\n", name, expression(Place::value, 3));
            readable_.push_back(name);
            names.species.push_back(name);
        }
        const bool has_family = stream_.chance(35);
        if (has_family) write_family(names);
        species_ = names.species;
        if (stream_.chance(50)) {
            text_ += fmt::format("  shared = {}\n", expression(Place::rate, 3));
            readable_.push_back("shared");
        }
        for (int k = 0; k < species; ++k) {
            text_ += fmt::format("  u{}' = {}\n", k, expression(Place::rate, 4));
            if (stream_.chance(30))
                text_ += fmt::format("  u{}' += {}\n", k, expression(Place::rate, 2));
            // Only later rates read earlier ones, so there is no cycle.
            readable_.push_back(fmt::format("u{}'", k));
        }
        if (has_family) write_rates_of_family();
        if (stream_.chance(40)) text_ += fmt::format("  u0 >= {}\n", number());
        if (stream_.chance(20)) text_ += "  u0 <= 100\n";
        text_ += "}\n";
        systems_.push_back(names);
    }

    /// Writes a family w[1] to w[n], in which each member reads the next in a ring.
    void write_family(SystemNames& names) {
        const std::uint32_t members = 1 + stream_.below(3);
        text_ +=
            fmt::format("  i: 1..{}\n  w[i]: i * ({})\n", members, expression(Place::value, 2));
        if (stream_.chance(40)) text_ += fmt::format("  w[1]: {}\n", leaf(Place::value));
        for (std::uint32_t member = 1; member <= members; ++member) {
            names.species.push_back(fmt::format("w[{}]", member));
            readable_.push_back(names.species.back());
        }
        members_ = members;
    }

    void write_rates_of_family() {
        static constexpr std::array<std::string_view, 5> reductions = {"sum", "product", "mean",
                                                                       "min", "max"};
        text_ += fmt::format("  w[i]' = 0.1 * {}(w[i] over i) - w[mod(i, {}) + 1] + {}\n",
                             stream_.pick<std::string_view>(reductions), members_,
                             expression(Place::rate, 3));
        if (stream_.chance(40)) text_ += "  w[1]' += 0.25\n";
    }

    void write_stage(int k, std::size_t system) {
        const SystemNames& names = systems_[system];
        text_ += fmt::format("stage g{}: s{} {{ iterations: {}; speed: {}\n", k, system,
                             stream_.below(6), stream_.chance(70) ? "0.125" : "0.1 + 0.05 * x");
        // Names belong to the previous stage, perhaps of the other system, [names] to this stage.
        readable_.clear();
        species_.clear();
        for (const std::string& name : previous_) readable_.push_back(name);
        if (stream_.chance(50)) {
            text_ += fmt::format("  frozen: {}\n", expression(Place::value, 2));
            readable_.push_back("[frozen]");
        }
        for (const std::string& name : names.species) {
            if (!stream_.chance(40)) continue;
            text_ += fmt::format("  {}: {}\n", name, expression(Place::value, 3));
            readable_.push_back("[" + name + "]");
        }
        if (stream_.chance(30) && !has_mask_ && !is_fourth_) write_sides();
        if (has_mask_ && mask_stream_.chance(50)) write_border();
        text_ += "}\n";
        previous_ = names.species;
        previous_.insert(previous_.end(), names.parameters.begin(), names.parameters.end());
        if (k == 0) previous_.push_back("g0.u0");
    }

    /// Writes the border of species u0, with one of the rules for sides.
    void write_border() {
        static constexpr std::array<std::string_view, 4> rules = {"fixed(0.5)", "slope(0.01 * sx)",
                                                                  "slope(0.5 * sin([u0] - t))",
                                                                  "fixed(sin(t) - x)"};
        text_ += fmt::format("  u0.border: {}\n", mask_stream_.pick<std::string_view>(rules));
    }

    /// Writes the sides of species u0, which exists in every system.
    void write_sides() {
        static constexpr std::array<std::string_view, 2> all = {"noflux", "periodic"};
        text_ +=
            fmt::format("  u0.sides: {}\n",
                        stream_.chance(50) ? "fixed(0.5)" : stream_.pick<std::string_view>(all));
        if (!stream_.chance(50)) return;
        // Operators in these expressions cannot read species at a side.
        std::erase_if(readable_, [](const std::string& name) {
            return name.starts_with("[") && name != "[frozen]";
        });
        static constexpr std::array<std::string_view, 2> slopes = {"0.01", "0.5 * sin([u0] - t)"};
        text_ += fmt::format("  u0.left: fixed({})\n  u0.right: slope({})\n",
                             expression(Place::value, 2), stream_.pick<std::string_view>(slopes));
    }

    RandomStream stream_, mask_stream_, stencil_stream_;
    bool has_mask_ = false;   ///< If true, species have no sides of their own.
    bool is_fourth_ = false;  ///< If true, species have no sides of their own.
    std::string text_;
    std::vector<std::string> readable_, species_, previous_;
    std::vector<SystemNames> systems_;
    int function_count_ = 0;
    std::uint32_t members_ = 0;
};

}  // namespace

std::string random_script(std::uint64_t seed) { return Writer(seed).write(); }

}  // namespace cascade::test

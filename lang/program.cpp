// The checked program: its table of functions and the names of items.
#include "lang/program.h"

#include "core/check.h"

#include <algorithm>

namespace cascade {

namespace {

constexpr bool is_operator(std::string_view spelling) {
    const char first = spelling.front();
    const bool is_word = first >= 'a' && first <= 'z';
    return !is_word || spelling == "or" || spelling == "and" || spelling == "not";
}

constexpr bool is_aggregate(std::string_view spelling) {
    return spelling.ends_with(" over domain");
}

constexpr auto any = Places::any;
constexpr auto cells = Places::cells;
constexpr auto rates = Places::rates;
constexpr auto values = Places::values;
constexpr auto noisy = Places::noisy;
constexpr auto picture = Places::picture;

constexpr FunctionInfo function_table[] = {
#define CASCADE_FUNCTION(id, spelling, arity, places, meaning) \
    {spelling, arity, places, meaning, is_operator(spelling), \
     is_aggregate(spelling)},
#include "lang/functions.def"
#undef CASCADE_FUNCTION
};

}  // namespace

const FunctionInfo& info(Function function) {
    return function_table[static_cast<std::size_t>(function)];
}

std::optional<Function> function_named(std::string_view name) {
    for (std::size_t i = 0; i < function_count; ++i) {
        const FunctionInfo& row = function_table[i];
        if (!row.is_operator && row.spelling == name) return static_cast<Function>(i);
    }
    return std::nullopt;
}

std::optional<Builtin> builtin_named(std::string_view name) {
    const auto found = std::find(builtin_names.begin(), builtin_names.end(), name);
    if (found == builtin_names.end()) return std::nullopt;
    return static_cast<Builtin>(found - builtin_names.begin());
}

bool is_random(Function function) {
    switch (function) {
        case Function::random:
        case Function::normal:
        case Function::white:
        case Function::noise:
        case Function::lattice:
        case Function::diamond: return true;
        default: return false;
    }
}

bool varies_by_cell(Function function) {
    const Places places = info(function).places;
    return places != Places::any && places != Places::picture;
}

bool reads_file(Function function) {
    switch (function) {
        case Function::field:
        case Function::image:
        case Function::attr:
        case Function::uvimage: return true;
        default: return false;
    }
}

bool needs_model(Function function) {
    switch (function) {
        case Function::attr:
        case Function::uvimage:
        case Function::distance:
        case Function::keys: return true;
        default: return false;
    }
}

bool differentiates(Function function) {
    return Function::lap <= function && function <= Function::div;
}

std::size_t operand_count(const Node& call) {
    const Arity arity = info(call.function).arity;
    return std::max(static_cast<std::size_t>(call.operand_count),
                    static_cast<std::size_t>(arity.least));
}

bool differs_by_cell(const Node& node, bool operand_differs, const Program& program,
                     std::uint32_t stage) {
    const auto item_differs = [&](std::uint32_t of, std::uint32_t item) {
        const std::vector<bool>& uniform = program.stages[of].uniform;
        return uniform.empty() || !uniform[item];
    };
    switch (node.kind) {
        case NodeKind::number:
        case NodeKind::text: return false;
        case NodeKind::own: return item_differs(stage, node.index);
        case NodeKind::earlier: return item_differs(node.stage, node.index);
        case NodeKind::builtin: {
            const auto builtin = static_cast<Builtin>(node.index);
            if (builtin == Builtin::step) return false;
            return builtin != Builtin::t ||
                   item_differs(stage, program.system_of(stage).speed_item());
        }
        case NodeKind::definition:
        case NodeKind::rate:
        case NodeKind::metric:
        case NodeKind::model:
        case NodeKind::surface_value:
        case NodeKind::inside: return true;
        case NodeKind::call: break;
    }
    // An aggregate over the domain is one number whatever it is taken of.
    if (info(node.function).is_aggregate) return false;
    return operand_differs || (varies_by_cell(node.function) && !differentiates(node.function));
}

std::uint32_t System::species_count() const {
    const auto count = std::count_if(quantities.begin(), quantities.end(),
                                     [](const Quantity& quantity) { return quantity.is_species; });
    return static_cast<std::uint32_t>(count);
}

std::string_view System::item_name(std::uint32_t item) const {
    if (item < quantities.size()) return quantities[item].name;
    CHECK(item < item_count(), "an item is a quantity, frozen or speed");
    return item == frozen_item() ? "frozen" : "speed";
}

}  // namespace cascade

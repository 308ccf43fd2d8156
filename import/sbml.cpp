// Makes a script of a model in SBML. libSBML reads the file, in a module that is loaded here.
#include "import/sbml.h"

#include "core/version.h"
#include "import/importer.h"
#include "import/xml.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace cascade::importing {

namespace {

constexpr Dialect sbml_dialect = {.caret_is_power = true};

constexpr ForeignFunction sbml_functions[] = {
    {"exp", 1, "exp(A)"},        {"ln", 1, "log(A)"},    {"log10", 1, "log(A)/log(10)"},
    {"log", 2, "log(B)/log(A)"}, {"sin", 1, "sin(A)"},   {"cos", 1, "cos(A)"},
    {"tan", 1, "tan(A)"},        {"asin", 1, "asin(A)"}, {"acos", 1, "acos(A)"},
    {"atan", 1, "atan(A)"},      {"sinh", 1, "sinh(A)"}, {"cosh", 1, "cosh(A)"},
    {"tanh", 1, "tanh(A)"},      {"sqrt", 1, "sqrt(A)"}, {"root", 2, "B^(1/A)"},
    {"sqr", 1, "A^2"},           {"abs", 1, "abs(A)"},   {"floor", 1, "floor(A)"},
    {"ceil", 1, "ceil(A)"},      {"pow", 2, "A^B"},      {"min", 2, "min(A, B)"},
    {"max", 2, "max(A, B)"},
};

/// Loads the module. If that is impossible, reports an error and returns null.
SbmlReader* load_sbml_reader(Import& import) {
    const auto refuse = [&](const std::string& why, const std::string& hint) {
        import.diagnostics.error({import.source, 0, 0}, why, hint);
        return nullptr;
    };
#ifdef CASCADE_SBML_MODULE
    void* const module = ::dlopen(CASCADE_SBML_MODULE, RTLD_LAZY | RTLD_LOCAL);
    if (module == nullptr) {
        const char* const reason = ::dlerror();
        return refuse(fmt::format("libSBML could not be loaded: {}",
                                  reason != nullptr ? reason : "unknown reason"),
                      "install libsbml5");
    }
    const auto entry = reinterpret_cast<SbmlReaderEntry*>(::dlsym(module, sbml_reader_symbol));
    SbmlReader* const reader = entry != nullptr ? entry(version()) : nullptr;
    if (reader != nullptr) return reader;
    return refuse(fmt::format("{} belongs to another build of this program", CASCADE_SBML_MODULE),
                  "install this program and its modules again");
#else
    return refuse("this build has no libSBML", "install libsbml5-dev and build Cascade again");
#endif
}

class SbmlScript {
public:
    SbmlScript(Import& import, const SbmlModel& model, Draft& draft)
        : import_(import), model_(model), draft_(draft) {}

    bool add() {
        for (const auto* const list : {&model_.constants, &model_.assignments}) {
            for (const SbmlQuantity& each : *list) own_[each.id] = names_.declare(each.id);
        }
        for (const SbmlRate& each : model_.rates) own_[each.id] = names_.declare(each.id);
        for (const SbmlQuantity& each : model_.constants) {
            draft_.parameters.push_back(fmt::format("{}: {}", own_[each.id], text(each.value)));
        }
        for (const SbmlQuantity& each : model_.assignments) {
            draft_.definitions.push_back(fmt::format("{} = {}", own_[each.id], text(each.value)));
        }
        for (const SbmlRate& each : model_.rates) add_rate(each);
        if (model_.rates.empty()) fail({import_.source, 0, 0}, "nothing in this model changes");
        add_space();
        return !failed_;
    }

private:
    void fail(Span span, std::string why, std::string hint = "") {
        if (!failed_) import_.diagnostics.error(span, std::move(why), std::move(hint));
        failed_ = true;
    }

    std::string text(const SbmlFormula& formula) { return write_formula(read(formula)); }

    Expression read(const SbmlFormula& formula) {
        const SourceId source = import_.sources.add(
            fmt::format("{}: the formula in line {}", import_.name, formula.line), formula.text);
        const Span span{source, 0, static_cast<std::uint32_t>(formula.text.size())};
        const auto tree = read_formula(span, import_.sources, import_.diagnostics, sbml_dialect);
        if (!tree) {
            failed_ = true;
            return number(0);
        }
        return replaced(*tree, [&](const Expression& part) { return meaning(part); });
    }

    std::optional<Expression> meaning(const Expression& part) {
        const std::string& word = part.text;
        if (part.kind == Expression::Kind::call) {
            if (word == "piecewise") return choice(part);
            if (auto found = meaning_of(part, sbml_functions)) return found;
            fail(part.span,
                 fmt::format("the function '{}' of {} arguments has no counterpart in Cascade",
                             word, part.of.size()));
            return std::nullopt;
        }
        if (const auto found = own_.find(word); found != own_.end()) return name(found->second);
        if (word == "sbml_time") return name("t");
        if (word == "pi") return name("pi");
        if (word == "exponentiale") return call("exp", {number(1)});
        if (word == "avogadro") return number(6.02214179e23);
        if (word == "true" || word == "false") return number(word == "true" ? 1 : 0);
        fail(part.span, fmt::format("'{}' has no meaning here", word));
        return std::nullopt;
    }

    /// piecewise(a, p, b, q, c): a if p is true, else b if q is true, else c.
    std::optional<Expression> choice(const Expression& part) {
        if (part.of.size() % 2 == 0) {
            fail(part.span, "a choice without a last value has no counterpart in Cascade");
            return std::nullopt;
        }
        Expression made = part.of.back();
        for (std::size_t k = part.of.size() - 1; k >= 2; k -= 2) {
            made = call("if", {part.of[k - 1], part.of[k - 2], std::move(made)});
        }
        return made;
    }

    void add_rate(const SbmlRate& each) {
        const std::string& own = own_[each.id];
        Expression rate = each.rule.text.empty() ? number(0) : read(each.rule);
        for (const auto& [factor, reaction] : each.reactions) {
            const Expression term = operation(number(std::abs(factor)), "*", name(own_[reaction]));
            rate = operation(std::move(rate), factor > 0 ? "+" : "-", term);
        }
        if (!each.compartment.empty()) {
            rate = operation(std::move(rate), "/", name(own_[each.compartment]));
        }
        if (const auto found = import_.diffusion.find(each.id); found != import_.diffusion.end()) {
            const Expression spread = operation(name(found->second), "*", call("lap", {name(own)}));
            rate = operation(spread, "+", std::move(rate));
        }
        draft_.starts.push_back(fmt::format("{}: {}", own, text(each.start)));
        draft_.rates.push_back(fmt::format("{}' = {}", own, write_formula(rate)));
    }

    void add_space() {
        const bool diffuses = !import_.diffusion.empty();
        for (const auto& [wanted, value] : import_.diffusion) {
            const bool exists = std::any_of(model_.rates.begin(), model_.rates.end(),
                                            [&](const auto& each) { return each.id == wanted; });
            if (!exists) {
                return fail({import_.source, 0, 0},
                            fmt::format("there is no species '{}' to diffuse", wanted));
            }
        }
        draft_.domain = {diffuses ? "grid: 128, 128" : "grid: 2"};
        if (!diffuses) {
            draft_.remarks.push_back(
                "The model has no space, so both cells do the same. --diffusion NAME=D lets "
                "species diffuse on a plane.");
        }
        draft_.speed = 0;  // The solver chooses the steps.
        draft_.stage = {"duration: 100", "solver: rk45"};
        if (!model_.rates.empty()) draft_.stage.push_back("show: " + own_[model_.rates[0].id]);
    }

    Import& import_;
    const SbmlModel& model_;
    Draft& draft_;
    FreeNames names_;
    std::map<std::string, std::string> own_;
    bool failed_ = false;
};

/// The beginning of a line of the file, for messages.
Span line_of_source(const Import& import, unsigned line) {
    const std::string_view bytes = import.bytes();
    std::size_t begin = 0;
    for (unsigned k = 1; k < line && begin < bytes.size(); ++k) {
        begin = std::min(bytes.find('\n', begin), bytes.size() - 1) + 1;
    }
    const std::size_t end = std::min(bytes.find('\n', begin), bytes.size());
    return {import.source, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
}

}  // namespace

std::optional<Draft> read_sbml(Import& import) {
    // Document types and deep elements are refused before libSBML reads the file.
    pugi::xml_document document;
    if (!read_xml(import, std::string_view::npos, document)) return std::nullopt;
    document.reset();
    SbmlReader* const reader = load_sbml_reader(import);
    if (reader == nullptr) return std::nullopt;
    const SbmlModel model = reader(std::string(import.bytes()));
    for (const auto& [line, why] : model.problems) {
        import.diagnostics.error(line_of_source(import, line), plain_line(why));
    }
    if (!model.problems.empty()) return std::nullopt;
    Draft draft;
    const std::string name = plain_line(model.name);
    draft.about = {fmt::format("{}, imported from a model in SBML: {}",
                               name.empty() ? "A model" : name, plain_line(import.name))};
    if (!SbmlScript(import, model, draft).add()) return std::nullopt;
    return draft;
}

}  // namespace cascade::importing

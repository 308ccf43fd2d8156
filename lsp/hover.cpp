// The meaning of a name: its doc comment, its value in the stage, its equation, and for a stage the
// wavelength of the pattern that its equations predict.
#include "analysis/stage_analysis.h"
#include "core/printable.h"
#include "core/utf8.h"
#include "lang/equations/equations.h"
#include "lang/print/library_note.h"
#include "lang/print/print_formula.h"
#include "lang/print/system_listing.h"
#include "lang/program/nodes_of_rates.h"
#include "lang/service/known_names.h"
#include "lsp/answers.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade::lsp {
namespace {

/// A longer value or equation is left out.
constexpr std::size_t most_characters = 400;

/// Waves are predicted only for systems within these limits, so that an answer takes milliseconds.
constexpr std::uint32_t most_species = 3;

/// Markdown: a line with the name and its kind, sentences, and lines of equations.
class Card {
public:
    Card(std::string_view name, std::string_view kind)
        : text_(fmt::format("**`{}`** {}", name, kind)) {}
    void add(std::string_view sentence) {
        if (sentence.empty()) return;
        text_ += "\n\n";
        for (const char c : printable_lines(sentence)) {
            if (std::string_view("\\`*_{}[]<>#|").find(c) != std::string_view::npos) text_ += '\\';
            text_ += c;
        }
    }
    void add_code(std::string_view lines) {
        const bool is_short = count_code_points(lines) <= most_characters;
        if (!lines.empty() && is_short) text_ += fmt::format("\n\n```text\n{}\n```", lines);
    }
    const std::string& text() const { return text_; }

private:
    std::string text_;
};

std::string without_last_line_end(std::string text) {
    if (text.ends_with('\n')) text.pop_back();
    return text;
}

std::string equations_of(const Script& script, std::string_view system) {
    return without_last_line_end(print_equations(script.tree, script.sources, system,
                                                 Notation::unicode, EquationParts::rates));
}

/// A sentence about the fastest wave that grows from the flat state of a stage. Empty if this wave
/// is unknown or would take long to find.
std::string prediction(const Program& program, std::uint32_t stage) {
    const System& system = program.system_of(stage);
    const bool is_cheap = !system.cells && !program.domain.model &&
                          system.species_count() <= most_species &&
                          !holds_in_rates(system, [](const Node& node) {
                              return node.calls(Function::convolve) || node.calls(Function::solved);
                          });
    if (!is_cheap) return "";
    const auto found = analysis::analyze_stage(program, stage);
    if (!found || found->states.empty()) return "";
    const analysis::StateAnalysis& state = analysis::state_to_show(*found);
    if (!state.relation.has_growing_waves()) return "";
    return fmt::format("Waves of {:.3g} cells grow fastest ({}).", state.relation.fastest.cells(),
                       analysis::values_text(found->model, state.state.species));
}

void add_system(Card& card, const Script& script, std::string_view name) {
    for (const std::string& words : system_words(script.tree, script.sources, name))
        card.add(words);
    if (const LibraryText* text = find_library_text(name)) card.add(note_of(*text).about);
    card.add_code(equations_of(script, name));
}

void add_stage(Card& card, const Script& script, std::string_view name) {
    const Program& program = *script.program;
    for (std::uint32_t k = 0; k < program.stages.size(); ++k) {
        if (program.stages[k].name != name) continue;
        card.add(fmt::format("A stage of {}.", program.system_of(k).name));
        card.add(prediction(program, k));
        card.add_code(equations_of(script, program.system_of(k).name));
    }
}

void add_item(Card& card, const Script& script, StageItem at) {
    const Program& program = *script.program;
    const System& system = program.system_of(at.stage);
    const Quantity& quantity = system.quantities[at.item];
    if (quantity.range) {
        card.add(fmt::format("From {} to {}.", quantity.range->low, quantity.range->high));
    }
    const Stage& stage = program.stages[at.stage];
    const std::string value =
        print_formula(program, system, stage.items[at.item], std::uint32_t(at.stage));
    card.add_code(fmt::format("{}.{}: {}", stage.name, quantity.name, value));
    if (quantity.is_species) {
        card.add_code(equation_in_unicode(script.tree, script.sources, system.name, quantity.name));
    }
}

/// The card of a function or constant that the script declares with `fn` or `let`.
std::optional<Card> card_of_function(Document& document, std::size_t byte) {
    const auto declared = document.names().declaration_at(static_cast<std::uint32_t>(byte));
    if (!declared) return std::nullopt;
    const Script& script = document.script();
    for (const ast::FunctionDefinition& function : script.tree.functions) {
        if (function.name.span != *declared) continue;
        Card card(function.name.text, function.is_constant ? "constant" : "function");
        card.add(function.doc);
        card.add_code(script.sources.text(function.span));
        return card;
    }
    return std::nullopt;
}

std::optional<Card> card_of(Document& document, std::size_t byte) {
    if (auto card = card_of_function(document, byte)) return card;
    const auto found = mention(document.text(), byte, document.program(), 0);
    if (!found || found->known.name.empty()) return std::nullopt;
    const KnownName& known = found->known;
    Card card(known.name, name_of(known.kind));
    card.add(known.note);
    const auto script = document.last_correct();
    if (!script) return card;
    if (found->item) add_item(card, *script, *found->item);
    if (known.kind == NameKind::system) add_system(card, *script, known.name);
    if (known.kind == NameKind::stage) add_stage(card, *script, known.name);
    if (known.kind == NameKind::definition) {
        for (const System& system : script->program->systems) {
            const std::string line =
                equation_in_unicode(script->tree, script->sources, system.name, known.name);
            if (!line.empty()) return card.add_code(line), card;
        }
    }
    return card;
}

}  // namespace

Result<Json> hover(const Asked& asked) {
    const std::string& text = asked.document.text();
    // The name is the word that contains this byte or ends directly before it.
    const std::size_t end = end_of_word(text, asked.byte);
    const std::size_t begin = end - last_word(std::string_view(text).substr(0, end)).size();
    if (begin == end) return Json();
    const auto card = card_of(asked.document, asked.byte);
    if (!card) return Json();
    return Json{{"contents", {{"kind", "markdown"}, {"value", card->text()}}},
                {"range", range_of(asked.document, begin, end)}};
}

}  // namespace cascade::lsp

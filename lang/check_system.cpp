// A `system` block: what it declares, its formulas, and the order of its definitions and rates.
#include "lang/check_blocks.h"
#include "lang/check_circles.h"

#include <fmt/format.h>

namespace cascade::checking {

namespace {

/// The sentences that make a rate.
struct RateSentences {
    const ast::Sentence* assignment = nullptr;
    std::vector<const ast::Sentence*> terms;
    bool empty() const { return assignment == nullptr && terms.empty(); }
};

class SystemChecker {
public:
    SystemChecker(Workspace& work, const ast::Script& script, const ast::Block& block,
                  std::uint32_t index)
        : work_(work), script_(script), block_(block), index_(index) {}

    void run();

private:
    System& system() { return work_.program.systems[index_]; }
    Scope scope(Place place) const {
        Scope result;
        result.place = place;
        result.system = index_;
        return result;
    }

    void declare(const ast::Sentence& sentence);
    bool can_declare(const ast::Word& name, const ast::Sentence& sentence);
    void declare_setting(const ast::Sentence& sentence);
    void collect_rate(const ast::Sentence& sentence);
    void report_no_species(const ast::Word& name, const Meaning* meaning);
    void check_values();
    void check_definitions();
    void check_rates();
    void check_invariants();
    void check_settings();
    void order_values();
    void order_steps();

    Workspace& work_;
    const ast::Script& script_;
    const ast::Block& block_;
    std::uint32_t index_;
    std::unordered_map<std::string, Span> declared_;
    std::vector<const ast::Sentence*> values_, definitions_, invariants_, settings_;
    std::vector<const ast::Sentence*> rate_sentences_;
    std::vector<RateSentences> rates_;
};

void SystemChecker::run() {
    for (const ast::Sentence& sentence : block_.sentences) {
        if (sentence.name.empty() || sentence.values.empty()) continue;
        declare(sentence);
    }
    work_.names[index_] = names_of(system());
    rates_.resize(system().quantities.size());
    for (const ast::Sentence* sentence : rate_sentences_) collect_rate(*sentence);
    if (rate_sentences_.empty()) {
        work_.diagnostics.error(block_.name.span,
                                fmt::format("system '{}' has no rates", block_.name.text),
                                "a rate is written name' = …");
    }
    work_.items_read[index_].assign(system().item_count(), false);
    work_.definitions_read[index_].assign(system().definitions.size(), false);
    check_values();
    check_definitions();
    check_rates();
    check_invariants();
    check_settings();
    order_values();
    order_steps();
}

bool SystemChecker::can_declare(const ast::Word& name, const ast::Sentence& sentence) {
    const Reserved kind = reserved(name.text);
    if (kind == Reserved::later_setting) {
        work_.diagnostics.error(
            name.span, fmt::format("'{}' is not in this version of the language", name.text));
        return false;
    }
    if (kind == Reserved::builtin || kind == Reserved::later_builtin) {
        work_.diagnostics.error(
            name.span, fmt::format("'{}' is built in and cannot be declared", name.text));
        return false;
    }
    if (kind == Reserved::setting && sentence.kind == ast::SentenceKind::definition) {
        work_.diagnostics.error(name.span,
                                fmt::format("'{}' is a setting and no definition", name.text),
                                fmt::format("write {}: …", name.text));
        return false;
    }
    const auto [first, is_new] = declared_.try_emplace(std::string(name.text), name.span);
    if (is_new) return true;
    report_twice(work_, name.span, first->second,
                 fmt::format("'{}' is given a value twice", name.text));
    return false;
}

void SystemChecker::declare(const ast::Sentence& sentence) {
    switch (sentence.kind) {
        case ast::SentenceKind::value: {
            if (!can_declare(sentence.name, sentence)) return;
            if (reserved(sentence.name.text) == Reserved::setting) {
                settings_.push_back(&sentence);
                return;
            }
            values_.push_back(&sentence);
            Quantity quantity;
            quantity.name = std::string(sentence.name.text);
            quantity.span = sentence.name.span;
            system().quantities.push_back(std::move(quantity));
            return;
        }
        case ast::SentenceKind::definition:
            if (!can_declare(sentence.name, sentence)) return;
            definitions_.push_back(&sentence);
            system().definitions.push_back(
                {std::string(sentence.name.text), sentence.name.span, {}});
            return;
        case ast::SentenceKind::index: return;
        case ast::SentenceKind::rate:
        case ast::SentenceKind::rate_term: rate_sentences_.push_back(&sentence); return;
        case ast::SentenceKind::at_least:
        case ast::SentenceKind::at_most: invariants_.push_back(&sentence); return;
    }
}

/// A rate of something that is no species: said once, later readers of the name stay silent.
void SystemChecker::report_no_species(const ast::Word& name, const Meaning* meaning) {
    if (meaning != nullptr && meaning->is_definition) {
        work_.diagnostics.error(name.span,
                                fmt::format("'{}' is a definition and has no rate", name.text));
        return;
    }
    if (reserved(name.text) != Reserved::no) {
        work_.diagnostics.error(name.span, fmt::format("'{}' has no rate", name.text));
        return;
    }
    std::string hint;
    if (!is_hopeless(work_)) hint = did_you_mean(work_, name.text, quantity_names(system()));
    if (hint.empty()) hint = fmt::format("add {}: …", name.text);
    work_.diagnostics.error(name.span,
                            fmt::format("species '{}' has no starting value", name.text),
                            std::move(hint));
    work_.names[index_].emplace(std::string(name.text), Meaning{false, 0, true});
}

/// A name with a rate is a species.
void SystemChecker::collect_rate(const ast::Sentence& sentence) {
    const std::string_view name = sentence.name.text;
    const Meaning* meaning = find(work_.names[index_], name);
    const bool is_quantity = meaning != nullptr && !meaning->is_definition &&
                             meaning->index < system().quantities.size();
    if (meaning != nullptr && meaning->is_faulty) return;
    if (!is_quantity) return report_no_species(sentence.name, meaning);
    system().quantities[meaning->index].is_species = true;
    RateSentences& rate = rates_[meaning->index];
    if (sentence.kind == ast::SentenceKind::rate_term) {
        rate.terms.push_back(&sentence);
    } else if (rate.assignment == nullptr) {
        rate.assignment = &sentence;
    } else {
        report_twice(work_, sentence.name.span, rate.assignment->name.span,
                     fmt::format("the rate of '{}' is given twice", name));
    }
}

void SystemChecker::check_values() {
    for (std::size_t i = 0; i < values_.size(); ++i) {
        if (!has_one_value(work_, script_, *values_[i])) continue;
        auto checked = check_number(work_, script_, values_[i]->values[0], scope(Place::value));
        if (!checked) continue;
        mark_reads(work_, checked->formula, index_);
        system().quantities[i].start = std::move(checked->formula);
    }
}

void SystemChecker::check_definitions() {
    for (std::size_t i = 0; i < definitions_.size(); ++i) {
        if (!has_one_value(work_, script_, *definitions_[i])) continue;
        auto checked =
            check_number(work_, script_, definitions_[i]->values[0], scope(Place::rate));
        if (!checked) continue;
        mark_reads(work_, checked->formula, index_);
        system().definitions[i].formula = std::move(checked->formula);
    }
}

/// Appends a term to a sum.
void superpose(Formula& sum, Formula term) {
    if (sum.nodes.empty()) {
        sum = std::move(term);
        return;
    }
    const auto shift = static_cast<std::uint32_t>(sum.nodes.size());
    for (Node& node : term.nodes) {
        for (std::uint32_t& operand : node.operands) operand += shift;
        sum.nodes.push_back(node);
    }
    Node addition;
    addition.kind = NodeKind::call;
    addition.function = Function::add;
    addition.span = sum.nodes.back().span;
    addition.operands = {shift - 1, static_cast<std::uint32_t>(sum.nodes.size() - 1), 0, 0};
    sum.nodes.push_back(addition);
}

void SystemChecker::check_rates() {
    system().rates.resize(system().quantities.size());
    for (std::size_t i = 0; i < rates_.size(); ++i) {
        std::vector<const ast::Sentence*> sentences = rates_[i].terms;
        if (rates_[i].assignment != nullptr) {
            sentences.insert(sentences.begin(), rates_[i].assignment);
        }
        for (const ast::Sentence* sentence : sentences) {
            if (!has_one_value(work_, script_, *sentence)) continue;
            auto checked = check_number(work_, script_, sentence->values[0], scope(Place::rate));
            if (!checked) continue;
            mark_reads(work_, checked->formula, index_);
            superpose(system().rates[i], std::move(checked->formula));
        }
    }
}

void SystemChecker::check_invariants() {
    for (const ast::Sentence* sentence : invariants_) {
        const Meaning* meaning = find(work_.names[index_], sentence->name.text);
        if (meaning != nullptr && meaning->is_faulty) continue;
        if (meaning == nullptr || meaning->is_definition || !system().is_species(meaning->index)) {
            std::vector<std::string> species;
            for (const Quantity& quantity : system().quantities) {
                if (quantity.is_species && !is_hopeless(work_)) species.push_back(quantity.name);
            }
            std::string hint = did_you_mean(work_, sentence->name.text, species);
            work_.diagnostics.error(sentence->name.span,
                                    fmt::format("'{}' is not a species of {}",
                                                sentence->name.text, system().name),
                                    std::move(hint));
            continue;
        }
        if (!has_one_value(work_, script_, *sentence)) continue;
        auto checked = check_number(work_, script_, sentence->values[0], scope(Place::bound));
        if (!checked) continue;
        mark_reads(work_, checked->formula, index_);
        system().invariants.push_back({meaning->index,
                                       sentence->kind == ast::SentenceKind::at_least,
                                       std::move(checked->formula)});
    }
}

void SystemChecker::check_settings() {
    Settings settings;
    for (const ast::Sentence* sentence : settings_) {
        check_setting(work_, script_, *sentence, scope(Place::value), settings);
    }
    for (const auto* formula : {&settings.frozen, &settings.speed, &settings.show}) {
        if (*formula) mark_reads(work_, **formula, index_);
    }
    system().settings = std::move(settings);
}

/// Defaults that need each other are a fault of the system, whatever its stages replace.
void SystemChecker::order_values() {
    std::vector<const Formula*> items;
    for (const Quantity& quantity : system().quantities) items.push_back(&quantity.start);
    const Settings& settings = system().settings;
    items.push_back(settings.frozen ? &*settings.frozen : nullptr);
    items.push_back(settings.speed ? &*settings.speed : nullptr);
    const Order order = topological_order(item_dependencies(items));
    const std::vector<bool> from_system(items.size(), false);
    for (const auto& circle : order.circles) {
        report_item_circle(work_, system(), items, from_system, circle);
    }
}

/// Puts definitions behind those they read and finds the order of the rates.
void SystemChecker::order_steps() {
    System& target = system();
    const Order order = topological_order(step_dependencies(target));
    for (const auto& circle : order.circles) report_step_circle(work_, target, circle);
    const auto count = static_cast<std::uint32_t>(target.definitions.size());
    std::vector<std::uint32_t> position(count);
    std::vector<Definition> definitions;
    std::vector<bool> read;
    for (const std::uint32_t value : order.order) {
        if (value < count) {
            position[value] = static_cast<std::uint32_t>(definitions.size());
            definitions.push_back(std::move(target.definitions[value]));
            read.push_back(work_.definitions_read[index_][value]);
        } else if (target.quantities[value - count].is_species) {
            target.rate_order.push_back(value - count);
        }
    }
    target.definitions = std::move(definitions);
    work_.definitions_read[index_] = std::move(read);
    const auto renumber = [&](Formula& formula) {
        for (Node& node : formula.nodes) {
            if (node.kind == NodeKind::definition) node.index = position[node.index];
        }
    };
    for (Definition& definition : target.definitions) renumber(definition.formula);
    for (Formula& rate : target.rates) renumber(rate);
    for (auto& [name, meaning] : work_.names[index_]) {
        if (meaning.is_definition) meaning.index = position[meaning.index];
    }
}

}  // namespace

void check_system(Workspace& work, const ast::Script& script, const ast::Block& block,
                  bool built_in) {
    System system;
    system.name = std::string(block.name.text);
    system.span = block.name.span;
    system.built_in = built_in;
    const auto index = static_cast<std::uint32_t>(work.program.systems.size());
    const auto [found, is_new] = work.systems.try_emplace(system.name, index);
    if (!is_new && !block.name.empty()) {
        const System& first = work.program.systems[found->second];
        if (first.built_in) {
            found->second = index;  // The script's own takes the place of the library's.
        } else {
            report_twice(work, block.name.span, first.span,
                         fmt::format("there are two systems '{}'", system.name));
        }
    }
    work.program.systems.push_back(std::move(system));
    work.names.emplace_back();
    work.items_read.emplace_back();
    work.definitions_read.emplace_back();
    SystemChecker(work, script, block, index).run();
}

}  // namespace cascade::checking

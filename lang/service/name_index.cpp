// The check records what the names of systems and stages refer to. The names of functions, indices
// and shapes have the same meaning everywhere, so the uses of these names are found in the syntax
// tree alone.
#include "lang/service/name_index.h"

#include "lang/check/check.h"
#include "lang/service/known_names.h"
#include "lang/syntax/index_words.h"
#include "lang/syntax/parse.h"
#include "lang/syntax/picture_expression.h"
#include "lang/vocabulary/greek_letters.h"
#include "lang/vocabulary/subscripts.h"
#include "lang/vocabulary/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace cascade {
namespace {

using Declared = std::unordered_map<std::string_view, Span>;

/// Finds the uses of those names whose meaning the syntax tree alone determines.
class TreeNames {
    /// How many levels of bases are searched for indices.
    static constexpr int most_levels = 1000;

public:
    TreeNames(const ast::Script& tree, NameUses& uses) : tree_(tree), uses_(uses) {}

    void run() {
        for (const ast::FunctionDefinition& function : tree_.functions) declare(function);
        for (const ast::FunctionDefinition& function : tree_.functions) find_parameters(function);
        for (ast::ExprId id = 0; id < tree_.expressions.size(); ++id) {
            const ast::Expr& expr = tree_.expressions[id];
            const auto* call = std::get_if<ast::Call>(&expr.node);
            if (call && !is_unit_call(call->function.text)) use_function(call->function);
            const auto* name = std::get_if<ast::Name>(&expr.node);
            const bool is_free = name != nullptr && !parameters_.contains(id);
            if (is_free && constants_.contains(name->name)) use_function({expr.span, name->name});
        }
        for (const ast::Block& block : tree_.blocks) {
            const bool is_system = block.kind == ast::BlockKind::system && !block.name.empty();
            if (is_system) systems_.try_emplace(block.name.text, &block);
        }
        for (const ast::Block& block : tree_.blocks) find_indices(block);
        if (const auto shape = picture_expression(tree_, "shape")) use_shape(*shape);
    }

private:
    void add(Span use, Span declaration) { uses_.push_back({use, declaration}); }

    void declare(const ast::FunctionDefinition& function) {
        if (function.name.empty()) return;
        functions_.try_emplace(function.name.text, function.name.span);
        if (function.is_constant) constants_.try_emplace(function.name.text, function.name.span);
        add(function.name.span, function.name.span);
    }

    void use_function(const ast::Word& name) {
        const auto found = functions_.find(name.text);
        if (found != functions_.end()) add(name.span, found->second);
    }

    void find_parameters(const ast::FunctionDefinition& function) {
        if (function.span.end == 0) return;
        Declared own;
        for (const ast::Word& parameter : function.parameters) {
            own.try_emplace(parameter.text, parameter.span);
            add(parameter.span, parameter.span);
        }
        for (ast::ExprId id = function.body.first; id <= function.body.root; ++id) {
            const ast::Expr& expr = tree_.expressions[id];
            const auto* name = std::get_if<ast::Name>(&expr.node);
            if (name == nullptr) continue;
            auto found = own.find(name->name);
            Span use = expr.span;
            if (const auto parts = subscripted_name(name->name); parts && found == own.end()) {
                found = own.find(parts->of);
                use.end -= static_cast<std::uint32_t>(parts->axes.size() + 1);
            }
            if (found == own.end()) continue;
            add(use, found->second);
            parameters_.insert(id);
        }
    }

    /// The indices that a block and its bases declare. An index of the block replaces an index of
    /// the same name in a base.
    Declared indices_of(const ast::Block& block) const {
        Declared indices;
        const ast::Block* next = &block;
        for (int level = 0; next != nullptr && level < most_levels; ++level) {
            for (const ast::Statement& statement : next->statements) {
                if (statement.kind == ast::StatementKind::index)
                    indices.try_emplace(statement.name.text, statement.name.span);
            }
            const auto base = systems_.find(next->base.text);
            const bool is_other = base != systems_.end() && base->second != next;
            next = is_other ? base->second : nullptr;
        }
        return indices;
    }

    void find_indices(const ast::Block& block) {
        const Declared indices = indices_of(block);
        if (indices.empty()) return;
        const auto use = [&](std::string_view name, Span span) {
            const auto found = indices.find(name);
            if (found != indices.end()) add(span, found->second);
        };
        const auto use_in = [&](ast::Expression expression) {
            for (ast::ExprId id = expression.first; id <= expression.root; ++id) {
                const ast::Expr& expr = tree_.expressions[id];
                if (const auto* name = std::get_if<ast::Name>(&expr.node))
                    use(name->name, expr.span);
                if (const auto* over = std::get_if<ast::Over>(&expr.node))
                    use(over->index.text, over->index.span);
            }
        };
        for (const auto* statements : {&block.statements, &block.sides}) {
            for (const ast::Statement& statement : *statements) {
                if (statement.kind == ast::StatementKind::index)
                    use(statement.name.text, statement.name.span);
                for (const ast::Word& word : words_of_index(statement.index))
                    use(word.text, word.span);
                for (const ast::Expression& value : statement.values) use_in(value);
            }
        }
    }

    void use_shape(ast::Expression said) {
        const ast::Expr& expr = tree_.expressions[said.root];
        const auto* name = std::get_if<ast::Name>(&expr.node);
        for (const ast::Block& block : tree_.blocks) {
            const bool is_it = name != nullptr && block.kind == ast::BlockKind::shape &&
                               block.name.text == name->name;
            if (is_it) add(expr.span, block.name.span);
        }
    }

    const ast::Script& tree_;
    NameUses& uses_;
    Declared functions_, constants_;
    /// The system blocks by name.
    std::unordered_map<std::string_view, const ast::Block*> systems_;
    /// The expressions that use parameters of functions.
    std::unordered_set<ast::ExprId> parameters_;
};

/// The part of a span that is a name. The span may begin with a bracket and end with an index.
Span name_in(Span span, const Sources& sources) {
    const std::string_view text = sources[span.source].text();
    if (span.begin < text.size() && text[span.begin] == '[') ++span.begin;
    const auto end = static_cast<std::uint32_t>(end_of_word(text, span.begin));
    // In u_xx, which means dxx(u), the name is u.
    const bool is_subscripted = span.end > span.begin && span.end < end && text[span.end] == '_';
    if (!is_subscripted) span.end = end;
    return span;
}

auto key_of(Span span) { return std::tuple(span.source, span.begin); }

}  // namespace

NameIndex::NameIndex(const ast::Script& tree, const Diagnostics& read, Sources& sources,
                     SourceId text)
    : sources_(sources), text_(text) {
    const auto note_source = [&](Span span) {
        const bool is_known = span.source == text || std::ranges::count(used_, span.source) > 0;
        if (!is_known) used_.push_back(span.source);
    };
    for (const ast::Block& block : tree.blocks) note_source(block.keyword.span);
    for (const ast::FunctionDefinition& function : tree.functions) note_source(function.name.span);
    NameUses uses;
    // If `read` has errors, check() skips everything that needs a tree without errors.
    Diagnostics diagnostics = read;
    check(tree, sources, diagnostics, &uses);
    errors_ = diagnostics.error_count();
    TreeNames(tree, uses).run();
    add(uses);
}

/// Adds uses of names. Words that refer to each other, directly or through other words, form a
/// group.
void NameIndex::add(const NameUses& uses) {
    std::map<std::tuple<SourceId, std::uint32_t>, std::size_t> number;
    NameUses named;
    for (const NameUse& each : uses) {
        const NameUse of{name_in(each.use, sources_), name_in(each.declaration, sources_)};
        if (of.use.begin == of.use.end || of.declaration.begin == of.declaration.end) continue;
        number.try_emplace(key_of(of.use));
        number.try_emplace(key_of(of.declaration));
        named.push_back(of);
    }
    std::size_t count = 0;
    for (auto& [key, each] : number) each = count++;
    words_.resize(count);
    for (std::size_t k = 0; k < count; ++k) words_[k] = {{}, k, k};
    const auto first_of = [&](std::size_t k) {
        while (words_[k].group != k) k = words_[k].group = words_[words_[k].group].group;
        return k;
    };
    for (const NameUse& each : named) {
        const std::size_t use = number.at(key_of(each.use)),
                          declaration = number.at(key_of(each.declaration));
        words_[use].span = each.use;
        words_[declaration].span = each.declaration;
        const bool is_declared = words_[use].declaration != use;
        if (!is_declared && use != declaration) words_[use].declaration = declaration;
        const std::size_t a = first_of(use), b = first_of(declaration);
        words_[std::max(a, b)].group = std::min(a, b);
    }
    // If a declaration replaces another declaration, its name refers to both. In this case the name
    // counts as its own declaration.
    for (const NameUse& each : named) {
        if (each.use == each.declaration) {
            const std::size_t k = number.at(key_of(each.use));
            words_[k].declaration = k;
        }
    }
    for (std::size_t k = 0; k < count; ++k) words_[k].group = first_of(k);
}

const NameIndex::Word* NameIndex::find(std::uint32_t byte) const {
    const auto after = std::ranges::upper_bound(words_, std::tuple(text_, byte), {},
                                                [](const Word& word) { return key_of(word.span); });
    if (after == words_.begin()) return nullptr;
    const Word& word = *std::prev(after);
    return word.span.source == text_ && byte <= word.span.end ? &word : nullptr;
}

std::optional<Span> NameIndex::name_at(std::uint32_t byte) const {
    const Word* const word = find(byte);
    if (word == nullptr) return std::nullopt;
    return word->span;
}

std::optional<Span> NameIndex::declaration_at(std::uint32_t byte) const {
    const Word* const word = find(byte);
    if (word == nullptr) return std::nullopt;
    return words_[word->declaration].span;
}

std::vector<Span> NameIndex::uses_at(std::uint32_t byte) const {
    std::vector<Span> spans;
    const Word* const word = find(byte);
    for (const Word& each : words_) {
        if (word != nullptr && each.group == word->group) spans.push_back(each.span);
    }
    return spans;
}

/// For each word of the text, in order, a number that is the same for all words with the same
/// meaning.
std::vector<std::size_t> NameIndex::meanings() const {
    std::map<std::size_t, std::size_t> numbers;
    std::vector<std::size_t> result;
    for (const Word& word : words_) {
        if (word.span.source == text_)
            result.push_back(numbers.try_emplace(word.group, numbers.size()).first->second);
    }
    return result;
}

Result<std::string> NameIndex::renamed(std::uint32_t byte, std::string_view name) const {
    const auto written = name_at(byte);
    if (!written) return failure("this is not a name that can be changed");
    const std::string_view before = sources_.text(*written);
    if (name.empty() || end_of_word(name, 0) != name.size() || is_digit(name.front()))
        return failure(fmt::format("'{}' is not a name", name), "names are letters, digits and _");
    const std::string_view text = sources_[text_].text();
    std::string changed;
    std::size_t done = 0;
    for (const Span use : uses_at(byte)) {
        if (use.source != text_) {
            return failure(fmt::format("'{}' is also a name in {}", before,
                                       sources_[use.source].name()),
                           "rename it by hand in every file that uses it");
        }
        changed.append(text.substr(done, use.begin - done)).append(name);
        done = use.end;
    }
    changed.append(text.substr(done));
    Sources sources;
    Diagnostics diagnostics;
    const SourceId source = sources.add(sources_[text_].name(), changed);
    ast::Script tree = parse(source, sources, diagnostics);
    for (const SourceId used : used_) {
        const SourceId copy =
            sources.add(sources_[used].name(), std::string(sources_[used].text()));
        parse_used(copy, sources, tree, diagnostics);
    }
    const NameIndex after(tree, diagnostics, sources, source);
    if (after.errors_ > errors_ || after.meanings() != meanings()) {
        return failure(fmt::format("'{}' cannot be called '{}' here", before, name),
                       "this name already has another meaning");
    }
    return changed;
}

}  // namespace cascade

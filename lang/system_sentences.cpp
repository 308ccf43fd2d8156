#include "lang/system_sentences.h"

#include "lang/library.h"
#include "lang/parse.h"

#include <fmt/format.h>

#include <string>

namespace cascade {

namespace {

bool is_rate(const ast::Sentence& sentence) {
    return sentence.kind == ast::SentenceKind::rate ||
           sentence.kind == ast::SentenceKind::rate_term;
}

/// What a sentence is about. One of a derived system takes the place of those of its bases about
/// the same, unless it is a term to be added.
std::string subject_of(const ast::Sentence& sentence) {
    const auto kind = is_rate(sentence) ? ast::SentenceKind::rate : sentence.kind;
    return fmt::format("{} {}[{}]", static_cast<int>(kind), sentence.name.text,
                       sentence.index.text);
}

}  // namespace

SystemSentences::SystemSentences(const ast::Script& script, const Sources& sources,
                                 std::string_view system) {
    std::vector<Place> chain;  // From the system to the one that is derived from none.
    Place place = find_block(script, sources, system);
    if (place.block == nullptr) place = find_in_library(system);
    constexpr std::size_t longest_chain = 1000;  // The checks allow no circle.
    while (place.block != nullptr && chain.size() < longest_chain) {
        chain.push_back(place);
        const std::string_view base = place.block->base.text;
        if (base.empty()) break;
        // `system a: a { … }` changes the library's a.
        const bool is_own_name = base == place.block->name.text;
        place = is_own_name ? Place{} : find_block(*place.script, *place.sources, base);
        if (place.block == nullptr) place = find_in_library(base);
    }
    found_ = !chain.empty();
    if (found_) doc_ = chain.front().block->doc;
    for (auto each = chain.rbegin(); each != chain.rend(); ++each) {
        std::unordered_set<std::string> replaced;
        for (const ast::Sentence& sentence : each->block->sentences) {
            if (sentence.kind == ast::SentenceKind::rate_term) continue;
            replaced.insert(subject_of(sentence));
        }
        std::erase_if(sentences_, [&](const SaidSentence& said) {
            return replaced.contains(subject_of(*said.sentence));
        });
        for (const ast::Sentence& sentence : each->block->sentences) {
            sentences_.push_back({each->script, each->sources, &sentence});
        }
    }
    for (const SaidSentence& said : sentences_) {
        if (is_rate(*said.sentence)) species_.insert(said.sentence->name.text);
    }
}

SystemSentences::Place SystemSentences::find_block(const ast::Script& script,
                                                   const Sources& sources,
                                                   std::string_view system) {
    for (const ast::Block& block : script.blocks) {
        const bool is_it = block.kind == ast::BlockKind::system && block.name.text == system;
        if (is_it) return {&script, &sources, &block};
    }
    return {};
}

SystemSentences::Place SystemSentences::find_in_library(std::string_view system) {
    const LibraryText* const text = find_library_text(system);
    if (text == nullptr) return {};
    LibraryScript& read = library_.emplace_back();
    Diagnostics never_any;
    const SourceId source =
        read.sources.add(std::string(text->file_name), std::string(text->text));
    read.script = parse(source, read.sources, never_any);
    return find_block(read.script, read.sources, system);
}

}  // namespace cascade

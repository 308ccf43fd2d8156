// What a system says, with what it takes from the systems it is derived from (internal to the
// printing of equations).
#pragma once

#include "core/source.h"
#include "lang/syntax/ast.h"

#include <deque>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace cascade {

/// A sentence and the script that its expressions are in.
struct SaidSentence {
    const ast::Script* script = nullptr;
    const Sources* sources = nullptr;
    const ast::Sentence* sentence = nullptr;
    /// The sentence that has its doc comment, and the one that has its range: where it took the
    /// place of another and has none, that of the other. Null where there is none.
    const ast::Sentence* doc = nullptr;
    const ast::Sentence* range = nullptr;
    const ast::Script* range_script = nullptr;
    const Sources* range_sources = nullptr;
};

/// The `system` blocks of a script by name.
using SystemBlocks = std::unordered_map<std::string_view, const ast::Block*>;
SystemBlocks system_blocks(const ast::Script& script);

/// The sentences of a system of a checked script or of the library, those of its bases first and
/// changed as `system b: a { … }` changes them.
class SystemSentences {
public:
    /// `blocks` are those of `script`.
    SystemSentences(const ast::Script& script, const Sources& sources, const SystemBlocks& blocks,
                    std::string_view system);

    /// False if there is no such system.
    bool found() const { return found_; }
    const std::vector<SaidSentence>& all() const { return sentences_; }
    /// The doc comment of the system itself; may be empty.
    const std::string& doc() const { return doc_; }
    /// Is this the name, without index, of something with a rate?
    bool is_species(std::string_view name) const { return species_.contains(name); }

private:
    struct LibraryScript {
        Sources sources;
        ast::Script script;
        SystemBlocks blocks;
    };
    struct Place {
        const ast::Script* script = nullptr;
        const Sources* sources = nullptr;
        const SystemBlocks* blocks = nullptr;  ///< Of that script.
        const ast::Block* block = nullptr;
    };
    /// The place in the script of `beside`.
    static Place find_block(Place beside, std::string_view system);
    Place find_in_library(std::string_view system);
    void derive(const Place& place);

    std::deque<LibraryScript> library_;
    std::vector<SaidSentence> sentences_;
    std::unordered_set<std::string_view> species_;
    std::string doc_;
    bool found_ = false;
};

}  // namespace cascade

// Checks a script only when its checked form is needed, and at most once for each version of the
// text.
#include "lsp/document.h"

#include "lsp/file_uri.h"

#include <algorithm>

namespace cascade::lsp {

Document::Document(std::string uri, std::string text, ColumnUnit unit, OpenFiles open)
    : uri_(std::move(uri)),
      text_(std::move(text)),
      path_(path_of_uri(uri_)),
      unit_(unit),
      lines_(text_, unit),
      open_(std::move(open)) {}

void Document::set_text(std::string text) {
    text_ = std::move(text);
    lines_ = Lines(text_, unit_);
    forget();
}

void Document::replace(Position from, Position to, std::string_view text) {
    std::size_t begin = lines_.byte_at(text_, from), end = lines_.byte_at(text_, to);
    if (begin > end) std::swap(begin, end);
    std::string changed = std::move(text_);
    changed.replace(begin, end - begin, text);
    set_text(std::move(changed));
}

void Document::forget() {
    names_.reset();
    script_.reset();
    is_changed = true;
}

std::shared_ptr<Script> Document::load() {
    const std::filesystem::path folder = path_ ? path_->parent_path() : ".";
    const auto load = [&](Overrides overrides) {
        return load_script(path_ ? path_->string() : uri_, text_, folder, std::move(overrides));
    };
    Script script = load({});
    if (!script.tree.uses.empty()) {
        Overrides overrides;
        for (auto& [path, text] : open_()) {
            overrides.used.emplace_back(path.lexically_relative(folder).generic_string(),
                                        std::move(text));
        }
        if (!overrides.used.empty()) script = load(std::move(overrides));
    }
    return std::make_shared<Script>(std::move(script));
}

Script& Document::script() {
    if (!script_) {
        names_.reset();
        script_ = load();
        if (script_->program) correct_ = script_;
    }
    return *script_;
}

std::shared_ptr<const Script> Document::last_correct() {
    script();
    return correct_;
}

const Program& Document::program() {
    static const Program none;
    const auto correct = last_correct();
    return correct ? *correct->program : none;
}

const NameIndex& Document::names() {
    Script& script = this->script();
    if (!names_) {
        names_ = std::make_unique<NameIndex>(script.tree, script.diagnostics, script.sources,
                                             own_source);
    }
    return *names_;
}

}  // namespace cascade::lsp

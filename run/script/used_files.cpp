// Works through a list that grows as used files use others; each file is parsed once.
#include "run/script/used_files.h"

#include "lang/syntax/parse.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <unordered_map>

namespace cascade {

namespace {

constexpr std::size_t most_files = 1000;

class UsedFiles {
public:
    explicit UsedFiles(Script& script) : script_(script) {
        taken_.insert(std::filesystem::path(script.name).filename().generic_string());
    }

    void run() {
        // Each file appends the files that it uses to the list.
        for (std::size_t k = 0; k < script_.tree.uses.size(); ++k) {
            const ast::Use use = script_.tree.uses[k];
            const auto folder = folders_.find(use.span.source);
            const std::filesystem::path from =
                folder == folders_.end() ? std::filesystem::path() : folder->second;
            const std::filesystem::path path = (from / use.path).lexically_normal();
            if (!taken_.insert(path.generic_string()).second) continue;
            if (taken_.size() > most_files) {
                return script_.diagnostics.error(
                    use.span, fmt::format("a script uses at most {} files", most_files));
            }
            const auto text = text_of(path.generic_string(), use);
            if (text) add(path, *text);
        }
    }

private:
    std::optional<std::string> text_of(const std::string& path, const ast::Use& use);
    void add(const std::filesystem::path& path, const std::string& text);
    void set_folder_of_files(ast::ExprId first, const std::filesystem::path& folder);

    Script& script_;
    std::set<std::string> taken_;  ///< Paths relative to the script's folder.
    std::unordered_map<SourceId, std::filesystem::path> folders_;
};

std::optional<std::string> UsedFiles::text_of(const std::string& path, const ast::Use& use) {
    auto& known = script_.overrides.used;
    const auto found = std::find_if(known.begin(), known.end(),
                                    [&](const auto& each) { return each.first == path; });
    if (found != known.end()) return found->second;
    auto text = GrantedFiles(script_.folder, script_.overrides.reads).read(path, largest_script);
    if (!text) {
        script_.diagnostics.error(use.span, text.error().message, text.error().hint);
        return std::nullopt;
    }
    known.emplace_back(path, *text);
    return std::move(*text);
}

void UsedFiles::add(const std::filesystem::path& path, const std::string& text) {
    const std::string name = (script_.folder == "." ? path : script_.folder / path).string();
    const SourceId source = script_.sources.add(name, text);
    folders_[source] = path.parent_path();
    const auto first = static_cast<ast::ExprId>(script_.tree.expressions.size());
    parse_used(source, script_.sources, script_.tree, script_.diagnostics);
    set_folder_of_files(first, path.parent_path());
}

/// Paths of data files in a used file are relative to that file's folder.
void UsedFiles::set_folder_of_files(ast::ExprId first, const std::filesystem::path& folder) {
    if (folder.empty()) return;
    auto& expressions = script_.tree.expressions;
    for (ast::ExprId id = first; id < expressions.size(); ++id) {
        const auto* call = std::get_if<ast::Call>(&expressions[id].node);
        const bool names_file =
            call != nullptr && (call->function.text == "field" || call->function.text == "image");
        if (!names_file) continue;
        for (std::uint32_t k = 0; k < call->argument_count; ++k) {
            ast::Expr& argument = expressions[script_.tree.arguments[call->first_argument + k]];
            auto* text = std::get_if<ast::Text>(&argument.node);
            if (text != nullptr) text->value = (folder / text->value).generic_string();
        }
    }
}

}  // namespace

void load_used_files(Script& script) { UsedFiles(script).run(); }

}  // namespace cascade

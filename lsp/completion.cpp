// The names that may be written at a position.
#include "lang/service/known_names.h"
#include "lsp/answers.h"
#include "lsp/kinds.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade::lsp {
namespace {

Json item_of(const KnownName& known, const Json& range) {
    Json item = {{"label", known.name},
                 {"kind", numbers_of(known.kind).completion},
                 {"detail", name_of(known.kind)},
                 {"textEdit", {{"range", range}, {"newText", known.name}}}};
    if (!known.note.empty()) item["documentation"] = known.note;
    return item;
}

/// The functions and constants that the script and the files that it uses declare.
std::vector<KnownName> own_functions(const Script& script) {
    std::vector<KnownName> names;
    for (const ast::FunctionDefinition& function : script.tree.functions) {
        if (function.name.empty()) continue;
        const auto kind = function.is_constant ? NameKind::value : NameKind::function;
        names.push_back({std::string(function.name.text), kind, function.doc});
    }
    return names;
}

}  // namespace

Result<Json> completion(const Asked& asked) {
    Document& document = asked.document;
    const std::string_view before = std::string_view(document.text()).substr(0, asked.byte);
    std::vector<KnownName> names = completions(before, asked.byte, document.program());
    // Functions are allowed wherever a value may be written.
    const bool is_value = std::ranges::any_of(names, [](const KnownName& name) {
        return name.kind == NameKind::function;
    });
    if (is_value) {
        for (KnownName& name : own_functions(document.script())) {
            if (std::ranges::find(names, name.name, &KnownName::name) == names.end())
                names.push_back(std::move(name));
        }
    }
    const Json range = range_of(document, asked.byte - last_word(before).size(), asked.byte);
    Json items = Json::array();
    for (const KnownName& known : names) items.push_back(item_of(known, range));
    return Json{{"isIncomplete", false}, {"items", std::move(items)}};
}

}  // namespace cascade::lsp

// Finds the declaration and the uses of a name, and renames it.
#include "lsp/answers.h"

namespace cascade::lsp {
namespace {

std::uint32_t byte_of(const Asked& asked) { return static_cast<std::uint32_t>(asked.byte); }

}  // namespace

Result<Json> definition(const Asked& asked) {
    const auto declared = asked.document.names().declaration_at(byte_of(asked));
    return declared ? location_of(asked.document, *declared) : Json();
}

Result<Json> references(const Asked& asked) {
    const NameIndex& names = asked.document.names();
    const auto declared = names.declaration_at(byte_of(asked));
    const Json& wanted = member(member(asked.params, "context"), "includeDeclaration");
    const bool has_declaration = !wanted.is_boolean() || wanted.get<bool>();
    Json places = Json::array();
    for (const Span use : names.uses_at(byte_of(asked))) {
        if (use == declared && !has_declaration) continue;
        Json place = location_of(asked.document, use);
        if (!place.is_null()) places.push_back(std::move(place));
    }
    return places;
}

Result<Json> highlights(const Asked& asked) {
    Json places = Json::array();
    for (const Span use : asked.document.names().uses_at(byte_of(asked))) {
        if (use.source == own_source) places.push_back({{"range", range_of(asked.document, use)}});
    }
    return places;
}

Result<Json> prepare_rename(const Asked& asked) {
    const auto name = asked.document.names().name_at(byte_of(asked));
    if (!name) return Json();
    const std::string_view text = asked.document.text();
    return Json{{"range", range_of(asked.document, *name)},
                {"placeholder", text.substr(name->begin, name->end - name->begin)}};
}

Result<Json> rename(const Asked& asked) {
    const NameIndex& names = asked.document.names();
    const std::string name = text_of_member(asked.params, "newName");
    const auto changed = names.renamed(byte_of(asked), name);
    if (!changed) return tl::unexpected(changed.error());
    Json edits = Json::array();
    for (const Span use : names.uses_at(byte_of(asked))) {
        edits.push_back({{"range", range_of(asked.document, use)}, {"newText", name}});
    }
    return Json{{"changes", {{asked.document.uri(), std::move(edits)}}}};
}

}  // namespace cascade::lsp

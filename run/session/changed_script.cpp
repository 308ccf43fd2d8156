// Numbers that are set in a session are added to the overrides of the script, as settings by --set
// are.
#include "run/session/changed_script.h"

#include "run/script/embedded_script.h"

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace cascade {
namespace {

/// Returns the name in `NAME=EXPR` or `NAME: EXPR`, without blanks around it.
std::string_view name_of_setting(std::string_view setting) {
    setting = setting.substr(0, setting.find_first_of("=:"));
    const std::size_t begin = setting.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return {};
    return setting.substr(begin, setting.find_last_not_of(" \t") + 1 - begin);
}

void set_number(Overrides& overrides, const SetNumber& number) {
    // Only the last setting of a name counts, so earlier settings of the name are removed.
    std::erase_if(overrides.sets, [&](const std::string& set) {
        return name_of_setting(set) == name_of_setting(number.name);
    });
    overrides.sets.push_back(fmt::format("{}={}", number.name, number.expression));
}

}  // namespace

Script with_text(const Script& old, const std::string& text) {
    Script script = load_script(old.name, text, old.folder, old.overrides);
    if (script.program || old.overrides.sets.empty()) return script;
    Overrides overrides = old.overrides;
    overrides.sets.clear();
    if (!load_script(old.name, text, old.folder, overrides).program) return script;
    for (const std::string& set : old.overrides.sets) {
        overrides.sets.push_back(set);
        if (!load_script(old.name, text, old.folder, overrides).program) overrides.sets.pop_back();
    }
    return load_script(old.name, text, old.folder, std::move(overrides));
}

Script with_number(const Script& script, const SetNumber& number) {
    Overrides overrides = script.overrides;
    set_number(overrides, number);
    return load_script(script.name, script.text, script.folder, std::move(overrides));
}

Script script_at_end(const SessionLog& log, const std::filesystem::path& folder,
                     const Overrides& options) {
    Script script;
    script.name = log.name;
    script.text = log.text;
    script.folder = folder;
    script.overrides = log.overrides;
    for (const auto& logged : log.changes) {
        const auto* const text = std::get_if<SetText>(&logged->change);
        const auto* const number = std::get_if<SetNumber>(&logged->change);
        if (text != nullptr) script = with_text(script, text->text);
        if (number != nullptr) set_number(script.overrides, *number);
    }
    return load_script(script.name, script.text, folder, merge(script.overrides, options));
}

}  // namespace cascade

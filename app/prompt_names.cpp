// The words before the last word determine which names are possible.
#include "app/prompt_names.h"

#include "app/prompt_text.h"
#include "lang/service/known_names.h"

#include <algorithm>
#include <filesystem>

namespace cascade {
namespace {

std::vector<std::string> names_of_stages(const Program& program) {
    std::vector<std::string> names;
    for (const Stage& stage : program.stages) names.push_back(stage.name);
    return names;
}

std::vector<std::string> items_of(const Program& program, std::uint32_t stage) {
    std::vector<std::string> names;
    const System& system = program.system_of(stage);
    for (const ItemId item : system.items()) names.emplace_back(system.item_name(item));
    return names;
}

std::vector<std::string> files_in(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    std::error_code error;
    std::filesystem::directory_iterator entry(folder.empty() ? "." : folder, error);
    for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
        names.push_back(entry->path().filename().string());
    }
    return names;
}

}  // namespace

std::vector<std::string> names_at_end(std::string_view line, const Program& program) {
    const std::string_view before = line.substr(0, line.size() - last_word(line).size());
    const std::string_view command = before.substr(0, before.find(' '));
    const std::string_view typed = trim(before.substr(std::min(command.size(), before.size())));
    if (command == ":load" || command == ":save") return files_in(typed);
    if (command == ":goto") return names_of_stages(program);
    const bool is_dotted = before.ends_with('.');
    if ((command == ":set" || command == ":paint") && typed.empty() && !is_dotted) {
        std::vector<std::string> names = names_of_stages(program);
        for (std::uint32_t k = 0; k < program.stages.size(); ++k) {
            for (std::string& name : items_of(program, k)) names.push_back(std::move(name));
        }
        return names;
    }
    std::vector<std::string> names;
    for (KnownName& known : completions(line, line.size(), program))
        names.push_back(std::move(known.name));
    return names;
}

}  // namespace cascade

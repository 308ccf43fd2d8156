// Changes from outside the script, as of --set: which stages each of them is for.
#include "lang/check_blocks.h"

#include <fmt/format.h>

namespace cascade::checking {

const ast::Sentence* value_sentence(const ast::Sentence& sentence) {
    const bool usable = sentence.kind == ast::SentenceKind::value && !sentence.name.empty() &&
                        !sentence.values.empty();
    return usable ? &sentence : nullptr;
}

namespace {

/// Can the sentence set something in this stage?
bool has_name(const Workspace& work, const Stage& stage, const ast::Sentence& sentence) {
    if (stage.system == unknown_system) return true;
    const std::string_view name = sentence.name.text;
    if (!sentence.index.empty()) return has_family(work.program.systems[stage.system], name);
    if (reserved(name) != Reserved::no) return true;
    return find(work.names[stage.system], name) != nullptr;
}

void report_unknown_override(Workspace& work, const ast::Word& name) {
    std::vector<std::string> names;
    for (const Stage& stage : work.program.stages) {
        if (stage.system == unknown_system) continue;
        for (std::string& each : quantity_names(work.program.systems[stage.system])) {
            names.push_back(std::move(each));
        }
    }
    names.insert(names.end(), setting_names().begin(), setting_names().end());
    work.diagnostics.error(name.span, fmt::format("no stage has a parameter '{}'", name.text),
                           did_you_mean(work, name.text, names));
}

/// `--set gray_scott.feed=…` where no stage is called so: it holds in every stage of that system.
bool set_in_stages_of_system(const Workspace& work, std::string_view system,
                             const ast::Sentence* sentence, StageOverrides& result) {
    bool used = false;
    for (std::size_t i = 0; i < result.size(); ++i) {
        const std::uint32_t its = work.program.stages[i].system;
        if (its == unknown_system || work.program.systems[its].name != system) continue;
        result[i].push_back(sentence);
        used = true;
    }
    return used;
}

}  // namespace

StageOverrides distribute_overrides(Workspace& work, const ast::Script& script) {
    StageOverrides result(work.program.stages.size());
    for (const ast::Override& change : script.overrides) {
        const ast::Sentence* sentence = value_sentence(change.sentence);
        if (sentence == nullptr) continue;
        if (!change.stage.empty()) {
            const auto found = work.stages.find(std::string(change.stage.text));
            if (found != work.stages.end()) {
                result[found->second].push_back(sentence);
                continue;
            }
            if (set_in_stages_of_system(work, change.stage.text, sentence, result)) continue;
            std::vector<std::string> names;
            for (const Stage& stage : work.program.stages) names.push_back(stage.name);
            work.diagnostics.error(change.stage.span,
                                   fmt::format("there is no stage '{}'", change.stage.text),
                                   did_you_mean(work, change.stage.text, names));
            continue;
        }
        bool used = false;
        for (std::size_t i = 0; i < result.size(); ++i) {
            if (!has_name(work, work.program.stages[i], *sentence)) continue;
            result[i].push_back(sentence);
            used = true;
        }
        if (!used) report_unknown_override(work, sentence->name);
    }
    return result;
}

}  // namespace cascade::checking

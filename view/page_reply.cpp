// One function for each kind of question.
#include "view/page_reply.h"

#include "lang/check/known_names.h"
#include "lang/equations/equations.h"
#include "picture/image.h"

#include <nlohmann/json.hpp>

namespace cascade {
namespace {

using Json = nlohmann::json;

Json reply_to(const AskForLog&, LiveRun& run) {
    return {{"kind", "log"}, {"text", print_session_log(run.log())}};
}

Json reply_to(const AskForNames& question, LiveRun& run) {
    Json names = Json::array();
    for (const KnownName& known : completions(question.text, *run.script().program)) {
        names.push_back(
            {{"name", known.name}, {"what", name_of(known.kind)}, {"note", known.note}});
    }
    return {{"kind", "names"}, {"names", std::move(names)}};
}

/// The values of an item now; outside of a mask they are NaN.
Field values_of(const LiveRun& run, StageItem at) {
    Formula formula;
    formula.nodes.push_back({at.item});
    return std::move(run.simulation().evaluate(formula, at.stage)[0]);
}

/// The present value of an item, or the range of its values.
void add_values(Json& reply, const LiveRun& run, StageItem at) {
    const StageState& state = run.simulation().state(at.stage);
    if (!state.started) return;
    if (run.script().program->stages[at.stage].uniform[at.item]) {
        reply["value"] = state.numbers[at.item];
        return;
    }
    const Spread spread = spread_of(values_of(run, at));
    if (spread.count == 0) return;
    reply["smallest"] = spread.smallest;
    reply["largest"] = spread.largest;
}

Json reply_to(const AskAboutName& question, LiveRun& run) {
    const Script& script = run.script();
    const std::uint32_t stage = run.place().stage;
    const auto mention = mention_at_end(question.text, *script.program, stage);
    Json reply = {{"kind", "explanation"}};
    if (!mention) return reply;
    const KnownName& known = mention->known;
    reply["name"] = known.name;
    reply["what"] = name_of(known.kind);
    reply["note"] = known.note;
    const std::uint32_t of = mention->item ? mention->item->stage : stage;
    if (mention->item) {
        add_values(reply, run, *mention->item);
        const System& system = script.program->system_of(of);
        if (const auto& range = system.quantities[mention->item->item].range) {
            reply["range"] = {range->low, range->high};
        }
    }
    if (mention->item || known.kind == NameKind::definition) {
        reply["equation"] = equation_in_mathml(script.tree, script.sources,
                                               script.program->system_of(of).name, known.name);
    }
    return reply;
}

}  // namespace

std::string print_reply(std::uint64_t id, const PageQuestion& question, LiveRun& run) {
    Json reply = std::visit([&run](const auto& asked) { return reply_to(asked, run); }, question);
    reply["id"] = id;
    // Texts of users may hold bytes that are no UTF-8.
    return reply.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace cascade

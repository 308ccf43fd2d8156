// Changes are compared by address. If two logs have the same change at the same index, all earlier
// changes are the same, too, because logs only grow and shrink at their ends.
#include "run/session/open_log.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade {

OpenLog::Lines OpenLog::lines(const SessionLog& log, RunPlace now) {
    Lines lines;
    lines.replaces_all = !has_begun_ || log.name != written_.name || log.text != written_.text ||
                         log.overrides != written_.overrides;
    if (lines.replaces_all) {
        lines.text = print_session_beginning(log) + "open\n";
        written_ = {log.name, log.text, log.overrides, {}, {}};
        has_begun_ = true;
        at_.reset();
    }
    auto& written = written_.changes;
    std::size_t same = std::min(written.size(), log.changes.size());
    while (same > 0 && written[same - 1] != log.changes[same - 1]) --same;
    if (same < written.size()) lines.text += fmt::format("keep {}\n", same);
    lines.text += print_logged_changes(log, same, at_);
    if (at_ != now) lines.text += print_place("at", now);
    at_ = now;
    written.resize(same);
    written.insert(written.end(), log.changes.begin() + static_cast<std::ptrdiff_t>(same),
                   log.changes.end());
    return lines;
}

}  // namespace cascade

// Replies to the questions of pages about a run. They are JSON texts, which spec/page.md lists.
#pragma once

#include "run/session/live_run.h"
#include "view/page_message.h"

#include <cstdint>
#include <string>

namespace cascade {

/// The reply to the question with the number `id`. Does not change the run.
std::string print_reply(std::uint64_t id, const PageQuestion& question, LiveRun& run);

}  // namespace cascade

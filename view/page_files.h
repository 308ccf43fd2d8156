// The files of the page that `cascade view` serves. They are made from the folder page/ when
// Cascade is built.
#pragma once

#include "view/local_server.h"

#include <string_view>

namespace cascade {

PageFiles page_files();

/// The script of the worker thread in which a page runs its own engine.
std::string_view page_worker();

}  // namespace cascade

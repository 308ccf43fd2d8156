// The files of the page that `cascade view` serves, made from page/ when Cascade is built.
#pragma once

#include "view/local_server.h"

#include <string_view>

namespace cascade {

PageFiles page_files();

/// The script of the worker in which a page runs its own engine.
std::string_view page_worker();

}  // namespace cascade

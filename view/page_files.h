// The files of the page that `cascade view` serves, made from page/ when Cascade is built.
#pragma once

#include "view/local_server.h"

namespace cascade {

PageFiles page_files();

}  // namespace cascade

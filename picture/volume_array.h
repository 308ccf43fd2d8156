// A field of a volume, with its name in files.
#pragma once

#include "core/plane.h"

#include <string>

namespace cascade {

struct VolumeArray {
    std::string name;
    const Field* field = nullptr;
};

}  // namespace cascade

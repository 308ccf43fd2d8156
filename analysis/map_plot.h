// The diagram of a map over two parameters: a colour for each class, and a mark at the values in
// the script.
#pragma once

#include "analysis/parameters.h"
#include "picture/drawing.h"

#include <string>

namespace cascade::analysis {

struct MapLabels {
    std::string title, across, up;
    std::array<double, 2> present{};  ///< The values of the two parameters in the script.
};

Drawing plot_map(const ParameterMap& map, const MapLabels& labels);

}  // namespace cascade::analysis

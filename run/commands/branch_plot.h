// The diagram of branches of steady states, with pictures of some of the states.
#pragma once

#include "continuation/branch.h"
#include "continuation/domain_cells.h"
#include "picture/drawing.h"
#include "run/commands/follow_table.h"

#include <cstddef>
#include <string>
#include <vector>

namespace cascade {

/// How states become pictures. The first species is drawn as a curve on a line, and otherwise as an
/// image of the plane or of the volume's middle slice.
struct StatePictures {
    continuation::DomainCells cells;
    std::size_t count = 0;  ///< The largest number of pictures. On a model none are drawn.
};

struct BranchPlotText {
    const FollowTable& table;
    std::size_t up = 0;  ///< The index, in table.numbers(), of the number on the vertical axis.
    std::string across;  ///< The name of the parameter.
    std::string title;
};

/// Curves of a number over the parameter: solid where states are stable, dashed where not, with
/// discs for special points. The pictures are spread evenly along the branches of patterns, and a
/// letter shows where the state of each picture is.
Drawing draw_branches(const BranchPlotText& text, const std::vector<continuation::Branch>& branches,
                      const StatePictures& pictures);

}  // namespace cascade

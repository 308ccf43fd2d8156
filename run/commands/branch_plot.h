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

/// How states become pictures. On a line, the picture is a curve of the first species. On a plane
/// or in a volume, it is an image of the first species in the plane or in the volume's middle
/// slice.
struct StatePictures {
    continuation::DomainCells cells;
    std::size_t count = 0;  ///< The largest number of pictures. On a model none are drawn.
};

struct BranchPlotText {
    const FollowTable& table;
    /// The index in table.numbers() of the number that is drawn along the vertical axis.
    std::size_t up = 0;
    std::string across;  ///< The name of the parameter along the horizontal axis.
    std::string title;
};

/// Curves of a number over the parameter: solid where states are stable, dashed where they are not,
/// with discs at special points. The pictures are spread evenly along the branches of patterns, and
/// a letter shows where the state of each picture is.
Drawing draw_branches(const BranchPlotText& text, const std::vector<continuation::Branch>& branches,
                      const StatePictures& pictures);

}  // namespace cascade

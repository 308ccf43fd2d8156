// The cells of a domain, as the equations of steady states need them.
#pragma once

#include "core/grid.h"
#include "core/links.h"

#include <array>
#include <vector>

namespace cascade::continuation {

struct DomainCells {
    /// On a model, the grid of rows and columns in which the model's cells are stored.
    Grid grid;
    /// Whether each position of the grid is a cell of the domain, x fastest. Empty if all positions
    /// are.
    std::vector<bool> inside;
    /// The links of a model's cells in double precision, with the weights of gradients. Null on
    /// grids. Must outlive the problem.
    const Links* links = nullptr;
    /// The area of each position. Empty if all areas are equal.
    std::vector<double> areas;
    /// The rotations that map the surface to itself, each as the x, y and z components of its
    /// velocity at each position.
    std::vector<std::array<std::vector<double>, 3>> turns;
};

}  // namespace cascade::continuation

// The domain: a grid, a surface or a model, with its mask and its sides.
#pragma once

#include "core/axis.h"
#include "core/grid.h"
#include "core/precision.h"
#include "lang/program/growth.h"
#include "lang/program/system.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

/// A surface in space on which the grid lies.
struct SurfaceSettings {
    std::array<Formula, 3> position;  ///< Made of numbers, coordinates and functions of numbers.
    bool has_metric = true;  ///< Whether operators account for the sizes of cells. If false, all
                             ///< cells count as equal squares.
    std::optional<double> unit;  ///< The length of one unit. If empty, `extent` or
                                 ///< DomainSettings::detail determines it.
    /// The longest side of the box around the corners of all cells at t = 0, in units.
    std::optional<double> extent;
    Span span;
};

/// A part of the grid, of any shape, that is the domain. A formula decides which cells belong to
/// this part.
struct MaskSettings {
    /// A cell belongs to the domain if the value of this formula is neither 0 nor NaN. The formula
    /// reads no items.
    Formula formula;
    Span span;  ///< Where the expression is in the script.
};

/// The surface over which cells are spread.
enum class ModelShape : std::uint8_t {
    file,
    sphere,
    torus,
    box,
    knot,
    creature,
    leopard,
    giraffe,
    zebra,
    fish,
    frog,
    implicit
};

/// Where the cells are on the surface.
enum class ModelCellKind : std::uint8_t {
    /// At points spread evenly over the surface. Each cell is the Voronoi region of its point
    /// (Turk).
    spread,
    faces,     ///< One cell in each triangle of the model.
    vertices,  ///< One cell at each vertex of the model.
};

/// How the differences between neighbours are weighted.
enum class ModelLaplacian : std::uint8_t {
    finite_volumes,  ///< Weight: Voronoi edge length / (distance · area of the cell).
    turk,  ///< Weight: Voronoi edge length, scaled so that the weights of each cell add up to 4.
};

/// The directions along which cells or patterns are stretched.
struct DirectionSettings {
    enum class Kind : std::uint8_t { axis, gradient, curvature_high, curvature_low, keys };
    Kind kind = Kind::axis;
    /// If `kind` is `axis`, a vector. If it is `keys`, a position and a vector for each key.
    std::vector<double> numbers;
    /// If `kind` is `gradient`, a formula of numbers, x, y and z. The direction is the gradient of
    /// this formula.
    std::optional<Formula> height;
    /// The standard deviation of the smoothing, in units of the model's longest side.
    double smoothing = 0;
    Span span;
};

/// A surface in space whose cells are the domain: a model in a file, or a shape.
struct ModelSettings {
    ModelShape shape = ModelShape::file;
    std::string path;  ///< The path of the model's file.
    /// The sizes of a shape: two radii of a torus, three sides of a box, or the radius of a knot's
    /// tube.
    std::vector<double> sizes;
    std::optional<Formula> implicit;  ///< A formula whose value is 0 on the surface.
    ModelCellKind cells = ModelCellKind::spread;
    std::int64_t count = 16384;  ///< The number of cells if `cells` is `spread`.
    ModelLaplacian laplacian = ModelLaplacian::finite_volumes;
    std::optional<double> unit;    ///< The length of one unit. If empty, `extent` or
                                   ///< DomainSettings::detail determines it.
    std::optional<double> extent;  ///< The longest side of the model's box at t = 0, in units.
    Stance stance;                 ///< The axes of the model that become y and z of the script.
    std::optional<DirectionSettings> directions;
    double stretch = 2;  ///< A cell's length along the directions, divided by its width.
    Span span;           ///< Where the model's name is in the script.
};

/// Which cells the operators of derivatives read on a grid.
enum class StencilKind : std::uint8_t {
    cross,      ///< The neighbours along the axes.
    isotropic,  ///< Like `cross`, but lap also reads the diagonal neighbours.
    /// The two nearest cells in each direction along each axis. The error is of fourth order.
    fourth,
};

struct DomainSettings {
    Grid grid;                               ///< The default is 64 × 64 and periodic.
    std::optional<ModelSettings> model;      ///< If given, the grid is linked.
    std::optional<MaskSettings> mask;        ///< If empty, the domain is the whole grid.
    std::optional<SurfaceSettings> surface;  ///< If empty, the grid is flat.
    StencilKind stencil = StencilKind::cross;
    std::optional<Growth> growth;  ///< The growth in stages that do not set lengths themselves.
    std::uint32_t seed = 1;
    Precision precision = Precision::single;  ///< The precision of all numbers in a run.
    bool fast = false;  ///< Whether steps use fewer roundings (ir/contraction.h).
    /// The width of a cell is the width in the script divided by this number. The lengths of the
    /// domain do not change. On surfaces and models without a unit, the mean cell has the area 1 /
    /// detail².
    std::int64_t detail = 1;
    /// The width of a cell is the width in the script multiplied by this number. The lengths of the
    /// domain do not change.
    std::int64_t coarse = 1;
    /// The rules at the sides, for all species.
    std::array<std::optional<SideSetting>, wall_count> sides;
};

}  // namespace cascade

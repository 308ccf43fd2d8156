// Computes positions in files cell by cell, in binary64, whenever they are needed. Computes slopes
// of formulas as differences.
#include "run/domain/file_places.h"

#include "lang/program/evaluate.h"
#include "lang/program/models.h"
#include "surface/cell_frames.h"
#include "surface/place_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

constexpr double slope_width =
    1e-4;  // The step from which slopes are computed, as a fraction of the longest side.
// If a direction is shorter than this, its angle is 0. Its components should be 0, but ½ is not
// exact in 8 bits.
constexpr double shortest_direction = 0.01;
// A component that is smaller than this fraction of the other component counts as 0.
constexpr double rounded_component = 1e-9;

/// A position among the elements along one side of a file. It is described by the elements before
/// and after it and by the weight of the element after it.
struct BetweenElements {
    std::size_t before = 0, after = 0;
    double part = 0;

    BetweenElements(double place, std::int64_t count, bool repeats) {
        if (!std::isfinite(place)) place = 0;
        place = repeats ? place - std::floor(place) : std::clamp(place, 0.0, 1.0);
        const double position = place * static_cast<double>(count) - 0.5;
        const auto first = static_cast<std::int64_t>(std::floor(position));
        part = position - std::floor(position);
        const auto element = [&](std::int64_t k) {
            return static_cast<std::size_t>(repeats ? (k + count) % count
                                                    : std::clamp<std::int64_t>(k, 0, count - 1));
        };
        before = element(first);
        after = element(first + 1);
    }
};

/// Interpolates the number at a position in an array of slices, rows and columns.
template <typename Number>
double number_at(const std::vector<Number>& values, std::array<std::int64_t, 3> sides,
                 const FilePlace& place, bool repeats) {
    const BetweenElements column(place[0], sides[0], repeats), row(place[1], sides[1], repeats),
        slice(place[2], sides[2], repeats);
    // std::lerp is not used, because it rounds differently in each standard library.
    const auto mix = [](double a, double b, double part) { return a + (b - a) * part; };
    const auto along = [&](std::size_t k, std::size_t j) {
        const std::size_t start =
            (k * static_cast<std::size_t>(sides[1]) + j) * static_cast<std::size_t>(sides[0]);
        return mix(static_cast<double>(values[start + column.before]),
                   static_cast<double>(values[start + column.after]), column.part);
    };
    const auto across = [&](std::size_t k) {
        return mix(along(k, row.before), along(k, row.after), row.part);
    };
    return mix(across(slice.before), across(slice.after), slice.part);
}

void set(BuiltinValues& values, Builtin builtin, double value) {
    values[static_cast<std::size_t>(builtin)] = value;
}

/// Calls `visit(values)` for each cell of a grid. `values` belong to the built-in names for
/// positions, such as x.
template <typename Visit>
void each_of_grid(const Grid& grid, const Visit& visit) {
    const auto longest = static_cast<double>(grid.longest_side());
    BuiltinValues cell{};
    set(cell, Builtin::nz, 1);
    const auto put = [&](Builtin of_longest, Builtin of_side, std::int64_t at, std::int64_t count) {
        const double centre = static_cast<double>(at) + 0.5;
        set(cell, of_longest, centre / longest);
        set(cell, of_side, centre / static_cast<double>(count));
    };
    for (std::int64_t k = 0; k < grid.depth; ++k) {
        put(Builtin::z, Builtin::sz, k, grid.depth);
        for (std::int64_t j = 0; j < grid.height; ++j) {
            put(Builtin::y, Builtin::sy, j, grid.height);
            for (std::int64_t i = 0; i < grid.width; ++i) {
                put(Builtin::x, Builtin::sx, i, grid.width);
                visit(cell);
            }
        }
    }
}

/// Calls `visit(values)` for each cell of a model. `values` belong to the built-in names for
/// positions, such as x.
template <typename Visit>
void each_of_model(const ModelCells& model, const Visit& visit) {
    constexpr std::array builtins{Builtin::x,  Builtin::y,  Builtin::z,  Builtin::sx, Builtin::sy,
                                  Builtin::sz, Builtin::nx, Builtin::ny, Builtin::nz};
    std::array<std::vector<double>, builtins.size()> values;
    for (std::size_t n = 0; n < builtins.size(); ++n) {
        const auto plane = static_cast<std::size_t>(*model_plane_of(builtins[n]));
        values[n] = cell_values(model.spread().planes[plane], model);
    }
    BuiltinValues cell{};
    for (std::size_t k = 0; k < model.count(); ++k) {
        for (std::size_t n = 0; n < builtins.size(); ++n) set(cell, builtins[n], values[n][k]);
        visit(cell);
    }
}

/// Moves a position by a vector. The unit of the vector is the longest side of the domain's box.
/// `extent` is the size of this box.
BuiltinValues moved(BuiltinValues place, Vector3d by, Vector3d extent) {
    const std::array<double, 3> way{by.x, by.y, by.z}, sides{extent.x, extent.y, extent.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        place[static_cast<std::size_t>(Builtin::x) + axis] += way[axis];
        if (sides[axis] > 0) {
            place[static_cast<std::size_t>(Builtin::sx) + axis] += way[axis] / sides[axis];
        }
    }
    return place;
}

FilePlace place_by(std::span<const Formula> formulas, const BuiltinValues& cell) {
    FilePlace place{};
    for (std::size_t k = 0; k < formulas.size(); ++k) place[k] = evaluate(formulas[k], cell);
    return place;
}

FilePlace minus(const FilePlace& a, const FilePlace& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// Returns the gradient, in the plane of a triangle, of the linear function with these values at
/// the corners.
Vector3d gradient_in(const SurfaceMesh& mesh, std::uint32_t triangle,
                     const std::array<double, 3>& corners) {
    const auto& [a, b, c] = mesh.triangles[triangle];
    const Vector3d p = mesh.points[a];
    const Vector3d u = mesh.points[b] - p, v = mesh.points[c] - p;
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v);
    const double area = uu * vv - uv * uv;
    if (!(area > 0)) return {};
    const double du = corners[1] - corners[0], dv = corners[2] - corners[0];
    return u * ((du * vv - dv * uv) / area) + v * ((dv * uu - du * uv) / area);
}

/// Returns the angle on the surface or grid that corresponds to a step in a picture. The step is
/// given in pixels to the right and upwards.
double angle_of(double to_right, double upwards, std::array<double, 2> sides,
                const FileSlopes& slopes) {
    if (!(to_right * to_right + upwards * upwards >= shortest_direction * shortest_direction)) {
        return 0;
    }
    // Solves two linear equations for the step on the surface.
    const double a = to_right / sides[0], b = -upwards / sides[1];
    const auto& [right, down] = slopes;
    const double sign = right[0] * down[1] - right[1] * down[0] < 0 ? -1 : 1;
    const double x = sign * (a * down[1] - b * down[0]);
    double y = sign * (b * right[0] - a * right[1]);
    // A step to the left must get the angle π. With rounding errors it could get −π, which is the
    // same direction but another number.
    if (std::abs(y) <= rounded_component * std::abs(x)) y = 0;
    return std::isfinite(x) && std::isfinite(y) ? std::atan2(y, x) : 0;
}

}  // namespace

double number_at_place(const std::vector<double>& values, std::array<std::int64_t, 3> sides,
                       const FilePlace& place) {
    return number_at(values, sides, place, false);
}

FilePlaces FilePlaces::by_formulas(std::vector<Formula> place, const Grid& grid,
                                   const ModelCells* model, bool with_slopes) {
    const auto each = [place = std::move(place), grid, model, with_slopes](const Visit& visit) {
        const auto longest = static_cast<double>(grid.longest_side());
        Vector3d extent{static_cast<double>(grid.width) / longest,
                        static_cast<double>(grid.height) / longest,
                        static_cast<double>(grid.depth) / longest};
        CellFrames frames;
        if (model != nullptr && with_slopes) {
            const SurfaceMesh::Box box = model->mesh.box();
            extent = (box.high - box.low) * (1 / ModelBox(model->mesh).longest);
            frames = cell_frames(model->mesh, model->spread().cells);
        }
        std::size_t k = 0;
        const auto look = [&](const BuiltinValues& cell) {
            const auto slope = [&](Vector3d way) {
                const Vector3d step = way * slope_width;
                return minus(place_by(place, moved(cell, step, extent)),
                             place_by(place, moved(cell, step * -1, extent)));
            };
            FileSlopes slopes;
            if (with_slopes) {
                slopes.right = slope(model != nullptr ? frames.right[k] : Vector3d{1, 0, 0});
                slopes.down = slope(model != nullptr ? frames.down[k] : Vector3d{0, 1, 0});
            }
            visit(place_by(place, cell), slopes);
            ++k;
        };
        model != nullptr ? each_of_model(*model, look) : each_of_grid(grid, look);
    };
    return {each, false};
}

FilePlaces FilePlaces::of_grid(const Grid& grid) {
    const FileSlopes slopes{{1 / static_cast<double>(grid.width), 0, 0},
                            {0, 1 / static_cast<double>(grid.height), 0}};
    const auto each = [grid, slopes](const Visit& visit) {
        each_of_grid(grid, [&](const BuiltinValues& cell) {
            const auto of = [&](Builtin side) { return cell[static_cast<std::size_t>(side)]; };
            visit({of(Builtin::sx), of(Builtin::sy), of(Builtin::sz)}, slopes);
        });
    };
    return {each, false};
}

Result<FilePlaces> FilePlaces::of_texture(const ModelCells& model, const ModelSettings& settings,
                                          bool with_slopes) {
    if (model.mesh.texture.empty()) {
        const std::string by_place = "image(\"f.png\", sx, 1 - sy) projects a picture along z";
        return failure(
            "the model has no texture coordinates, which say where a picture lies on it",
            settings.path.empty()
                ? by_place
                : fmt::format("'cascade mesh {} --unwrap -o NAME.glb' writes it with some; {}",
                              settings.path, by_place));
    }
    const auto each = [&model, with_slopes](const Visit& visit) {
        const SurfaceMesh& mesh = model.mesh;
        const SurfaceCells& cells = model.spread().cells;
        const CellFrames frames = with_slopes ? cell_frames(mesh, cells) : CellFrames();
        for (std::size_t k = 0; k < cells.places.size(); ++k) {
            const SurfacePlace& place = cells.places[k];
            const auto [u, v] = *texture_place_at(mesh, place);
            // Rows are counted from the bottom in texture coordinates, and from the top in files.
            const FilePlace from_top{u, 1 - v, 0};
            if (!with_slopes) {
                visit(from_top, {});
                continue;
            }
            const auto& corners = mesh.texture[place.triangle];
            const auto gradient = [&](std::size_t axis) {
                return gradient_in(mesh, place.triangle,
                                   {static_cast<double>(corners[0][axis]),
                                    static_cast<double>(corners[1][axis]),
                                    static_cast<double>(corners[2][axis])});
            };
            const Vector3d of_u = gradient(0), of_v = gradient(1) * -1;
            visit(from_top, {{dot(of_u, frames.right[k]), dot(of_v, frames.right[k]), 0},
                             {dot(of_u, frames.down[k]), dot(of_v, frames.down[k]), 0}});
        }
    };
    return FilePlaces(each, true);
}

template <typename Number>
std::vector<double> FilePlaces::numbers_of(const std::vector<Number>& values,
                                           std::array<std::int64_t, 3> sides) const {
    std::vector<double> found;
    each_([&](const FilePlace& place, const FileSlopes&) {
        found.push_back(number_at(values, sides, place, repeats_));
    });
    return found;
}

std::vector<double> FilePlaces::numbers(const GreyPicture& picture) const {
    return numbers_of(picture.values, {picture.width, picture.height, 1});
}

std::vector<double> FilePlaces::numbers(const NpyArray& array) const {
    return numbers_of(array.values, {array.columns, array.rows, array.slices});
}

std::vector<double> FilePlaces::angles(const GreyPicture& red, const GreyPicture& green) const {
    std::vector<double> found;
    each_([&](const FilePlace& place, const FileSlopes& slopes) {
        const auto painted = [&](const GreyPicture& channel) {
            return 2 * number_at(channel.values, {channel.width, channel.height, 1}, place,
                                 repeats_) -
                   1;
        };
        found.push_back(angle_of(painted(red), painted(green),
                                 {static_cast<double>(red.width), static_cast<double>(red.height)},
                                 slopes));
    });
    return found;
}

Field plane_of(std::span<const double> numbers, const Grid& grid, const ModelCells* model,
               Precision precision) {
    if (model != nullptr) return field_of_cells(numbers, *model, precision);
    Field field{PlaneLayout(grid), precision};
    field.visit([&]<typename Number>(Plane<Number>& cells) {
        std::size_t k = 0;
        for (std::int64_t row = 0; row < cells.layout().row_count(); ++row) {
            for (std::int64_t i = 0; i < grid.width; ++i, ++k) {
                cells.row(row)[i] = static_cast<Number>(numbers[k]);
            }
        }
    });
    return field;
}

}  // namespace cascade

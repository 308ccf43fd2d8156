// The functions and operators of formulas of Ready (internal to ready_formula.cpp).
#pragma once

#include "import/formula.h"

namespace cascade::importing {

inline constexpr ForeignFunction opencl_functions[] = {
    {"exp", 1, "exp(A)"},
    {"log", 1, "log(A)"},
    {"sin", 1, "sin(A)"},
    {"cos", 1, "cos(A)"},
    {"tan", 1, "tan(A)"},
    {"asin", 1, "asin(A)"},
    {"acos", 1, "acos(A)"},
    {"atan", 1, "atan(A)"},
    {"sqrt", 1, "sqrt(A)"},
    {"floor", 1, "floor(A)"},
    {"ceil", 1, "ceil(A)"},
    {"sign", 1, "sign(A)"},
    {"tanh", 1, "tanh(A)"},
    {"sinh", 1, "sinh(A)"},
    {"cosh", 1, "cosh(A)"},
    {"cbrt", 1, "cbrt(A)"},
    {"fabs", 1, "abs(A)"},
    {"abs", 1, "abs(A)"},
    {"rsqrt", 1, "1/sqrt(A)"},
    {"exp2", 1, "2^A"},
    {"exp10", 1, "10^A"},
    {"log2", 1, "log(A)/log(2)"},
    {"log10", 1, "log(A)/log(10)"},
    {"round", 1, "sign(A)*floor(abs(A) + 0.5)"},
    {"rint", 1, "round(A)"},
    {"trunc", 1, "sign(A)*floor(abs(A))"},
    {"fract", 1, "A - floor(A)"},
    {"min", 2, "min(A, B)"},
    {"max", 2, "max(A, B)"},
    {"fmin", 2, "min(A, B)"},
    {"fmax", 2, "max(A, B)"},
    {"pow", 2, "A^B"},
    {"pown", 2, "A^B"},
    {"powr", 2, "A^B"},
    {"hypot", 2, "hypot(A, B)"},
    {"atan2", 2, "atan2(A, B)"},
    {"step", 2, "step(A, B)"},
    {"fmod", 2, "sign(A)*mod(abs(A), abs(B))"},
    {"mix", 3, "mix(A, B, C)"},
    {"smoothstep", 3, "smoothstep(A, B, C)"},
    {"mad", 3, "A*B + C"},
    {"fma", 3, "A*B + C"},
    {"select", 3, "if(C, B, A)"},
    {"isgreater", 2, "A > B"},
    {"isgreaterequal", 2, "A >= B"},
    {"isless", 2, "A < B"},
    {"islessequal", 2, "A <= B"},
    {"isequal", 2, "A == B"},
    {"convert_float4", 1, "A"},
    {"float4", 1, "A"},
    {"float", 1, "A"},
};

/// The operators of Ready, which formulas write as NAME_CHEMICAL. y points upwards in Ready and
/// downwards here.
inline constexpr ForeignFunction ready_operators[] = {
    {"laplacian", 1, "lap(A)"},
    {"bilaplacian", 1, "lap(lap(A))"},
    {"trilaplacian", 1, "lap(lap(lap(A)))"},
    {"gradient_mag_squared", 1, "grad2(A)"},
    {"x_gradient", 1, "dx(A)"},
    {"y_gradient", 1, "-dy(A)"},
    {"z_gradient", 1, "dz(A)"},
    {"x_deriv2", 1, "dxx(A)"},
    {"y_deriv2", 1, "dyy(A)"},
    {"z_deriv2", 1, "dzz(A)"},
    {"x_deriv3", 1, "dx(dxx(A))"},
    {"y_deriv3", 1, "-dy(dyy(A))"},
    {"z_deriv3", 1, "dz(dzz(A))"},
    {"sobelE", 1,
     "east(north(A)) + 2*east(A) + east(south(A))"
     " - west(north(A)) - 2*west(A) - west(south(A))"},
    {"sobelW", 1,
     "west(north(A)) + 2*west(A) + west(south(A))"
     " - east(north(A)) - 2*east(A) - east(south(A))"},
    {"sobelN", 1,
     "north(west(A)) + 2*north(A) + north(east(A))"
     " - south(west(A)) - 2*south(A) - south(east(A))"},
    {"sobelS", 1,
     "south(west(A)) + 2*south(A) + south(east(A))"
     " - north(west(A)) - 2*north(A) - north(east(A))"},
    {"sobelNE", 1, "2*north(east(A)) + north(A) + east(A) - west(A) - south(A) - 2*south(west(A))"},
    {"sobelNW", 1, "2*north(west(A)) + north(A) + west(A) - east(A) - south(A) - 2*south(east(A))"},
    {"sobelSE", 1, "2*south(east(A)) + south(A) + east(A) - west(A) - north(A) - 2*north(west(A))"},
    {"sobelSW", 1, "2*south(west(A)) + south(A) + west(A) - east(A) - north(A) - 2*north(east(A))"},
};

/// The neighbours of a cell, which names such as a_ne and a_w2 read.
struct Neighbour {
    char letter;
    std::string_view function;
    std::string_view cells;  ///< The offset in cells, as arguments of `shifted`.
};
inline constexpr Neighbour ready_neighbours[] = {
    {'e', "east", "1, 0"},  {'w', "west", "-1, 0"},    {'n', "north", "0, -1"},
    {'s', "south", "0, 1"}, {'u', "above", "0, 0, 1"}, {'d', "below", "0, 0, -1"},
};

}  // namespace cascade::importing

// The table of words, and the search in it, which ignores case.
#include "lang/vocabulary/words_elsewhere.h"

#include <algorithm>
#include <cctype>
#include <iterator>

namespace cascade {

namespace {

using Context = WordContext;

constexpr WordElsewhere rows[] = {
    {Context::stage, "dt timestep time_step step_size delta_t tau",
     "the length of a step is its speed: write 'speed: 0.1'"},
    {Context::stage, "steps n_steps nsteps num_steps iters generations max_iter",
     "write 'iterations: 1000'"},
    {Context::stage, "time t_end tend t_max tmax end_time total_time final_time stop_time",
     "write 'duration: 1000'"},
    {Context::stage, "method integrator scheme stepper time_stepping", "write 'solver: rk4'"},
    {Context::stage, "tol rtol atol abstol reltol", "write 'solver: rk45; tolerance: 0.001'"},
    {Context::stage, "width height resolution nx",
     "it belongs in the domain: write 'domain { grid: 100, 100 }'"},
    {Context::stage, "spacing dx h cell_size",
     "it belongs in the domain: write 'domain { spacing: 0.5 }'"},
    {Context::stage, "dilution diluted dilute no_dilution", "write 'undiluted: u' for a species u"},
    {Context::stage, "boundary bc boundaries boundary_condition boundary_conditions",
     "it belongs in the domain: write 'domain { boundary: noflux }'"},
    {Context::stage, "seed random_seed", "it belongs in the domain: write 'domain { seed: 1 }'"},
    {Context::stage, "output out filename file save export image png",
     "name the file on the command line: cascade run SCRIPT -o out.png"},
    {Context::stage, "precision dtype",
     "it belongs in the domain: write 'domain { precision: double }'"},
    {Context::stage, "palette color colour colors colormap cmap",
     "it belongs in the picture: write 'picture { color: palette(u, 0, 1, \"leopard\") }'"},

    {Context::domain, "size width height resolution nx shape dimensions n",
     "write 'grid: 100, 100' for the numbers of cells"},
    {Context::domain, "length lengths l lx side",
     "write 'extent: 50, 50' for the lengths of the sides"},
    {Context::domain, "dx dy h cell_size delta_x resolution_length", "write 'spacing: 0.5'"},
    {Context::domain, "bc boundaries boundary_condition boundary_conditions edges borders",
     "write 'boundary: noflux'"},
    {Context::domain, "growth grow growing growth_rate scale",
     "lengths may be formulas of time: write 'extent: 50 * exp(0.01 * t)'"},
    {Context::domain, "random_seed rng", "write 'seed: 1'"},
    {Context::domain, "dtype float", "write 'precision: double'"},
    {Context::domain, "model file obj", "write 'mesh: \"model.obj\"'"},
    {Context::domain, "dt steps time iterations duration speed solver until interval every",
     "it belongs in a stage: write 'stage s: turing_spots { iterations: 1000 }'"},
    {Context::domain, "palette color colour colors colormap cmap",
     "it belongs in the picture: write 'picture { color: palette(u, 0, 1, \"leopard\") }'"},

    {Context::picture, "palette colors colour colormap cmap",
     "write 'color: palette(u, 0, 1, \"leopard\")'"},
    {Context::picture, "size resolution dpi pixels", "use the option --size 512x512"},
    {Context::picture, "file filename out output save format",
     "name the file on the command line: cascade run SCRIPT -o out.png"},
    {Context::picture, "title axes axis colorbar legend label",
     "-o NAME.svg draws a figure with axes and a colour scale"},
    {Context::picture, "range vmin vmax clim limits min max",
     "write 'color: palette(u, 0, 1, \"viridis\")'"},
    {Context::picture, "metallic metal", "write 'metalness: 1'"},
    {Context::picture, "smoothness glossiness gloss", "write 'roughness: 0.2'"},
    {Context::picture, "emissive glow", "write 'emission: rgb(1, 0.5, 0)'"},
    {Context::picture, "alpha transparency", "write 'opacity: 0.5'"},
    {Context::picture, "displacement bump relief", "write 'height: u'"},

    {Context::boundary,
     "neumann zero_flux zeroflux reflecting reflective insulating closed wall walls mirror",
     "write 'noflux'"},
    {Context::boundary, "open outflow free free_slip zero_gradient natural none", "write 'noflux'"},
    {Context::boundary, "wrap wrapped cyclic toroidal torus circular", "write 'periodic'"},
    {Context::boundary, "dirichlet fixed absorbing zero",
     "sides have values, boundaries have none: write 'sides: fixed(0)'"},
    {Context::boundary, "flux slope",
     "sides have slopes, boundaries have none: write 'sides: slope(1)'"},

    {Context::side, "neumann", "write 'slope(0)'"},
    {Context::side, "robin", "use slope(c - a * u) in a system or a stage for du/dn = c - a u"},
    {Context::side, "zero_flux zeroflux reflecting reflective insulating closed wall mirror",
     "write 'noflux'"},
    {Context::side, "dirichlet absorbing zero constant value", "write 'fixed(0)'"},
    {Context::side, "wrap cyclic toroidal torus", "write 'periodic'"},

    {Context::precision, "64 float64 f64 fp64 float_64 high full", "write 'double'"},
    {Context::precision, "32 float32 f32 fp32 float float_32 low", "write 'single'"},

    {Context::function, "diff derivative deriv partial d",
     "write 'dx(u)' for du/dx, dxx(u) for its second derivative"},
    {Context::function, "vec vec2 vec3 array list tuple", "use vector(1, 0) for a vector"},
    {Context::function,
     "grey gray jet hot cool rainbow turbo parula viridis magma inferno plasma cividis",
     "use palette(u, 0, 1, \"viridis\") for a colour of a palette"},
    {Context::function, "laplacian laplace del2 nabla2 lapl laplacien", "did you mean 'lap'?"},
    {Context::function, "divergence", "did you mean 'div'?"},
    {Context::function, "gradient nabla", "did you mean 'grad'?"},
    {Context::function, "uvimage texture tex2d texture2d",
     "image(\"f.png\") reads a picture, on models by their texture coordinates"},
    {Context::function, "rot rotor", "write 'curl(v)'"},
    {Context::function, "norm", "write 'length(v)'"},
    {Context::function, "normalize normalise normalized", "write 'unit(v)'"},
    {Context::function, "minimum", "did you mean 'min'?"},
    {Context::function, "maximum", "did you mean 'max'?"},
    {Context::function, "ln", "did you mean 'log'?"},
    {Context::function, "log10", "write 'log(u) / log(10)'"},
    {Context::function, "log2", "write 'log(u) / log(2)'"},
    {Context::function, "rand uniform rnd", "did you mean 'random'?"},
    {Context::function, "randn gaussian_noise", "did you mean 'normal'?"},
    {Context::function, "heaviside theta unit_step", "write 'step(0, u)'"},
    {Context::function, "gaussian bump",
     "write 'gauss(0.5, 0.5, 0.1)' for a bump; normal(0, 1) is noise"},
    {Context::function, "circle sphere ball", "write 'disc(0.5, 0.5, 0.1)'"},
    {Context::function, "rect rectangle square", "write 'box(0.5, 0.5, 0.2, 0.2)'"},
    {Context::function, "fabs magnitude", "did you mean 'abs'?"},
    {Context::function, "fmod remainder modulo", "did you mean 'mod'?"},
    {Context::function, "arcsin", "did you mean 'asin'?"},
    {Context::function, "arccos", "did you mean 'acos'?"},
    {Context::function, "arctan", "did you mean 'atan'?"},
    {Context::function, "sqr squared", "write 'u^2'"},
    {Context::function, "sigmoid logistic", "write '1 / (1 + exp(-u))'"},
    {Context::function, "lerp interpolate", "did you mean 'mix'?"},
    {Context::function, "ramp interp interp1 interp1d lookup table timeseries",
     "use \"light.csv\" makes each column of a table a function of the first, such as light(t)"},
    {Context::function, "where select ifelse piecewise", "write 'if(u > v, u, v)'"},
    {Context::function, "average avg", "write 'mean(u over domain)'"},
    {Context::function, "integrate", "write 'integral(u over domain)'"},
    {Context::function, "hill hill_function", "write 'u^2 / (1 + u^2)'"},
    {Context::function, "linspace arange", "--vary takes a range: name=0..1:5 is five values"},
    {Context::function, "steady", "use it alone after 'until:'"},
    {Context::function, "fixed flux", "use it after a side, as in u.left: fixed(1)"},

    {Context::function, "hsv hsl hex", "a colour is rgb(red, green, blue), each from 0 to 1"},
    {Context::statement, "import include require load from",
     "another script is read by use \"other.cascade\""},
    {Context::statement, "function def func define", "a function is fn name(a, b) = expression"},
    {Context::statement, "const constant var param parameter parameters double float int real",
     "a parameter of a system is 'name: value'; a number of the whole script is "
     "'let name = value'"},
    {Context::statement, "output save plot print show",
     "name the file on the command line: cascade run SCRIPT -o out.png"},
    {Context::statement, "at when event events",
     "use two stages for an event: the first ends with 'duration: 50', and 'stage next: mine { "
     "u: u + 1 }' continues from it"},
    {Context::statement, "for while loop repeat",
     "there are no loops; i: 1..3 makes u[i] a family of species"},
    {Context::statement, "diff dif derivative d", "a rate is written u' = …"},
    {Context::value, "time", "write 't'"},
    {Context::value, "dt timestep time_step", "write 'speed'"},
    {Context::value, "e euler", "write 'exp(1)'"},
    {Context::value, "true", "write '1'"},
    {Context::value, "false", "write '0'"},
    {Context::value, "iteration frame tick", "write 'step'"},
    {Context::value, "dw", "white(s) is white noise of the deviation s"},
    {Context::value, "randn", "write 'normal(0, 1)'"},
    {Context::value, "rand rnd", "write 'random(0.5, 0.5)'"},
    {Context::value, "dx2 d2x", "use dxx(u) for the second derivative of u along x"},
    {Context::value, "dy2 d2y", "use dyy(u) for the second derivative of u along y"},
    {Context::value, "red green blue yellow orange black",
     "a colour is rgb(red, green, blue), each from 0 to 1"},
};

bool is_same(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char left, char right) {
        return std::tolower(static_cast<unsigned char>(left)) == right;
    });
}

/// Whether the list `words`, separated by blanks, contains `word`.
bool has_word(std::string_view words, std::string_view word) {
    while (!words.empty()) {
        const std::size_t end = std::min(words.find(' '), words.size());
        if (is_same(word, words.substr(0, end))) return true;
        words.remove_prefix(std::min(end + 1, words.size()));
    }
    return false;
}

}  // namespace

std::span<const WordElsewhere> words_elsewhere() { return rows; }

std::string_view species_of_rate(std::string_view name) {
    for (const std::string_view end : {"_dot", "_next", "_new", "_t", "_dt", "dt"}) {
        const bool begins_with_d = end.ends_with("dt");
        const std::size_t around = end.size() + (begins_with_d ? 1 : 0);
        if (name.size() <= around || !name.ends_with(end)) continue;
        if (begins_with_d && name[0] != 'd') continue;
        return name.substr(begins_with_d ? 1 : 0, name.size() - around);
    }
    return {};
}

std::string_view advice_about(std::string_view word, WordContext context) {
    const auto found =
        std::find_if(std::begin(rows), std::end(rows), [&](const WordElsewhere& row) {
            return row.context == context && has_word(row.words, word);
        });
    return found == std::end(rows) ? std::string_view() : found->advice;
}

}  // namespace cascade

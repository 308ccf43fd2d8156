// Errors that checks of names, solvers, domains and cells report, their hints, and the corrected
// text (hints_test.cpp).
#pragma once

#include "hint_cases.h"

namespace cascade::test {

inline constexpr HintCase hint_cases_of_checks[] = {
    // Parts of formulas.
    {"family", "u[i]' = sum(u[i] over j)", "declare the index in the system, as in i: 1..3",
     "j: 1..3; u[i]' = sum(u[i] over j)"},
    {"system", "u' = v\nw[m]: 1", "declare it in the system, as in m: 1..3",
     "u' = v\nm: 1..3; w[m]: 1"},
    {"family", "j: 3..1; A[j]: 1; u[i]' = 1", "write the lower end first",
     "j: 1..3; A[j]: 1; u[i]' = 1"},
    {"script",
     "domain { surface: sphere; cells: 100 }\nsystem s { u: 1; turn: along(image(\"f.png\", "
     "\"red\")); u' = diffuse(u, 0.4, 0.1, turn) }\nstage a: s { }",
     "write along(image(\"f.png\")), which reads the channels red and green",
     "domain { surface: sphere; cells: 100 }\nsystem s { u: 1; turn: along(image(\"f.png\")); "
     "u' = diffuse(u, 0.4, 0.1, turn) }\nstage a: s { }"},
    {"rate", "along(axis(u, 1, 0))", "write along(vector(ex, ey, ez)) for a direction that changes",
     "along(vector(u, 1))"},
    {"rate", "sin(tensor(1, 2, 0))",
     "multiply it by a vector, as in div(tensor(a1, a2, theta) * grad(e))",
     "div(tensor(1, 2, 0) * grad(u))"},
    {"rate", "div(grad(u) * tensor(1, 2, 0))", "write the tensor before the vector",
     "div(tensor(1, 2, 0) * grad(u))"},
    {"rate", "div(grad(u) * grad(v))",
     "write dot(a, b) or cross(a, b) for a product of two vectors", "dot(grad(u), grad(v))"},
    {"rate", "lap(4)", "write a name that differs from cell to cell, such as a species", "lap(u)"},
    {"script", "domain { grid: 8, 8, 8 }\nsystem s { u: 1; u' = length(curl(u)) }\nstage a: s { }",
     "write curl(vector(0, 0, e)) for the vector (dy(e), -dx(e), 0)",
     "domain { grid: 8, 8, 8 }\nsystem s { u: 1; u' = length(curl(vector(0, 0, u))) }\nstage "
     "a: s { }"},
    {"rate", "shifted(u, v, 0)",
     "write columns first, then rows; both must be known before the run", "shifted(u, 1, 0)"},
    {"domain", "mask: lap(x)", "leave it out: a mask is computed before the cells have values",
     "mask: x"},
    {"domain", "mask: keys(0, 0, 0, 1)",
     "leave it out: it reads a model, but a mask belongs to a plane or a volume", "mask: x"},
    {"rate", "min(u)", "write min(e over domain) for all cells", "min(u over domain)"},
    {"script", "system s { u: 1; u' = half(u) }\nstage a: s { }",
     "define the function, as in fn half(a, b) = …",
     "fn half(a) = a / 2\nsystem s { u: 1; u' = half(u) }\nstage a: s { }"},
    {"picture", "color: palette(u, 0, 1, \"#1b2a49\")",
     "write the name of a palette, or 2 to 64 colours such as \"#1b2a49 #f08a5d #fff\"",
     "color: palette(u, 0, 1, \"#1b2a49 #fff\")"},
    {"picture", "color: palette(u, 4, 4, \"tan\")",
     "write palette(value, low, high, \"name\") with low below high",
     "color: palette(u, 0, 4, \"tan\")"},
    {"stage", "k: u", "write [u] for the 'u' of this stage", "k: [u]"},
    {"stage", "k: domain.size", "write domain.x, .y, .z, .width, .height, .depth or .spacing",
     "k: domain.width"},
    {"system", "u' = v\nrho: 1\n0 = lap(u) + rho",
     "leave one name without a value, such as phi in 0 = lap(phi) + rho",
     "u' = v\nrho: 1\n0 = lap(phi) + rho"},
    {"system", "u' = v\n## of nothing\n", "write one '#' for an ordinary comment",
     "u' = v\n# of nothing\n"},

    // Solvers and steps.
    {"stage", "speed: 0.5 + x; solver: rk4",
     "write solver: euler or solver: symplectic for a speed that varies",
     "speed: 0.5 + x; solver: euler"},
    {"script", "system s { i: 1..13; u[i]: 1; u[i]' = -u[i] }\nstage a: s { solver: ros2 }",
     "write solver: rkl2, which takes any number of species",
     "system s { i: 1..13; u[i]: 1; u[i]' = -u[i] }\nstage a: s { solver: rkl2 }"},
    {"script", "system s { u: 1; u' = smoothstep(u, 2, 0.5) }\nstage a: s { solver: ros2 }",
     "write solver: rkl2, which takes any rate; thresholds of smoothstep and tensors that turn "
     "with a species have no derivative",
     "system s { u: 1; u' = smoothstep(u, 2, 0.5) }\nstage a: s { solver: rkl2 }"},
    {"script", "system s { u: x; u' = lap(u) }\nstage a: s { solver: ros2 }\n",
     "write solver: rkl2 for rates that contain only diffusion; a reaction reads species "
     "outside of operators",
     "system s { u: x; u' = lap(u) }\nstage a: s { solver: rkl2 }\n"},
    {"script",
     "system s { u: x; u' = lap(u) }\ndomain { surface: sphere; cells: 100 }\nstage a: s { "
     "solver: imex }\n",
     "write solver: rkl1, which takes long steps on models",
     "system s { u: x; u' = lap(u) }\ndomain { surface: sphere; cells: 100 }\nstage a: s { "
     "solver: rkl1 }\n"},
    {"script",
     "system s { u: x; u' = lap(u) }\ndomain { grid: 16, 16; surface: sx, sy, 0 }\nstage a: s "
     "{ solver: imex }\n",
     "write solver: rkl1, which takes long steps there",
     "system s { u: x; u' = lap(u) }\ndomain { grid: 16, 16; surface: sx, sy, 0 }\nstage a: s "
     "{ solver: rkl1 }\n"},
    {"script",
     "system s { u: x; u' = lap(u) }\ndomain { stencil: isotropic }\nstage a: s { solver: imex "
     "}\n",
     "write solver: rkl2, which takes long steps with any stencil",
     "system s { u: x; u' = lap(u) }\ndomain { stencil: isotropic }\nstage a: s { solver: rkl2 "
     "}\n"},
    {"script", "system s { u: x; u' = lap(u) }\nstage a: s { solver: imex; frozen: x < 0.5 }\n",
     "write solver: rkl1, which takes long steps around frozen cells",
     "system s { u: x; u' = lap(u) }\nstage a: s { solver: rkl1; frozen: x < 0.5 }\n"},
    {"script",
     "domain { boundary: noflux }\nstage one: cahn_hilliard { solver: imex; c.top: fixed(1) }",
     "write solver: rkl1",
     "domain { boundary: noflux }\nstage one: cahn_hilliard { solver: rkl1; c.top: fixed(1) }"},
    {"stage", "solver: imex",
     "write solver: rk45, which takes any rate; diffusion is lap, dxx, diffuse or div(k * "
     "grad(u)) in the rate of u",
     "solver: rk45; duration: 9"},
    {"script",
     "domain { boundary: noflux }\nsystem s { u: 1; c = lap(u); u' = -lap(c); c.left: fixed(1) "
     "}\nstage a: s { solver: imex }",
     "write solver: rkl2",
     "domain { boundary: noflux }\nsystem s { u: 1; c = lap(u); u' = -lap(c); c.left: fixed(1) "
     "}\nstage a: s { solver: rkl2 }"},
    {"script",
     "domain { boundary: noflux }\nsystem s { u: 1; v: 1; u' = v; v' = lap(u); u.left: "
     "fixed(v) }\nstage a: s { solver: symplectic }",
     "write solver: rk4, which steps all species together",
     "domain { boundary: noflux }\nsystem s { u: 1; v: 1; u' = v; v' = lap(u); u.left: "
     "fixed(v) }\nstage a: s { solver: rk4 }"},
    {"script",
     "domain { boundary: noflux }\nsystem s { u: 1; u' = lap(u); u.left: slope(u) }\nstage a: "
     "s { solver: imex }",
     "write solver: rkl2, which takes long steps, too",
     "domain { boundary: noflux }\nsystem s { u: 1; u' = lap(u); u.left: slope(u) }\nstage a: "
     "s { solver: rkl2 }"},

    // Domains that grow.
    {"domain", "extent: 10 * u",
     "write a formula of numbers and t, as in extent: 10 * exp(0.01 * t)",
     "extent: 10 * exp(0.01 * t)"},
    {"script",
     "system s { u: x; u' = lap(u) }\ndomain { grid: 16; extent: 10 + t }\nstage a: s { "
     "duration: 20; speed: 0.1; size: 4 }\n",
     "leave out 'size': the wavelength then follows from the equations",
     "system s { u: x; u' = lap(u) }\ndomain { grid: 16; extent: 10 + t }\nstage a: s { "
     "duration: 20; speed: 0.1 }\n"},
    {"script",
     "system s { u: x; u' = lap(u) }\ndomain { grid: 16; extent: 10 + t }\nstage a: s { "
     "duration: 20; speed: 0.1; start: coarse(2) }\n",
     "write grid: coarse(2) to run the whole stage on a coarser grid",
     "system s { u: x; u' = lap(u) }\ndomain { grid: 16; extent: 10 + t }\nstage a: s { "
     "duration: 20; speed: 0.1; grid: coarse(2) }\n"},
    {"script",
     "system s { u: x; u' = lap(u) }\ndomain { grid: 16; extent: 10 + t }\nstage a: s { speed: "
     "0.1 * x }\n",
     "give one number as the speed of all cells",
     "system s { u: x; u' = lap(u) }\ndomain { grid: 16; extent: 10 + t }\nstage a: s { speed: "
     "0.1 }\n"},
    {"script",
     "system s { u: x; u' = lap(u) }\ndomain { grid: 16, 8; extent: 16 + t, 8; mask: disc(0.4, "
     "0.2, 0.2) }\nstage a: s { speed: 0.1; u.border: slope(1) }\n",
     "write border: fixed(…) or border: noflux",
     "system s { u: x; u' = lap(u) }\ndomain { grid: 16, 8; extent: 16 + t, 8; mask: disc(0.4, "
     "0.2, 0.2) }\nstage a: s { speed: 0.1; u.border: fixed(1) }\n"},

    {"script",
     "system s { u: x; u' = lap(u) }\ndomain { surface: sphere; cells: 100; unit: 0.3 + t }\nstage "
     "a: s { }",
     "write extent: 30 * exp(0.01 * t) for the length of the longest side in units",
     "system s { u: x; u' = lap(u) }\ndomain { surface: sphere; cells: 100; extent: 30 * exp(0.01 * "
     "t) }\nstage a: s { }"},
    {"script",
     "system s { u: x; u' = lap(u) }\ndomain { surface: sphere; cells: 100 }\nstage a: s { extent: "
     "40 }",
     "write extent: 40 in the domain, for example, for the length of the longest side",
     "system s { u: x; u' = lap(u) }\ndomain { surface: sphere; cells: 100; extent: 40 }\nstage a: "
     "s { extent: 50 }"},
    {"script",
     "system s { u: x; u' = lap(u) }\ndomain { grid: 16, 16; surface: sx, sy, 0; metric: 0; extent: "
     "3 }\nstage a: s { }",
     "write metric: 1 to measure lengths on the surface",
     "system s { u: x; u' = lap(u) }\ndomain { grid: 16, 16; surface: sx, sy, 0; metric: 1; extent: "
     "3 }\nstage a: s { }"},

    // Sides, surfaces and models.
    {"stage", "left: fixed(1)",
     "write SPECIES.left: … for one species, or left: … in the domain for all species",
     "u.left: fixed(1); u.right: noflux"},
    {"script",
     "system s { u: x; u' = lap(u) }\ndomain { mask: disc(0.5, 0.5, 0.4); border: periodic "
     "}\nstage a: s { }\n",
     "write noflux, fixed(…), slope(…) or flux(…)",
     "system s { u: x; u' = lap(u) }\ndomain { mask: disc(0.5, 0.5, 0.4); border: noflux "
     "}\nstage a: s { }\n"},
    {"script",
     "system s { u: x; u' = lap(u) }\ndomain { mask: disc(0.5, 0.5, 0.4) }\nstage a: s { "
     "u.left: noflux; u.right: noflux }\n",
     "set it for all species by the domain's boundary, as in boundary: periodic, noflux",
     "system s { u: x; u' = lap(u) }\ndomain { mask: disc(0.5, 0.5, 0.4); boundary: noflux "
     "}\nstage a: s { u.left: noflux; u.right: noflux }\n"},
    {"script",
     "domain { boundary: noflux }\nsystem s { u: 1; c = lap(u); u' = -lap(c); c.left: periodic "
     "}\nstage a: s { }",
     "leave it out: the side is periodic if the sides of the species in the definition are",
     "domain { boundary: noflux }\nsystem s { u: 1; c = lap(u); u' = -lap(c) }\nstage a: s { }"},
    {"script",
     "domain { boundary: noflux }\nsystem s { u: 1; c = lap(u); u' = -lap(c); c.left: flux(1) "
     "}\nstage a: s { }",
     "write slope(…): the flux is this slope times the factor before lap or grad",
     "domain { boundary: noflux }\nsystem s { u: 1; c = lap(u); u' = -lap(c); c.left: slope(1) "
     "}\nstage a: s { }"},
    {"script",
     "system s { u: x; u' = lap(u) }\ndomain { stencil: fourth; boundary: noflux }\nstage a: s "
     "{ u.left: fixed(1) }\n",
     "write stencil: isotropic or stencil: cross for sides with values, slopes or fluxes",
     "system s { u: x; u' = lap(u) }\ndomain { stencil: cross; boundary: noflux }\nstage a: s "
     "{ u.left: fixed(1) }\n"},
    {"domain", "grid: 16, 16; surface: sx, sy, 0; stencil: fourth", "write stencil: cross",
     "grid: 16, 16; surface: sx, sy, 0; stencil: cross"},
    {"domain", "surface: \"model.obj\"", "write mesh: \"model.obj\" for a model in a file",
     "mesh: \"model.obj\""},
    {"domain", "grid: 16, 16; surface: sx, sy, 0; spacing: 0.5",
     "write unit: … for the length of one unit on the surface",
     "grid: 16, 16; surface: sx, sy, 0; unit: 0.5"},
    {"domain", "surface: sphere; grid: 8, 8",
     "write cells: 20000 or --cells 20000 to spread cells over the model",
     "surface: sphere; cells: 20000"},
    {"domain", "surface: box; front: -x",
     "write facing: -y, for example, for the axis along which the model looks",
     "surface: box; facing: -x"},
    {"domain", "surface: sphere; boundary: noflux",
     "leave it out: nothing flows out where the surface of a model ends", "surface: sphere"},
    {"domain", "surface: box; facing: y", "choose another axis, or write up: z if z points upwards",
     "surface: box; facing: y; up: z"},
    {"domain", "surface: box; facing: z; up: z", "choose another axis",
     "surface: box; facing: x; up: z"},
    {"domain", "up: z", "add mesh: \"horse.ply\" or surface: sphere, or run with --mesh sphere",
     "up: z; surface: sphere"},

    // Cells that crawl, and shapes.
    {"cells", "b' = own(a)",
     "leave own(…) out: outside of such sums, names already belong to the cell itself", "b' = a"},
    {"cells", "p: vector(0, 0, 0)",
     "write founders: keys(x, y, z) in a stage for the positions at the start", "b' = 1"},
    {"cells", "ez' = 1", "write turn' += … to turn the axes of a cell", "turn' += vector(0, 0, 1)"},
    {"cells", "divide: a > 2; along: vector(random(0, 1), 0, 0)",
     "leave 'along' out: the direction of divisions is then random", "divide: a > 2"},
    {"cells", "b' = domain.x", "write p.x, p.y and p.z for the position of a cell", "b' = p.x"},
    {"tissue", "duration: 1; founders: 1; a: two.a",
     "leave 'founders' out to continue with the cells of the stage before",
     "duration: 1; a: two.a"},
    {"tissue", "duration: 1; founders: 2; p: vector(0, 0, 0)",
     "write founders: keys(x, y, z) for the positions at the start",
     "duration: 1; founders: keys(0.5, 0.5, 0)"},
    {"script",
     "domain { surface: sphere; cells: 100 }\nstage g: gray_scott { iterations: 1 }\nstage s: "
     "scales { duration: 1; founders: 6; body: g.v - 0.3 }",
     "leave 'body' out: on a model the cells crawl on the model's surface",
     "domain { surface: sphere; cells: 100 }\nstage g: gray_scott { iterations: 1 }\nstage s: "
     "scales { duration: 1; founders: 6 }"},
    {"tissue", "duration: 1 }\npicture { shape: 3",
     "write shape: thorn or shape: \"horn.ply\", for example",
     "duration: 1 }\npicture { shape: thorn"},
    {"shape", "place = t", "write vector(x, y, z)", "place = vector(0, t, 0)"},
    {"shape", "radius = 1; place = vector(0, t, 0)",
     "write either place = …, or radius = … and middle = …", "radius = 1"},
};

}  // namespace cascade::test

// Help texts. This file does not include CLI11, because that takes long to compile.
#include "app/help.h"

#include "core/version.h"
#include "run/simulation/simulation.h"

#include <fmt/format.h>

#include <iterator>
#include <sstream>

namespace cascade::help {

const std::string_view about =
    "Cascade grows patterns by reaction and diffusion: a page of text becomes spots, stripes,\n"
    "a leopard.";

const std::string_view examples = R"(Examples:
  cascade run examples/leopard.cascade               draws leopard.png
  cascade run leopard.cascade --grid 256x256 --palette leopard --scale 2
  cascade run leopard.cascade --set stage2.ka=1/200 --seed 7 -o other.png
  cascade run leopard.png                            draws a picture again
  cascade check my.cascade                           says what is wrong with it
  cascade systems                                    the systems of the library
  cascade examples                                   scripts with pictures to learn from
  cascade new brusselator -o my.cascade              a script to start from

A first script, spots.cascade:
  stage large: turing_spots { iterations: 28000; ka: 0.05/16 }
  stage small: turing_spots {
    iterations: 7000
    frozen: b < 4                # the spots of 'large' stay
    a: if([frozen], 4, a)
    b: if([frozen], 4, b)
    ka: 0.2/16
  }

Exit status: 0 done, 1 fmt --check found one to change, 2 wrong script, 3 failed run, 64 wrong use, 130 stopped by Ctrl-C.)";

const std::string_view run = "Runs a script and draws a picture.";
const std::string_view run_examples = R"(Examples:
  cascade run leopard.cascade                        leopard.png: the last stage that ran
  cascade run leopard.cascade --show stage1.b        another species, another stage
  cascade run leopard.cascade --sheet all.png        everything at a glance
  cascade run leopard.cascade -o film.gif            a film with a frame at each interval
  cascade run leopard.cascade -o film.mp4 --seconds 8 --label stage --label step
  cascade run leopard.cascade --frames folder        the frames as pictures
  cascade run leopard.cascade --save half --stop-at stage1:9000
  cascade run --resume half                          the same bits as without the stop
  cascade run line.cascade --space-time              one dimension, time runs downwards
  cascade run coral.cascade --log 'mean(v over domain)' --features
  cascade run coral.cascade --mesh horse.ply --up z -o coral.png -o coral.glb

Ctrl-C stops at a complete step and writes the results so far; a second one leaves at once.)";

const std::string_view sweep =
    "Runs a script with many values of its parameters: one labelled sheet, one table.";
const std::string_view sweep_examples = R"(Examples:
  cascade sweep spots.cascade --vary ka=1/400,1/200,1/100 --vary seed=1,2,3
  cascade sweep coral.cascade --vary gray_scott.feed=0.02..0.06:9 --vary gray_scott.kill=0.05..0.07:9
  cascade sweep coral.cascade --vary seed=1..1000:1000 --part 3/100      a job of a cluster

All results go into one folder: sheet.png, features.csv (wavelength, spots, area and direction of
the shown pattern), and a small result of every run. The same command continues a sweep that was
stopped, and a command with more values computes only the new runs.)";

const std::string_view follow =
    "Follows steady states through a parameter, with folds, branch points and their stability.";
const std::string_view follow_examples = R"(Examples:
  cascade continue hills.cascade --vary r=-0.5..0.2            hills_branches.csv and .svg
  cascade continue hills.cascade --vary r=-0.5..0.2 --flat --branches 4
  cascade continue hills.cascade --vary r=-0.5..0.2 --curve max -o hills.pdf -o hills.csv

The first state is the end of the script's run, or with --flat the state in which all cells are
equal.)";

const std::string_view check = "Checks scripts for errors, and runs nothing.";
const std::string_view check_examples = R"(Examples:
  cascade check *.cascade
  cascade check leopard.cascade --dump ir            what a cell computes in a step)";

const std::string_view analyze =
    "Says what will grow from a script's equations: flat states, waves, stable steps. Runs "
    "nothing.";
const std::string_view analyze_examples = R"(Examples:
  cascade analyze spots.cascade                      the first stage
  cascade analyze leopard.cascade --stage small --set small.ka=0.01
  cascade analyze spots.cascade -o spots.svg         the dispersion relation
  cascade analyze spots.cascade --vary decay=4..12 --vary feed=2..6 -o map.png)";

const std::string_view bench =
    "Measures the steps of scripts and says what limits their speed. Writes no file.";
const std::string_view bench_examples = R"(Examples:
  cascade bench leopard.cascade                      a table for each stage
  cascade bench leopard.cascade --stage 2 --grid 512x512 --threads 1
  cascade bench examples/*.cascade --seconds 0.3 --csv > before.csv)";

const std::string_view compile =
    "Writes a stage, its starting values and its steps, as an object file with a C header.";
const std::string_view compile_examples = R"(Example:
  cascade compile spots.cascade --per-cell ka -o step.o && cc -O2 main.c step.o
The comment at the top of step.h says how a program uses it.)";

const std::string_view systems =
    "Lists the systems of the library, or shows one: equations, parameters, defaults.";
const std::string_view systems_examples = R"(Examples:
  cascade systems                                    all of them, a line each
  cascade systems spots                              all systems that mention spots
  cascade systems gray_scott                         its equations and parameters
  cascade systems my.cascade                         the systems of a script)";

const std::string_view examples_about = "Lists the examples that come with Cascade, or prints one.";
const std::string_view examples_examples = R"text(Examples:
  cascade examples                                   all of them, a line each
  cascade examples giraffe                           all examples that mention giraffes
  cascade examples leopard > leopard.cascade         the text of one
  cascade examples on_models/emperor -o my.cascade   one with the picture that it reads
  cascade run "$(cascade examples leopard --path)"   runs it where it is)text";

const std::string_view palettes = "Shows palettes: their colours, names and descriptions.";
const std::string_view palettes_examples = R"(Examples:
  cascade palettes                                   all of them, a line each
  cascade palettes -o palettes.svg                   as a sheet
  cascade palettes "#1b2a49 #f08a5d #fff3d6"         your own colours)";

const std::string_view new_script = "Prints a script to start from: a system of the library.";
const std::string_view new_script_examples = R"(Examples:
  cascade new brusselator -o my.cascade
  cascade run my.cascade)";

const std::string_view import_model =
    "Writes a script of a model of another program, without changing what the model means.";
const std::string_view import_model_examples = R"(Examples:
  cascade import Brusselator.vti                     a formula pattern of Ready
  cascade import spots.vti -o spots2.cascade
  cascade import 'https://visualpde.com/sim/?options=…' -o spirals.cascade
  cascade import presets.js --preset KdV             a preset of VisualPDE
  cascade import neuron.ode --diffusion v=1
A part of the model that Cascade cannot express is an error at its line. Differences are
reported and written as comments.)";

const std::string_view format =
    "Rewrites scripts in the canonical style: blanks, lines, indentation.";
const std::string_view format_examples = R"(Examples:
  cascade fmt leopard.cascade                        changes the file if it has to
  cascade fmt --check *.cascade                      status 1 if one would change
  cascade fmt - < draft.cascade                      to standard output
  cascade fmt --unicode spots.cascade                ∂u/∂t = D∇²u for u' = D*lap(u)
Comments stay, and so do columns that an author has lined up. A script with errors of syntax
is not changed.)";

const std::string_view mesh =
    "Describes 3-D models, and what has to be repaired in them; writes them refined, simplified or "
    "with texture coordinates.";
const std::string_view mesh_examples = R"(Examples:
  cascade mesh horse.ply
  cascade mesh *.obj --cells 4000                    with cells spread over each
  cascade mesh horse.ply --unwrap -o horse.glb       with texture coordinates
  cascade mesh horse.ply --simplify 5000 -o low.obj  with fewer triangles
PLY, OBJ, OFF, STL, glTF and GLB are read.)";

const std::string_view repl = "Runs the language line by line, with pictures in the terminal.";
const std::string_view repl_examples = R"(Example:
  cascade repl leopard.cascade
Then :help lists the commands.)";

const std::string_view view =
    "Opens a script in the browser: its pattern grows while text and numbers change.";
const std::string_view view_examples = R"(Examples:
  cascade view                                       offers the systems of the library
  cascade view leopard.cascade
  cascade view leopard.cascade --no-browser          prints the address
Only this machine can reach the page. Ctrl-C ends it.)";

const std::string_view lsp =
    "Checks and explains scripts in an editor: a server of the Language Server Protocol.";
const std::string_view lsp_examples = R"(Examples:
  vim.lsp.config.cascade = { cmd = { "cascade", "lsp" }, filetypes = { "cascade" } }
  (add-to-list 'eglot-server-programs '(cascade-mode "cascade" "lsp"))
Editors start it and speak with it on standard input and output. docs/editors.md has the settings of
VS Code, Vim, Neovim, Emacs and Kate.)";

const std::string_view export_page =
    "Writes a script as one page that any browser opens: its pattern grows there, offline.";
const std::string_view export_page_examples = R"(Example:
  cascade export leopard.cascade --html leopard.html
The page works like the page of 'cascade view'. It contains Cascade, the model and the pictures of
the script.)";

std::string in_lines(const std::vector<std::string>& names) {
    constexpr std::size_t widest = 52;
    std::string text;
    std::size_t column = 0;
    for (const std::string& name : names) {
        const bool fits = column + name.size() < widest;
        if (column > 0) text += fits ? ' ' : '\n';
        column = (fits ? column + 1 : 0) + name.size();
        text += name;
    }
    return text;
}

std::string in_lines(const std::string& text) {
    std::istringstream words(text);
    return in_lines(std::vector<std::string>(std::istream_iterator<std::string>(words), {}));
}

std::string version_text() {
    return fmt::format("cascade {}\n{}\n", version(), fastest_backend().describe());
}

}  // namespace cascade::help

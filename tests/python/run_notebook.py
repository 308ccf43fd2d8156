"""Runs the code cells of a notebook in the current folder, without Jupyter: run_notebook.py NOTEBOOK.

Shows the last value of each cell as Jupyter would, by the value's own methods, and checks what they
return. Prints a line for each cell.
"""

import ast
import json
import pathlib
import sys


def run(source, name, names):
    """Runs a cell. Returns the value of its last line if that is an expression, or else None."""
    tree = ast.parse(source, name)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, name, "exec"), names)
    return eval(compile(ast.Expression(last.value), name, "eval"), names) if last else None


def shown(value):
    """What Jupyter would show of a value, in a few words."""
    if value is None:
        return "nothing"
    if hasattr(value, "_repr_html_"):
        text = value._repr_html_()
        assert text.startswith("<") and len(text) > 100, text
        return "HTML"
    if hasattr(value, "_repr_png_"):
        assert value._repr_png_().startswith(b"\x89PNG")
        return "a picture"
    return repr(value)[:60]


def main(path):
    notebook = json.loads(pathlib.Path(path).read_text())
    cells = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
    names = {"__name__": "__main__"}
    for number, cell in enumerate(cells, 1):
        assert not cell["outputs"] and cell["execution_count"] is None, "the notebook contains outputs"
        print(f"cell {number}: {shown(run(''.join(cell['source']), f'<cell {number}>', names))}")


if __name__ == "__main__":
    main(sys.argv[1])

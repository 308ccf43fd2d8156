"""Docstrings and types."""

import ast
import builtins
import inspect
import pathlib
import re
import unittest

import cascade


class Documentation(unittest.TestCase):
    def test_everything_has_a_docstring(self):
        for name in cascade.__all__:
            thing = getattr(cascade, name)
            self.assertTrue(name == "__version__" or thing.__doc__, name)
            for member in vars(thing) if isinstance(thing, type) else []:
                if not member.startswith("_") and name != "Error":
                    self.assertTrue(getattr(thing, member).__doc__, f"{name}.{member}")

    def test_the_stub_has_the_types_of_the_module(self):
        stub = ast.parse((pathlib.Path(cascade.__file__).parent / "__init__.pyi").read_text())
        typed = {node.name: node for node in stub.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
        self.assertEqual(set(typed) | {"__version__"}, set(cascade.__all__))
        for name, node in typed.items():
            thing = getattr(cascade, name)
            if isinstance(node, ast.FunctionDef):
                self.assertEqual(parameters_of_stub(node), parameters_of(thing), name)
                continue
            self.assertTrue(all(issubclass(thing, getattr(builtins, base.id, object)) for base in node.bases), name)
            members = {member.name: member for member in node.body if isinstance(member, ast.FunctionDef)}
            attributes = {member.target.id for member in node.body if isinstance(member, ast.AnnAssign)}
            self.assertEqual(public(members) | attributes, public_of(thing), name)
            for member, function in members.items():
                found = inspect.getattr_static(thing, member)
                is_property = any(getattr(each, "id", "") == "property" for each in function.decorator_list)
                self.assertEqual(is_property, isinstance(found, property), f"{name}.{member}")
                if not is_property and (not member.startswith("__") or member == "__init__"):
                    self.assertEqual(parameters_of_stub(function), parameters_of(getattr(thing, member)), f"{name}.{member}")


def public(names):
    return {name for name in names if not name.startswith("_")}


def public_of(kind):
    """The public members of a class, also of its instances, without members that all Python classes have."""
    if kind is cascade.Film or kind is cascade.Page:
        return public(dir(kind)) | public(vars(kind.__new__(kind)) or INSTANCE_MEMBERS[kind])
    return public(dir(kind)) - public(dir(tuple)) - public(dir(ValueError))


INSTANCE_MEMBERS = {cascade.Film: {"data", "media_type"}, cascade.Page: {"html", "height"}}


def parameters_of_stub(function):
    """The names of parameters, each with its default if it has one."""
    given = function.args
    defaults = [None] * (len(given.args) - len(given.defaults)) + given.defaults
    named = [(each.arg, default) for each, default in zip(given.args, defaults)]
    named += list(zip([each.arg for each in given.kwonlyargs], given.kw_defaults))
    names = [(name, None if default is None else ast.literal_eval(default)) for name, default in named
             if name not in ("self", "cls")]
    return names + ([(f"**{given.kwarg.arg}", None)] if given.kwarg else [])


def parameters_of(function):
    """The same of a function of the module. Functions in C++ have their parameters in their docstrings."""
    try:
        signature = inspect.signature(function)
    except ValueError:
        text = re.search(r"\w+(\(.*\)) ->", function.__doc__.replace("1. ", "").replace("Overloaded function.", ""))[1]
        text = re.sub(r"(\w+): [\w.\[\], ]+?(?=(, \w+:)|\)|( = )|(, \*))", r"\1", text)
        tree = ast.parse(f"def f{text}: ...").body[0]
        return parameters_of_stub(tree)
    return [(f"**{name}" if each.kind is each.VAR_KEYWORD else name, None if each.default is each.empty else each.default)
            for name, each in signature.parameters.items() if name not in ("self", "cls")]

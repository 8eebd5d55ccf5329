# SPDX-License-Identifier: MIT
"""Every public name is documented, with shapes and units, and the stubs name the same."""
import ast
import inspect
import os
import unittest

from support import df, main

def members(cls):
    return {name for name in vars(cls) if not name.startswith("_")}


def stubs():
    with open(os.path.join(os.path.dirname(df.__file__), "__init__.pyi")) as file:
        return ast.parse(file.read()).body


def functions():
    """Name, object and stub of every public function, method and property."""
    for node in stubs():
        if isinstance(node, ast.FunctionDef):
            yield node.name, getattr(df, node.name), node
        elif isinstance(node, ast.ClassDef):
            for member in node.body:
                if isinstance(member, ast.FunctionDef) and not member.name.startswith("_"):
                    yield f"{node.name}.{member.name}", getattr(getattr(df, node.name), member.name), member


class Api(unittest.TestCase):
    def test_docstrings(self):
        for name in df.__all__:
            thing = getattr(df, name)
            if isinstance(thing, int): continue
            self.assertTrue(inspect.getdoc(thing), name)
            if not inspect.isclass(thing) or issubclass(thing, Exception): continue
            for member in members(thing):
                self.assertTrue(inspect.getdoc(getattr(thing, member)), f"{name}.{member}")

    def test_arrays_have_shapes(self):
        for name, thing, node in functions():
            if "NDArray" in ast.unparse(node.returns):
                self.assertRegex(inspect.getdoc(thing), r"[NM] x 3|[NM] uint8|N float32|N records|4 x 4|static_map\(\)", name)

    def test_arguments_are_explained_with_shapes_units_and_frames(self):
        facets = {"points": "N x 3.*\[m\] in the sensor frame", "pose": "4 x 4, T_world_"}
        for name, thing, node in functions():
            doc = " ".join(inspect.getdoc(thing).split())
            for argument in node.args.args + node.args.kwonlyargs:
                if argument.arg in ("self", "i"): continue
                self.assertRegex(doc, rf"\b{argument.arg}\b", name)
                if argument.arg in facets: self.assertRegex(doc, argument.arg + ": " + facets[argument.arg], name)
                if "float" in ast.unparse(argument.annotation):
                    self.assertRegex(doc, rf"\b{argument.arg}\b[^;.]*?(\[\w+\]|per second|rate)", name)

    def test_results_and_errors_are_named(self):
        for name, thing, node in functions():
            if any(isinstance(d, ast.Name) and d.id == "property" for d in node.decorator_list): continue
            self.assertIn("Raises", inspect.getdoc(thing), name)
            if ast.unparse(node.returns) != "None": self.assertRegex(inspect.getdoc(thing), "Returns|returns", name)

    def test_classes_say_who_owns_arrays_and_who_may_call(self):
        for cls in (df.DynamicFilter, df.Frame, df.Recording):
            self.assertIn("thread", inspect.getdoc(cls))
        self.assertIn("copied", inspect.getdoc(df.DynamicFilter))
        self.assertIn("views", inspect.getdoc(df.Frame))

    def test_names(self):
        self.assertEqual(df.DynamicFilter.__module__, "dynamicfilter")
        self.assertTrue(issubclass(df.InputError, df.Error))
        self.assertEqual(repr(df.ConfigError), "<class 'dynamicfilter.ConfigError'>")

    def test_stubs_name_what_there_is(self):
        named = {}
        for node in stubs():
            if isinstance(node, ast.ClassDef):
                named[node.name] = {f.name for f in node.body if isinstance(f, ast.FunctionDef)}
            elif isinstance(node, ast.FunctionDef):
                named[node.name] = node
            elif isinstance(node, ast.AnnAssign):
                named[node.target.id] = node
        public = {name for name in named if not name.startswith("_")}
        self.assertEqual(public, set(df.__all__))
        for name in ("DynamicFilter", "Frame", "Recording"):
            stubbed = {m for m in named[name] if not m.startswith("_")}
            self.assertEqual(stubbed, members(getattr(df, name)))

    def test_options_by_name_are_explained(self):
        options = {node.name: [a.target.id for a in node.body] for node in stubs()
                   if isinstance(node, ast.ClassDef) and node.name in ("_Reading", "_Running")}
        for thing, names in ((df.open_recording, options["_Reading"]), (df.run, options["_Running"])):
            for name in names:
                self.assertRegex(inspect.getdoc(thing), rf"\b{name}\b")

    def test_stubs_have_the_arguments_of_the_functions(self):
        for node in stubs():
            if not isinstance(node, ast.FunctionDef): continue
            thing = getattr(df, node.name)
            for argument in node.args.args + node.args.kwonlyargs:
                self.assertIn(argument.arg, inspect.getdoc(thing), node.name)


if __name__ == "__main__":
    main()

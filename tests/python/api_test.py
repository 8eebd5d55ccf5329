# SPDX-License-Identifier: MIT
"""Every public name is documented, with shapes and units, and the stubs name the same."""
import ast
import inspect
import os
import unittest

from support import df, main

WITH_ARRAYS = (df.DynamicFilter.push, df.DynamicFilter.labels, df.DynamicFilter.corrections,
               df.DynamicFilter.static_map, df.Frame.points, df.Frame.pose, df.Frame.truth,
               df.Frame.fields, df.read_cloud, df.open_recording)


def members(cls):
    return {name for name in vars(cls) if not name.startswith("_")}


def stubs():
    with open(os.path.join(os.path.dirname(df.__file__), "__init__.pyi")) as file:
        return ast.parse(file.read()).body


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
        for thing in WITH_ARRAYS:
            self.assertRegex(inspect.getdoc(thing), r"[NM] x 3|N uint8|N records|4 x 4")

    def test_lengths_have_units(self):
        for thing in (df.DynamicFilter.push, df.DynamicFilter.static_map, df.Frame.points,
                      df.Frame.pose, df.simulate, df.evaluate, df.open_recording):
            self.assertIn("[m]", inspect.getdoc(thing))

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

    def test_stubs_have_the_arguments_of_the_functions(self):
        for node in stubs():
            if not isinstance(node, ast.FunctionDef): continue
            thing = getattr(df, node.name)
            for argument in node.args.args + node.args.kwonlyargs:
                self.assertIn(argument.arg, inspect.getdoc(thing), node.name)


if __name__ == "__main__":
    main()

"""The stub of the compiled module says what is in it."""

import ast
import inspect
import pathlib
import re
import sys
import unittest

import armcal
from armcal import _armcal, commands, option_kinds

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import write_stubs


def stub():
    path = pathlib.Path(armcal.__file__).with_name("_armcal.pyi")
    return ast.parse(path.read_text(encoding="utf-8")).body


def public(names):
    return {name for name in names if not name.startswith("_")}


def stub_arguments(function):
    arguments = function.args
    count = len(arguments.args) - len(arguments.defaults)
    found = [(a.arg, k >= count) for k, a in enumerate(arguments.args)]
    return found + [(a.arg, default is not None) for a, default in zip(
        arguments.kwonlyargs, arguments.kw_defaults)]


def real_arguments(function):
    """Of Python's own, or of the first line of a docstring of pybind11."""
    if inspect.isfunction(function):
        return [(p.name, p.default is not p.empty)
                for p in inspect.signature(function).parameters.values()]
    text = re.match(r"\w+\((.*)\) -> ", function.__doc__).group(1)
    text = re.sub(r"\[[^\[\]]*\]", "", re.sub(r"\[[^\[\]]*\]", "", text))
    parts = [part.strip() for part in text.split(",")]
    return [(re.match(r"\w+", part).group(0), "=" in part)
            for part in parts if part and part != "*"]


class Stub(unittest.TestCase):

    def check_function(self, function, real):
        self.assertEqual(stub_arguments(function), real_arguments(real),
                         function.name)

    def test_module(self):
        body = stub()
        names = {node.name for node in body
                 if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
        names |= {node.target.id for node in body
                  if isinstance(node, ast.AnnAssign)}
        self.assertEqual(public(names), public(vars(_armcal)))
        for node in body:
            if isinstance(node, ast.FunctionDef):
                self.check_function(node, getattr(_armcal, node.name))

    def test_classes(self):
        for node in stub():
            if not isinstance(node, ast.ClassDef):
                continue
            real = getattr(_armcal, node.name)
            methods = {m.name: m for m in node.body
                       if isinstance(m, ast.FunctionDef)}
            self.assertEqual(public(methods), public(vars(real)), node.name)
            for name, method in methods.items():
                member = inspect.getattr_static(real, name)
                if any(d.id == "property" for d in method.decorator_list):
                    self.assertIsInstance(member, property, name)
                elif not name.startswith("_"):
                    self.check_function(method, getattr(real, name))

    def test_everything_is_documented(self):
        for name in armcal.__all__:
            if name.startswith(("INERTIAL", "__")):
                continue
            self.assertTrue(inspect.getdoc(getattr(armcal, name)), name)
        for name, member in vars(armcal.Robot).items():
            if not name.startswith("_"):
                self.assertTrue(inspect.getdoc(member), name)

    def test_functions_are_those_of_the_flags(self):
        written = write_stubs.PACKAGE / "__init__.pyi"
        self.assertEqual(written.read_text(encoding="utf-8"),
                         write_stubs.stub(),
                         "tests/python/write_stubs.py writes it anew")

    def test_signatures_have_the_flags_defaults(self):
        left_out = {"json", "quiet", "robot"}
        for function in commands.FUNCTIONS:
            parameters = inspect.signature(function).parameters
            options = option_kinds.options_of(function.__name__)
            self.assertLessEqual({option.name for option in options} -
                                 left_out, set(parameters))
            for parameter in parameters.values():
                self.assertIsNot(parameter.annotation, parameter.empty)
        found = inspect.signature(armcal.calibrate).parameters
        self.assertEqual(found["trust"].default, .5)
        self.assertEqual(found["select"].default, False)
        self.assertIsNone(found["bandwidth"].default)
        self.assertEqual(found["bandwidth"].annotation, "Optional[float]")
        self.assertIn("'lengths'", found["geometry"].annotation)
        found = inspect.signature(armcal.excite).parameters
        self.assertEqual(found["pose_noise"].default, (1e-4, 1e-4))
        self.assertRegex(armcal.calibrate.__doc__,
                         r"(?m)^ +window +float, s: length of the weak")

    def test_options_are_in_the_docstring(self):
        for command in ("calibrate", "diagnose", "verify", "inspect",
                        "excite", "simulate"):
            function = getattr(armcal, command)
            known = set(inspect.signature(function).parameters)
            for option in armcal.options(command):
                if option not in known | {"json", "quiet"}:
                    self.assertRegex(function.__doc__, rf"(?m)^ +{option} ",
                                     command)


if __name__ == "__main__":
    unittest.main()

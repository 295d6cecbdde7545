#!/usr/bin/env python3
"""Isaac Lab's own actuator configurations take what armcal writes.

    pip download --no-deps isaaclab==2.3.2.post1
    python3 tests/peers/check_isaac.py isaaclab-*.whl isaac_actuators.py ..

The configurations are dataclasses in the wheel of PyPI; the simulator beneath
them is not on PyPI, and they do not need it: its classes are stood in for by
their names. Every field that a file gives has to be one of the class's, of the
kind that its annotation says."""

import ast
import dataclasses
import importlib.util
import sys
import types
import zipfile

FOLDER = "isaaclab/source/isaaclab/isaaclab/actuators/"


class Named(types.ModuleType):
    """A module whose classes are their names."""

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return name


def module(name, text=None):
    made = Named(name) if text is None else types.ModuleType(name)
    sys.modules[name] = made
    made.__path__ = []
    if text is not None:
        made.__package__ = name.rpartition(".")[0]
        exec(compile(text, name, "exec"), made.__dict__)
    return made


def load_configurations(wheel):
    """The package isaaclab.actuators with the configurations of the wheel."""
    texts = zipfile.ZipFile(wheel)
    module("isaaclab")
    module("isaaclab.utils").configclass = dataclasses.dataclass
    package = module("isaaclab.actuators")
    module("isaaclab.actuators.actuator_pd")
    package.actuator_pd = sys.modules["isaaclab.actuators.actuator_pd"]
    module("isaaclab.actuators.actuator_base_cfg",
           texts.read(FOLDER + "actuator_base_cfg.py").decode()
           .replace("= MISSING", "= None"))
    found = module("isaaclab.actuators.actuator_pd_cfg",
                   texts.read(FOLDER + "actuator_pd_cfg.py").decode()
                   .replace("= MISSING", "= None"))
    for name in ("IdealPDActuatorCfg", "DelayedPDActuatorCfg", "DCMotorCfg"):
        setattr(package, name, getattr(found, name))


def check(path):
    spec = importlib.util.spec_from_file_location("written", path)
    written = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(written)
    with open(path, encoding="utf-8") as file:
        joints = sum(isinstance(node, ast.Call) and
                     getattr(node.func, "id", "").endswith("Cfg")
                     for node in ast.walk(ast.parse(file.read())))
    actuators = written.actuators(physics_dt=0.002)
    assert len(actuators) == joints, (len(actuators), joints)
    for name, actuator in actuators.items():
        assert len(actuator.joint_names_expr) == 1, name
        for field in dataclasses.fields(actuator):
            value = getattr(actuator, field.name)
            if "float" in str(field.type) and value is not None:
                assert isinstance(value, (int, float)), (name, field.name)
                assert value >= 0, (name, field.name, value)
        if hasattr(actuator, "max_delay"):
            assert isinstance(actuator.max_delay, int), name
    kinds = {type(a).__name__ for a in actuators.values()}
    print(f"{path}: {len(actuators)} actuators, {', '.join(sorted(kinds))}")


def main():
    load_configurations(sys.argv[1])
    for path in sys.argv[2:]:
        check(path)


if __name__ == "__main__":
    main()

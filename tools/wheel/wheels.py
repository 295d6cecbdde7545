"""Makes a wheel for each Python out of the plain one of setup.py.

    wheels.py --plain=FOLDER --modules=FOLDER --work=FOLDER --out=FOLDER

The modules are put into the plain wheel, and auditwheel adds the
libraries that they and the program need. What comes out is taken apart again:
each Python gets the wheel with its own module, and any other one a wheel
without a module, whose program runs all the same.
"""

import argparse
import pathlib
import re
import shutil
import subprocess

import licences

# Of the wheel without a module, in place of the package.
NO_MODULE = '''"""This wheel of armcal has no module for this Python."""

raise ImportError("this wheel holds the program armcal alone; the Python module "
                  "is in the wheels for CPython {versions}")
'''


def run(*command):
    done = subprocess.run([str(part) for part in command], text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode != 0:
        raise SystemExit(f"{done.args}:\n{done.stdout}")


def only(folder, pattern):
    found, = folder.glob(pattern)
    return found


def unpacked(wheel, folder):
    shutil.rmtree(folder, ignore_errors=True)
    run("wheel", "unpack", "--dest", folder, wheel)
    return only(folder, "*")


def with_libraries(plain, modules, work):
    """The wheel with all modules and the libraries, unpacked."""
    tree = unpacked(plain, work / "all")
    for module in tree.glob("armcal/_armcal.*.so"):
        module.unlink()
    for module in modules:
        shutil.copy2(module, tree / "armcal")
    run("wheel", "pack", "--dest-dir", work / "all", tree)
    shutil.rmtree(work / "repaired", ignore_errors=True)
    run("auditwheel", "repair", "--strip", "--wheel-dir", work / "repaired",
        only(work / "all", "*.whl"))
    tree = unpacked(only(work / "repaired", "*.whl"), work / "all")
    # auditwheel lists what it added, but no library of Debian's /lib.
    shutil.rmtree(only(tree, "*.dist-info") / "sboms", ignore_errors=True)
    return tree


def write_tags(tree, tag):
    file = only(tree, "*.dist-info") / "WHEEL"
    file.write_text(re.sub("(?m)^Tag: [^-]+-[^-]+", "Tag: " + tag,
                           file.read_text()))


def write_wheel(tree, version, out):
    """Of a version, "311"."""
    for module in tree.glob("armcal/_armcal.*.so"):
        if f".cpython-{version}-" not in module.name:
            module.unlink()
    write_tags(tree, f"cp{version}-cp{version}")
    run("wheel", "pack", "--dest-dir", out, tree)


def write_program_wheel(tree, versions, out):
    shutil.rmtree(tree / "armcal")
    (tree / "armcal").mkdir()
    (tree / "armcal" / "__init__.py").write_text(NO_MODULE.format(
        versions=", ".join(f"{v[0]}.{v[1:]}" for v in versions)))
    metadata = only(tree, "*.dist-info") / "METADATA"
    metadata.write_text(re.sub("(?m)^(Requires-Dist|Provides-Extra): .*\n", "",
                               metadata.read_text()))
    write_tags(tree, "py3-none")
    run("wheel", "pack", "--dest-dir", out, tree)


def main():
    parser = argparse.ArgumentParser()
    for name in ("plain", "modules", "work", "out"):
        parser.add_argument("--" + name, type=pathlib.Path, required=True)
    options = parser.parse_args()
    modules = sorted(options.modules.glob("_armcal.*.so"))
    versions = [re.search(r"\.cpython-(\d+)-", module.name).group(1)
                for module in modules]
    tree = with_libraries(only(options.plain, "*.whl"), modules, options.work)
    licences.write(tree)
    shutil.rmtree(options.out, ignore_errors=True)
    options.out.mkdir(parents=True)
    one = options.work / "one"
    for version in versions + [None]:
        shutil.rmtree(one, ignore_errors=True)
        copy = shutil.copytree(tree, one / tree.name)
        if version:
            write_wheel(copy, version, options.out)
        else:
            write_program_wheel(copy, versions, options.out)
    shutil.rmtree(one)


if __name__ == "__main__":
    main()

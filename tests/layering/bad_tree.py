"""A tree that breaks every rule, and what the rules are to say of it."""

from tree import LAYERS

LONG_FUNCTION = "void F(int a) {\n" + "  a++;\n" * 69 + "}\n"
FLAG = "--" + "bandwidth"
GUIDE = "MATH" + ".md"

FILES = {
    # Rooms and what they include.
    "model/text/a.h": '#include "problems/b.h"\n',
    "model/text/c.h": '#include "a.h"\n',
    "model/dynamics/d.cc": '#include "model/plant/e.h"\n',
    "model/plant/e.h": '#include "problems/b.h"\n',
    "model/effects/arm/f.cc": '#include <Simbody.h>\neffect.name = "spring";\n'
                              'effect.name = "delay";\n',
    "model/effects/drive/g.cc": "Effect Delay() {}\n",
    "model/plant/hidden/g.h": '#include "model/effects/arm/f.cc"\n',
    "calib/verify/h.cc": '#include "model/plant/hidden/g.h"\n',
    "calib/verify/i.cc": '#include "tools/j.h"\n',
    "calib/attic/k.cc": "",
    "tools/j.h": '#include "model/plant/hidden/g.h"\n',
    "tools/commands/simulate.cc": '#include "model/plant/hidden/g.h"\n',
    "problems/p.h": '#include "problems/q.h"\n',
    "problems/p.cc": '#include "problems/p.h"\n#include "problems/b.h"\n',
    "problems/q.cc": '#include "problems/q.h"\n#include "problems/p.h"\n',
    "problems/q.h": '#include "model/text/numbers.inc"\n',
    "model/text/numbers.inc": "// Not \"problems/p.h\", as\n",
    **{f"calib/poses/unit_{k}.cc": "" for k in range(31)},
    **{f"model/dynamics/unit_{k}.cc": "" for k in range(31)},
    # Prints and words.
    "problems/b.h": 'void F() { std::printf("x"); }\n',
    "calib/logs/l.cc": 'void F() { std::cerr << "// no comment"; }\n',
    "calib/logs/m.cc": '// std::cout << 1;\nconst char* kText = "std::cout";\n',
    "tools/n.cc": "void F() { std::cout << 1; }\n",
    "tools/console.cc": "void F() { std::cout << 1; }\n",
    "calib/diagnose/judge/o.cc": 'if (name == "delay") Wait();\n',
    "calib/refine/o.cc": '// "spring"\nconst char* k[] = {"delay", "springs", "spring"};\n',
    "calib/fleet/r.cc": f'Refuse("a higher "  // {FLAG}\n       "{FLAG} than");\n',
    "calib/fleet/s.cc": f"// {FLAG}\nconst int k = '\"'; // {FLAG}\n",
    # Names, paths and sources.
    "tests/misc/m_test.cc": "\n",
    "docs/t.md": "`model/text/a`, model/text/*.h, `calib/${ROOM}/h.cc`, ../model/x.h,\n"
                 "[one](tests/<name>/m_test.cc), a.com/docs/x; `calib/gone.h` is not.\n",
    "calib/linear/u.cc": '// As in model/lost.\nconst char* k = "model/lost";\n',
    "CHANGELOG.md": "calib/gone.h\n",
    "tests/CMakeLists.txt": "add_test(NAME format COMMAND x)\n",
    "tests/calib/linear/q_test.cc": "// lost.h, q_test.cc; lost_test, linear_q_test\n"
                                    "}  // namespace q_test\n",
    "docs/q.md": "`ctest -R 'linear_q|format'`, `ctest -R lost_long`\n",
    "calib/linear/v.h": f"// {GUIDE}, A.1.\n",
    "calib/linear/a.cc": "namespace {\nconstexpr double kFar = 1;\nint H(int a) {\n}\n}  \n"
                         "int G() {\n}\n",
    "calib/fleet/a.cc": "namespace {\nint H(double a) {\n}\nconstexpr int kFar = 2;\n}  \n"
                        "int G() {\n}\n",
    "calib/verify/a.cc": "namespace {\nint H(int b) {\n}\n}  // namespace\n",
    "problems/a.cc": "namespace {\nint H(int b) {\n}\n}  // namespace\n",
    "calib/verify/kinds.h": "namespace armcal {\nstruct Gain {\n};\nclass Own;\n}\n",
    "calib/refine/kinds.h": "namespace armcal {\nclass Gain final : Own {\n};\n}\n",
    "model/simd/kinds.h": "namespace armcal::simd {\nstruct Gain {\n};\n}\n",
    # Sizes.
    "calib/linear/w.h": "\n" * 211,
    "calib/linear/x.h": "\n" * 141,
    "tests/y_test.cc": "\n" * 331,
    "calib/linear/y.cc": "namespace {\nstruct S {\n" + LONG_FUNCTION + "};\n}\n",
    "calib/linear/z.cc": LONG_FUNCTION.replace("  a++;\n", "", 1),
}

# What each rule complains about, in words of its own.
EXPECTED = {
    "sources_lie_in_rooms": ["calib/attic: holds sources"],
    "rooms_include_those_above": [
        "model/text/a.h: includes problems/b.h: model/text may not",
        "model/text/c.h: includes a.h: expected a path",
        "model/dynamics/d.cc: includes model/plant/e.h",
        "model/plant/e.h: includes problems/b.h",
        "calib/verify/h.cc: includes model/plant/hidden/g.h",
        "calib/verify/i.cc: includes tools/j.h",
        "tools/j.h: includes model/plant/hidden/g.h"],
    "only_the_plant_is_simbody": ["model/effects/arm/f.cc: includes Simbody"],
    "files_have_no_cycles": [
        "problems/p: a cycle of files: problems/p -> problems/q -> problems/p"],
    "rooms_are_not_crowded": ["calib/poses: 31 units"],
    "libraries_print_nothing": ["problems/b.h: prints", "calib/logs/l.cc: prints"],
    "commands_print_by_the_console": ["tools/n.cc: prints"],
    "effects_are_named_by_themselves": [
        "model/effects/drive/g.cc: names no effect",
        "calib/diagnose/judge/o.cc: names the effect delay",
        "calib/refine/o.cc: names the effect spring"],
    "libraries_know_no_flags": [f"calib/fleet/r.cc: {FLAG} in a string"],
    "names_say_something": ["tests/misc: the name says nothing"],
    "paths_lead_somewhere": ["docs/t.md: calib/gone.h does not exist",
                             "calib/linear/u.cc: model/lost does not exist"],
    "files_are_there": ["tests/calib/linear/q_test.cc: lost.h does not exist"],
    "tests_are_there": ["tests/calib/linear/q_test.cc: there is no test lost_test",
                        "docs/q.md: ctest -R lost_long finds no test"],
    "sources_share_no_names": [
        "calib/linear/a.cc: kFar is in calib/fleet/a.cc",
        "calib/verify/a.cc: H(int) is in calib/linear/a.cc"],
    "headers_share_no_types": ["calib/verify/kinds.h: Gain is in calib/refine/kinds.h"],
    "sources_are_shipped": [f"calib/linear/v.h: cites {GUIDE}"],
    "files_keep_their_budget": ["calib/linear/w.h: 211 lines",
                                "tests/y_test.cc: 331 lines"],
    "functions_are_short": ["calib/linear/y.cc: line 3: F() has 71 lines"],
}


def write(root):
    for path, text in FILES.items():
        place = root / path
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text, encoding="utf-8")
    assert all((root / layer).is_dir() for layer in LAYERS)

#!/usr/bin/env python3
"""Figures in the texts are those that were measured.

  claims.py [--root=REPOSITORY] [--list]

A comment, which no reader sees, says where the figures before it come from:

  found in 72 of 75 cases<!-- source: blind_face153e one -->

names the key `one` of tests/results/blind_face153e.json (several keys: their numbers one
after the other; none: all of the file; several files: `;` between them). Bars that a test
holds are named by the path of the test instead, in which they have to stand. A comment is
about the last numbers before it, as many as it names, within its paragraph, list item or row
of a table; one that is a paragraph of its own is about all numbers of the block before it.
They have to be the result's, in its order, rounded as they are printed.

Numbers that were not measured are skipped where tests/claims.toml lists them, with the
reason. On the pages that are called `whole` there every number is one or the other. A
result is used by some text, and its command names a test or a script that is there. --list
prints every figure with its source. Python 3.11, no packages.
"""

import argparse
import collections
import math
import pathlib
import re
import subprocess
import sys
import tomllib

import result_files

NUMBER = re.compile(r"(?<![\w.^])[-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?(?![A-Za-z_\d^])")
SOURCE = re.compile(r"<!-- source: ([^>]*?) ?-->")
# What has digits and is no number: dates, hashes of commits, versions.
NAMES = re.compile(r"\b\d{4}-\d\d-\d\d\b|\b(?=\d*[a-f])[0-9a-f]{7,40}\b|"
                   r"\b\d+(?:\.\d+){2,}\b|\[\^?\d+\]")
HIDDEN = re.compile(r"^(```).*?^```$|`[^`\n]*`|(?<=\])\([^)\s]*\)|<!--(?! source:).*?-->|"
                    r"https?://\S+|<[a-z/][^>]*>|&\w+;", re.M | re.S)

Figure = collections.namedtuple("Figure", "at text value")
Claim = collections.namedtuple("Claim", "line text source result fault")


def blank(pattern, text):
    """Without what matches, everything else where it was."""
    return pattern.sub(lambda m: re.sub(r"[^\n]", " ", m[0]), text)


def figures(text, begin, end, excused):
    found = []
    for match in NUMBER.finditer(text, begin, end):
        if not any(a <= match.start() < b for a, b in excused):
            found.append(Figure(match.start(), match[0], float(match[0])))
    return found


def last_digit(text):
    mantissa, _, exponent = text.partition("e")
    return 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))


def is_rounded(figure, value):
    """Whether a text may print a value so."""
    half = .5 * last_digit(figure.text)
    return abs(figure.value - value) <= half * (1 + 1e-6) + 1e-12 * abs(value)


def blocks(text):
    """(begin, end, rows) of paragraphs, list items and tables; a table's rows are
    those of its lines."""
    found, begin, at = [], None, 0
    for line in text.splitlines(keepends=True) + [""]:
        plain = line.strip()
        row = plain.startswith("|")
        starts = re.match(r"\s*(?:[-*] |\d+\. |#)", line) or (
            found and begin is not None and row != found[-1][2])
        if begin is not None and (not plain or starts):
            found[-1][1] = at
            begin = None
        if plain and begin is None:
            begin = at
            found.append([at, len(text), row])
        at += len(line)
    return found


def units(text):
    """(begin, end) of what a comment can be about, with the block before each."""
    before = None
    for begin, end, is_table in blocks(text):
        alone = re.fullmatch(r"(?:\s*<!-- source: [^>]*-->\s*)+", text[begin:end])
        if alone and before:
            yield begin, end, before
            continue
        if is_table:
            at = begin
            for line in text[begin:end].splitlines(keepends=True):
                yield at, at + len(line), None
                at += len(line)
        else:
            yield begin, end, None
        before = begin, end


def values_of(source, results):
    """(numbers, names of results) that a comment names."""
    values, names = [], []
    for part in source.split(";"):
        name, *keys = part.split()
        value = results[name]["values"]
        names.append(name)
        for key in keys or [None]:
            found = value
            for word in key.split(".") if key else []:
                found = found[int(word) if isinstance(found, list) else word]
            values += result_files.numbers(found)
    return values, names


def not_in_file(source, found):
    """Figures that a test does not have as one of its numbers, be it as a share."""
    path = result_files.ROOT / source
    has = path.exists() and {float(x) for x in NUMBER.findall(path.read_text("utf-8"))}
    return [figure.text for figure in found if not has or not any(
        math.isclose(x, figure.value * scale) for x in has for scale in (1, .01))]


class Page:
    def __init__(self, name, text, excuses):
        self.name = name
        self.shown = blank(HIDDEN, text)
        self.bare = blank(NAMES, blank(SOURCE, self.shown))
        self.text = text
        flat = self.bare.replace("\n", " ")
        self.excused, self.used = [], set()
        for pattern in excuses:
            for match in re.finditer(pattern, flat):
                self.excused.append(match.span())
                self.used.add(pattern)

    def line(self, at):
        return self.text.count("\n", 0, at) + 1

    def words(self, begin, end):
        return " ".join(self.bare[begin:end].replace("|", " ").split())

    def held_to_file(self, source, found):
        """A claim that a test has the numbers found."""
        missing = not_in_file(source, found)
        return Claim(self.line(found[0].at), " ".join(x.text for x in found), source, [],
                     missing and f"{source} has no {' '.join(missing)}")

    def claim(self, begin, end, whole, source, results):
        """(claim, figures that it is about) of a comment about a stretch, or, where
        `whole`, about all of it."""
        found = figures(self.bare, begin, end, self.excused)
        if source.startswith("tests/") and found:
            return self.held_to_file(source, found), found
        try:
            values, names = values_of(source, results)
        except (LookupError, ValueError, TypeError) as error:
            return Claim(self.line(begin), self.words(begin, end)[-40:], source, None,
                         f"no such result: {error}"), found
        if values and not whole:
            found = found[-len(values):]
        at, fault = found[0].at if found else begin, None
        if len(found) != len(values):
            fault = f"{source} has {len(values)} numbers, the text {len(found)}"
        for figure, value in zip(found, values):
            if not fault and not is_rounded(figure, value):
                at, fault = figure.at, f"{source} has {value:.6g}, the text {figure.text}"
        return Claim(self.line(at), " ".join(figure.text for figure in found), source, names,
                     fault), found

    def claims(self, results):
        """Every comment with a source, and every figure without one (source None)."""
        covered = set()
        for begin, end, before in units(self.shown):
            at = begin
            for match in SOURCE.finditer(self.shown, begin, end):
                stretch = before if before else (at, match.start())
                claim, found = self.claim(*stretch, bool(before), match[1], results)
                covered.update(figure.at for figure in found)
                yield claim
                at = match.end()
        for figure in figures(self.bare, 0, len(self.bare), self.excused):
            if figure.at not in covered:
                begin = max(self.bare.rfind("\n", 0, figure.at) + 1, figure.at - 40)
                yield Claim(self.line(figure.at), figure.text, None, None,
                            f"{figure.text} has no source: {self.words(begin, figure.at + 40)}")


def command_is_there(root, command):
    """Whether the test or the script that a command names is there."""
    case = re.search(r"(?:^|\s)--gtest_filter='?\*?([A-Za-z]\w*)", command)
    name = re.search(r"\bctest .*-R '?([\w.]+)", command)
    if case or name:
        for path in (root / "tests").rglob("*"):
            if case and path.suffix == ".cc" and re.search(
                    rf"\b(?:TEST\w*|\w*SUITE\w*)\([^)]*{case[1]}", path.read_text()):
                return True
            called = f"{path.parent.name}_{path.stem}"
            if name and path.suffix in (".cc", ".py", ".cmake") and name[1] in called:
                return True
        return False
    files = re.findall(r"(?<![\w/=])(?:tests|tools|docs|examples)/[\w./-]+", command)
    return bool(files) and all((root / file).exists() for file in files)


def wrong_results(root, results, used):
    for name, result in results.items():
        lacks = result_files.KEYS - set(result)
        if lacks:
            yield f"tests/results/{name}.json: lacks {', '.join(sorted(lacks))}"
            continue
        if not re.fullmatch(r"\d{4}-\d\d-\d\d", result["date"]):
            yield f"tests/results/{name}.json: {result['date']} is no date"
        if not re.fullmatch(r"[0-9a-f]{7,40}\+?", result["commit"]):
            yield f"tests/results/{name}.json: {result['commit']} is no commit"
        if not command_is_there(root, result["command"]):
            yield (f"tests/results/{name}.json: there is no test or script as in "
                   f"`{result['command']}`")
        if name not in used:
            yield f"tests/results/{name}.json: no text uses it"


def strange_commits(root, results):
    """Results whose commit the history here does not have; none where there is no history."""
    def git(*words):
        return subprocess.run(["git", "-C", root, *words], capture_output=True, text=True,
                              check=False)
    if git("rev-parse", "--is-shallow-repository").stdout.strip() == "false":
        for name, result in results.items():
            commit = result.get("commit", "").rstrip("+")
            if git("cat-file", "-e", commit + "^{commit}").returncode:
                yield f"note: tests/results/{name}.json: there is no commit {commit} here"


def check_itself():
    """What would let everything pass is noticed."""
    results = {"r": {"values": {"one": [72, 75, 96.04], "two": 3.3e-4, "three": [7]}}}

    def faults(text, *excuses):
        return [c.fault for c in Page("x", text, excuses).claims(results) if c.fault]
    one = "<!-- source: r one -->"
    right = [f"in 72 of 75 (96.0 %){one}", f"| 72 | 75 | 96.0{one} |", "at `72`, 2026-11-20",
             "3e-4 and 7<!-- source: r two three -->", f"a\n72 of 75,\n96 %{one}",
             f"| 72 |\n|---|\n| 75 |\n| 96.04 |\n\n{one}\n", f"72, 75, 96{one} and none"]
    wrong = [f"in 73 of 75 (96.0 %){one}", f"in 72 of 75 (96.1 %){one}", "in 72 of 75",
             f"in 72 of 75{one}", f"in 5, 72 of 75 (96 %){one}", f"| 72 |\n| 75 |\n| 96.04 |\n| 5 |\n\n{one}", "7<!-- source: s one -->",
             f"75 of 72 (96 %){one}", f"| 72 | 75 | 96.0{one} |\n| 3 | |",
             f"| 72 |\n|---|\n| 75 |\n| 96.05 |\n\n{one}\n", f"72, 75, 96{one} and 1"]
    for text in right:
        assert not faults(text), (text, faults(text))
    for text in wrong:
        assert faults(text), text
    assert not faults("95 % intervals", "95 % intervals")


def pages(root):
    for pattern in ("README.md", "CONTRIBUTING.md", "docs/*.md", "docs/effects/*.md",
                    "docs/tutorials/*.md", "tests/*/*.md"):
        yield from sorted(root.glob(pattern))


def check(page, whole, results):
    """(claims, faults, names of results used) of a page."""
    claims = list(page.claims(results))
    faults = [f"{page.name}:{claim.line}: {claim.fault}" for claim in claims
              if claim.fault and (claim.source or whole)]
    return claims, faults, {name for claim in claims for name in claim.result or []}


def show(page, claims, whole, results):
    """A line for each source, and on whole pages for each number that lacks one."""
    for claim in claims:
        first = results[claim.result[0]] if claim.result else {}
        if claim.source or whole:
            print(f"{page.name}:{claim.line} | {claim.text} | {claim.source} | "
                  f"{first.get('date', '')} | {first.get('commit', '')} | "
                  f"{'DIFFERS' if claim.fault else 'same'}")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--root", type=pathlib.Path, default=result_files.ROOT)
    parser.add_argument("--list", action="store_true")
    options = parser.parse_args()
    check_itself()
    given = tomllib.loads((options.root / "tests/claims.toml").read_text(encoding="utf-8"))
    results = result_files.read_all()
    faults, used, excuses, sourced, others = [], set(), set(), 0, 0
    for path in pages(options.root):
        page = Page(str(path.relative_to(options.root)),
                    path.read_text(encoding="utf-8"), given["not_measured"])
        whole = page.name in given["whole"]
        claims, wrong, names = check(page, whole, results)
        faults += wrong
        used |= names
        excuses |= page.used
        sourced += sum(len(claim.text.split()) for claim in claims if claim.source)
        others += sum(not claim.source for claim in claims)
        if options.list:
            show(page, claims, whole, results)
    faults += wrong_results(options.root, results, used)
    faults += [f"tests/claims.toml: '{pattern}' is in no text"
               for pattern in given["not_measured"] if pattern not in excuses]
    print("\n".join(strange_commits(options.root, results)))
    print(f"{sourced} figures are held to {len(results)} results; {others} numbers on pages "
          "that need none have no source")
    print("\n".join(faults), file=sys.stderr)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()

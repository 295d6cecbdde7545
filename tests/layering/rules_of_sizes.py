"""Lines of files and of functions."""

import re

BUDGETS = {"header": 140, "source": 280, "test": 220}
MOST_OF_A_FUNCTION = 70

BRACE = re.compile(r"[{};]")
SCOPE = re.compile(r"\b(?:namespace|class|struct|union|enum|extern)\b")


def _kind(path):
    if path.endswith(".h"):
        return "header"
    return "test" if path.startswith("tests/") else "source"


def files_keep_their_budget(tree):
    """More than half above it is refused, and all above it are listed."""
    for path in tree.code(("model", "problems", "calib", "tools", "tests")):
        kind, lines = _kind(path), tree.text(path).count("\n")
        budget = BUDGETS[kind]
        if lines > budget * 3 // 2:
            yield f"{path}: {lines} lines: a {kind} has {budget}, at most {budget * 3 // 2}"
        elif lines > budget:
            print(f"over budget: {path}: {lines} lines, a {kind} has {budget}")


def functions(code):
    """(first line, lines, heading) of each function's body in code without
    comments, strings and preprocessor lines, outermost ones."""
    scopes, begin, body = [], 0, None
    for match in BRACE.finditer(code):
        at = match.start()
        if match[0] == "{":
            heading = code[begin:at]
            inner = SCOPE.search(heading) and ")" not in heading.split("=")[0]
            scopes.append("scope" if inner else "body")
            if body is None and not inner:
                body = len(scopes), begin + len(heading) - len(heading.lstrip()), heading
        elif match[0] == "}" and scopes:
            if body is not None and len(scopes) == body[0]:
                if "(" in body[2]:
                    first = code.count("\n", 0, body[1]) + 1
                    yield first, code.count("\n", body[1], at) + 1, body[2].strip()
                body = None
            scopes.pop()
        begin = match.end()


def functions_are_short(tree):
    """A function fits a screen, or nearly."""
    for path in tree.code():
        code = re.sub(r"^ *#(?:.*\\\n)*.*$", "", tree.bare(path), flags=re.M)
        for line, lines, heading in functions(code):
            if lines > MOST_OF_A_FUNCTION:
                name = heading.split("(")[0].split()[-1]
                yield (f"{path}: line {line}: {name}() has {lines} lines, at most "
                       f"{MOST_OF_A_FUNCTION}")


RULES = (files_keep_their_budget, functions_are_short)

"""report_browser.py CHROMIUM REPORT.. opens report.html in a real Chromium.

Each page must draw itself to its end without a complaint and without asking
for any address, show names as text, say under the pointer and to the keyboard
what its data hold, and fit on a telephone. Prints what it measured.
"""

import json
import re
import sys

from chromium import Chromium


class Failure(Exception):
    pass


def expect(true, text):
    if not true:
        raise Failure(text)


def page_data(path):
    with open(path, encoding="utf-8") as file:
        text = file.read()
    found = re.search(r'<script type="application/json" id="data">(.*?)</script>',
                      text, re.S)
    return json.loads(found.group(1))


def number(text):
    return float(text.replace("\u2212", "-"))


def names_are_text(browser, data):
    expect(browser.evaluate("document.querySelectorAll("
                            "'img, #page script, b, iframe').length") == 0,
           "a name became an element")
    text = browser.evaluate("document.body.innerText")
    expect(data["robot"][:40] in text, "the robot's name is not shown")
    for trace in data["torques"][:1]:
        for joint in trace["joints"]:
            # White space may be drawn as less of it.
            expect(joint["name"][:30] in text, joint["name"] + " is not shown")


def middle_of_plot(browser, k):
    browser.evaluate(f"document.querySelectorAll('.plot')[{k}]"
                     ".scrollIntoView({block: 'center'})")
    for _ in range(60):
        browser.wait(.05)
        if browser.evaluate(f"document.querySelectorAll('.plot')[{k}]"
                            ".querySelector('canvas') !== null"):
            break
    box = browser.evaluate(
        f"(() => {{ const r = document.querySelectorAll('.plot')[{k}]"
        ".getBoundingClientRect();"
        " return [r.left, r.top, r.width, r.height]; })()")
    return box[0] + .6 * box[2], box[1] + .5 * box[3]


def nearest(times, time):
    known = [k for k, t in enumerate(times) if t is not None]
    return min(known, key=lambda k: abs(times[k] - time))


def first_plot(data):
    """What it draws, and what its first line is called."""
    for trace in data["torques"]:
        return trace, "recorded"
    for trace in data["extra"].get("signals", []):
        return trace["position"], "position"
    return None, None


def hover_says_the_data(browser, trace, label):
    """What dygraphs shows under the pointer is the envelope's middle."""
    joint = trace["joints"][0]
    x, y = middle_of_plot(browser, 0)
    browser.move(x, y)
    browser.wait(.2)
    said = browser.evaluate("document.querySelector('.plot .dygraph-legend')"
                            ".innerText")
    at = re.match(r"([-\u2212\d.e]+) s", said)
    value = re.search(label + r":\s*([-\u2212\d.e]+)", said)
    expect(at and value, "the pointer reads: " + said)
    k = nearest(trace["t"], number(at.group(1)))
    expected = (joint["low"][0][k] + joint["high"][0][k]) / 2
    shown = number(value.group(1))
    expect(abs(shown - expected) <= 1e-3 * abs(expected) + 1e-9,
           f"the pointer reads {said}, the data hold {expected}")


def zoom_takes_all_along(browser, label):
    x, y = middle_of_plot(browser, 0)
    whole = browser.evaluate("plots.all[0].chart.xAxisRange()")
    browser.move(x, y, "mousePressed", button="left", clickCount=1)
    browser.move(x + 40, y, button="left", buttons=1)
    browser.move(x + 80, y, button="left", buttons=1)
    seconds = browser.evaluate("performance.now()")
    browser.move(x + 80, y, "mouseReleased", button="left", clickCount=1)
    seconds = (browser.evaluate("performance.now()") - seconds) / 1e3
    ranges = browser.evaluate(
        "plots.all.filter((p) => p.group === plots.all[0].group && p.chart &&"
        " p.seen).map((p) => p.chart.xAxisRange())")
    expect(ranges[0][1] - ranges[0][0] < .5 * (whole[1] - whole[0]),
           "dragging does not zoom")
    expect(all(r == ranges[0] for r in ranges), "plots show different times")
    browser.evaluate("document.querySelectorAll('.plot')[0].focus()")
    browser.press("Home")
    expect(browser.evaluate("plots.all[0].chart.xAxisRange()") == whole,
           "Home does not show all")
    browser.press("ArrowRight")
    said = browser.evaluate("document.querySelector('.said').textContent")
    expect(label in said, "the arrow keys read: " + said)
    return seconds


def keyboard_reaches_all(browser):
    """Tab goes through every control in the order of the page."""
    wanted = browser.evaluate(
        "[...document.querySelectorAll('button, select, a, [tabindex=\"0\"]')]"
        ".filter((e) => e.offsetParent !== null || e.closest('svg')).length")
    browser.evaluate("document.querySelector('.skip').focus()")
    tops = []
    for _ in range(wanted - 1):
        browser.press("Tab")
        tops.append(browser.evaluate(
            "(() => { const e = document.activeElement;"
            " return e === document.body ? null :"
            " scrollY + e.getBoundingClientRect().top; })()"))
    expect(None not in tops, f"Tab reaches {len(set(tops))} of {wanted}")
    return wanted


def check(browser, path):
    data = page_data(path)
    browser.size(1100, 900)
    ready = browser.open(path)
    names_are_text(browser, data)
    zoomed = None
    trace, label = first_plot(data)
    if trace and trace["t"]:
        hover_says_the_data(browser, trace, label)
        zoomed = zoom_takes_all_along(browser, label)
    controls = keyboard_reaches_all(browser)
    browser.size(380, 800)
    browser.wait(.2)
    width = browser.evaluate("document.documentElement.scrollWidth")
    expect(width <= 380, f"a telephone of 380 pixels must show {width}")
    expect(not browser.complaints(), str(browser.complaints()))
    expect(not browser.requests(), "asks for " + str(browser.requests()))
    print(f"{path}: ready after {ready:.2f} s, {controls} controls"
          + (f", zoom {1e3 * zoomed:.0f} ms" if zoomed is not None else ""))


def main():
    failed = False
    with Chromium(sys.argv[1]) as browser:
        for path in sys.argv[2:]:
            try:
                check(browser, path)
            except (Failure, RuntimeError) as error:
                print(f"{path}: {error}")
                failed = True
    sys.exit(failed)


main()

"""watch_browser.py CHROMIUM ARMCAL LOG opens the page of a running watch.

armcal watch reads a pipe into which the log's rows are written once the page is
open, some ten times as fast as they were recorded. The page must show each joint's residual and limit,
what has changed and what was told, without a complaint and without asking for
any address but its own; and say that the watch has ended when it has. Other
hosts' names are not answered. Prints what it saw.
"""

import re
import subprocess
import sys
import threading
import time
import urllib.error
import urllib.request

from chromium import Chromium


def expect(true, text):
    if not true:
        raise SystemExit(text)


def feed(process, log, begin, go_on):
    begin.wait()
    with open(log, encoding="ascii") as rows:
        for k, row in enumerate(rows):
            process.stdin.write(row)
            if k % 500 == 0:
                process.stdin.flush()
                time.sleep(.1)
    process.stdin.flush()
    go_on.wait()
    process.stdin.close()


def text_of(browser, selector):
    return browser.evaluate(f"document.querySelector('{selector}').innerText")


def wait_for(browser, script, what):
    for _ in range(200):
        if browser.evaluate(f"document.documentElement !== null && ({script})"):
            return
        browser.wait(.1)
    raise SystemExit(f"{what}: not within 20 s; {browser.complaints()}")


def refuses_other_hosts(url):
    request = urllib.request.Request(url + "/state.json",
                                     headers={"Host": "example.com"})
    try:
        urllib.request.urlopen(request, timeout=5)
    except urllib.error.HTTPError as error:
        return error.code == 403
    return False


def look(browser, url, begin):
    browser.call("Page.navigate", url=url)
    wait_for(browser, "document.getElementById('robot') && "
             "document.getElementById('robot').innerText", "the robot's name")
    begin.set()
    wait_for(browser, "document.documentElement.dataset.ready === 'true'", "drawn")
    wait_for(browser, "/payload/.test(document.getElementById('changes').innerText)",
             "the payload")
    joints = text_of(browser, "#joints")
    expect(len(re.findall(r"N m", joints)) == 4, "residual and limit of two joints: " + joints)
    changes = text_of(browser, "#changes")
    expect("payload.mass" in changes and " to " in changes, "an interval: " + changes)
    events = text_of(browser, "#events")
    expect("learned" in events and "payload" in events, "events: " + events)
    drawn = browser.evaluate(
        "[...document.querySelectorAll('canvas')].every(c => c.getContext('2d')"
        ".getImageData(0, 0, c.width, c.height).data.some(x => x > 0))")
    expect(drawn, "a plot is empty")
    for width in (360, 1200):
        browser.size(width, 800)
        browser.wait(.5)
        wide = browser.evaluate("document.documentElement.scrollWidth")
        expect(wide <= width, f"the page is {wide} wide on {width}")
    return changes, events


def main():
    program, armcal, log = sys.argv[1:4]
    process = subprocess.Popen(
        [armcal, "watch", "--robot=arm.yaml", "--calibration=result",
         "--learn=10", "--log=-", "--serve=0", "--quiet"],
        stdin=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    url = re.search(r"http://127\.0\.0\.1:\d+", process.stderr.readline()).group(0)
    begin, go_on = threading.Event(), threading.Event()
    feeder = threading.Thread(target=feed, args=(process, log, begin, go_on))
    feeder.start()
    try:
        expect(refuses_other_hosts(url), "another host's name was answered")
        with Chromium(program) as browser:
            changes, events = look(browser, url, begin)
            foreign = [u for u in browser.requests() if not u.startswith(url + "/")]
            expect(not foreign, f"the page asked for {foreign}")
            expect(not browser.complaints(), str(browser.complaints()))
            go_on.set()
            wait_for(browser, "document.documentElement.dataset.ended === 'true'",
                     "the end")
        print(changes)
        print(events)
    finally:
        begin.set()
        go_on.set()
        feeder.join()
    expect(process.wait() == 1, "exit code 1 expected: something has changed")


if __name__ == "__main__":
    main()

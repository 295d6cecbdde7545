"""Chromium's DevTools protocol over a pipe, with Python's standard library."""

import base64
import json
import os
import select
import shutil
import subprocess
import tempfile
import time


class Chromium:
    """One headless browser with one page; says what that page says and asks."""

    def __init__(self, program):
        self.folder = tempfile.mkdtemp()
        to_browser, self.to = os.pipe()
        self.back, from_browser = os.pipe()
        self.process = subprocess.Popen(
            [program, "--headless", "--no-sandbox", "--disable-gpu",
             "--disable-quic", "--no-first-run", "--disable-sync",
             "--disable-background-networking", "--disable-component-update",
             "--user-data-dir=" + self.folder, "--remote-debugging-pipe"],
            # Chromium reads descriptor 3 and writes 4.
            preexec_fn=lambda: (os.dup2(to_browser, 13), os.dup2(from_browser, 14),
                                os.dup2(13, 3), os.dup2(14, 4)),
            close_fds=False, stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        self.count, self.buffer, self.events = 0, b"", []
        self.session = None
        target = self.call("Target.createTarget", url="about:blank")
        self.session = self.call("Target.attachToTarget", flatten=True,
                                 targetId=target["targetId"])["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(domain + ".enable")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def _message(self, timeout):
        until = time.monotonic() + timeout
        while b"\0" not in self.buffer:
            left = until - time.monotonic()
            if left <= 0 or not select.select([self.back], [], [], left)[0]:
                return None
            piece = os.read(self.back, 1 << 20)
            if not piece:
                raise RuntimeError("chromium has ended")
            self.buffer += piece
        text, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(text)

    def call(self, method, timeout=60, **parameters):
        self.count += 1
        request = {"id": self.count, "method": method, "params": parameters}
        if self.session:
            request["sessionId"] = self.session
        os.write(self.to, json.dumps(request).encode() + b"\0")
        while True:
            message = self._message(timeout)
            if message is None:
                raise RuntimeError(method + ": no answer")
            if message.get("id") == self.count:
                if "error" in message:
                    raise RuntimeError(method + ": " + str(message["error"]))
                return message["result"]
            if "method" in message:
                self.events.append(message)

    def wait(self, seconds):
        until = time.monotonic() + seconds
        while time.monotonic() < until:
            message = self._message(max(0, until - time.monotonic()))
            if message and "method" in message:
                self.events.append(message)

    def open(self, path, timeout=60):
        """Returns the seconds until the page says that it is ready."""
        self.call("Page.navigate", url="about:blank")
        self.events = []
        start = time.monotonic()
        self.call("Page.navigate", url="file://" + os.path.abspath(path))
        while time.monotonic() < start + timeout:
            if self.evaluate("document.documentElement && "
                             "document.documentElement.dataset.ready"):
                return time.monotonic() - start
            if self.complaints():
                break
            self.wait(.05)
        raise RuntimeError(path + " is not drawn to its end: " +
                           str(self.complaints()))

    def evaluate(self, script):
        result = self.call("Runtime.evaluate", expression=script,
                           returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            raise RuntimeError(script + ": " + str(result["exceptionDetails"]))
        return result["result"].get("value")

    def complaints(self):
        """Console errors, exceptions, and everything in the browser's log."""
        said = []
        for event in self.events:
            p = event["params"]
            if event["method"] == "Runtime.exceptionThrown":
                details = p["exceptionDetails"]
                said.append(details.get("exception", {}).get(
                    "description", details["text"]))
            elif event["method"] == "Log.entryAdded":
                said.append(p["entry"]["text"])
            elif (event["method"] == "Runtime.consoleAPICalled"
                  and p["type"] in ("error", "warning", "assert")):
                said.append(str([a.get("value") for a in p["args"]]))
        return said

    def requests(self):
        """Addresses that the page asked for, but for itself."""
        asked = [e["params"]["request"]["url"] for e in self.events
                 if e["method"] == "Network.requestWillBeSent"
                 and e["params"].get("type") != "Document"]
        return [url for url in asked if not url.startswith("data:")]

    def press(self, key, modifiers=0):
        for kind in ("rawKeyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=key, code=key,
                      modifiers=modifiers,
                      windowsVirtualKeyCode=9 if key == "Tab" else 0)

    def move(self, x, y, kind="mouseMoved", **more):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)

    def size(self, width, height):
        self.call("Emulation.setDeviceMetricsOverride", width=width,
                  height=height, deviceScaleFactor=1, mobile=False)

    def picture(self, path, y=0, width=0, height=0):
        clip = {"x": 0, "y": y, "width": width, "height": height, "scale": 1}
        data = self.call("Page.captureScreenshot", format="png",
                         captureBeyondViewport=True,
                         **({"clip": clip} if height else {}))["data"]
        with open(path, "wb") as file:
            file.write(base64.b64decode(data))

    def pdf(self, path):
        data = self.call("Page.printToPDF", printBackground=False,
                         preferCSSPageSize=True)["data"]
        with open(path, "wb") as file:
            file.write(base64.b64decode(data))

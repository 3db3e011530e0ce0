"""A headless Chromium, spoken to over a pipe by its DevTools protocol; needs the standard library and the browser only."""
import base64
import gc
import json
import os
import pathlib
import select
import shutil
import subprocess
import tempfile
import time

NAMES = ("chromium", "chromium-browser", "google-chrome", "chrome")


def find():
    """The browser's path, or None. CHROMIUM names another one."""
    return os.environ.get("CHROMIUM") or next(filter(None, map(shutil.which, NAMES)), None)


ANSWER_SECONDS = 150  # for one command; software rendering of a large page is slow
# Until the page says that it is built; rejects what is no run page, what could not be shown, and what takes longer than `seconds`.
BUILT = """(seconds => new Promise((done, refuse) => {
  const start = Date.now(), failed = () => [...document.querySelectorAll("#runs .bad")].find(e => e.textContent.startsWith("This page could not be shown"));
  const wait = () => {
    if (performance.getEntriesByName("built").length) done();
    else if (document.readyState === "complete" && !document.getElementById("facts0")) refuse("no run page of ribvault");
    else if (failed()) refuse(failed().textContent);
    else if (Date.now() - start > 1000 * seconds) refuse(`not built within ${seconds} s`);
    else setTimeout(wait, 20);
  };
  wait();
}))"""


class PageError(Exception):
    """A script of the page failed, or the browser refused a command."""


class Browser:
    """One page. `console` collects errors and warnings of the console, uncaught exceptions and requests that leave the file."""

    def __init__(self, program, width=1280, height=900, flags=()):
        self.console, self.requests = [], []
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        gc.collect()  # closes what was left open now, not while the child starts
        low = [os.open(os.devnull, os.O_RDWR)]  # so that 3 and 4 are open, and not subprocess's own
        while low[-1] < 8:
            low.append(os.open(os.devnull, os.O_RDWR))
        to_child, self.out = os.pipe()
        self.inn, from_child = os.pipe()

        def descriptors():  # the protocol reads descriptor 3 and writes 4
            taken = [os.dup(to_child), os.dup(from_child)]
            os.dup2(taken[0], 3), os.dup2(taken[1], 4)

        command = [program, "--headless=new", "--remote-debugging-pipe", f"--user-data-dir={self.profile.name}", "--no-sandbox", "--no-first-run",
                   "--disable-background-networking", "--disable-component-update", "--enable-unsafe-swiftshader", "--disable-dev-shm-usage", "--hide-scrollbars", *flags, "about:blank"]
        self.process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, pass_fds=(3, 4, to_child, from_child),
                                        preexec_fn=descriptors, start_new_session=True)
        for descriptor in (to_child, from_child, *low):
            os.close(descriptor)
        self.serial, self.buffer, self.session = 0, b"", None
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Network", "Log"):
            self.call(domain + ".enable")
        self.resize(width, height)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        try:
            self.session = None
            self.call("Browser.close")
        except (PageError, OSError):
            pass
        os.close(self.out), os.close(self.inn)
        try:
            self.process.wait(10)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        self.profile.cleanup()

    def _message(self, until):
        while b"\0" not in self.buffer:
            if not select.select([self.inn], [], [], max(0.0, until - time.monotonic()))[0]:
                raise PageError("the browser does not answer")
            block = os.read(self.inn, 1 << 20)
            if not block:
                raise PageError("the browser ended")
            self.buffer += block
        text, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(text)

    def _event(self, message):
        method, about = message.get("method"), message.get("params", {})
        if method == "Runtime.consoleAPICalled" and about["type"] in ("error", "warning", "assert"):
            self.console.append(" ".join(str(a.get("value", a.get("description"))) for a in about["args"]))
        elif method == "Runtime.exceptionThrown":
            details = about["exceptionDetails"]
            self.console.append(details.get("exception", {}).get("description") or details["text"])
        elif method == "Log.entryAdded" and about["entry"]["level"] in ("error", "warning"):
            self.console.append(about["entry"]["text"])
        elif method == "Network.requestWillBeSent" and not about["request"]["url"].startswith(("data:", "blob:")):
            self.requests.append(about["request"]["url"])

    def call(self, method, **params):
        """One command; its result."""
        until = time.monotonic() + ANSWER_SECONDS
        self.serial += 1
        message = {"id": self.serial, "method": method, "params": params}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.out, json.dumps(message).encode() + b"\0")
        while True:
            answer = self._message(until)
            if answer.get("id") == self.serial:
                if "error" in answer:
                    raise PageError(f"{method}: {answer['error']['message']}")
                return answer["result"]
            self._event(answer)

    def run(self, script):
        """The value of an expression in the page, promises waited for."""
        answer = self.call("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in answer:
            thrown = answer["exceptionDetails"].get("exception", {})
            raise PageError(thrown.get("description") or thrown.get("value") or script)
        return answer["result"].get("value")

    def open(self, file, fragment="", seconds=120):
        """Opens a file and waits until the page says that it is built; PageError when it does not within `seconds`, or is no run page."""
        self.console.clear(), self.requests.clear()
        self.call("Page.navigate", url="about:blank")
        answer = self.call("Page.navigate", url=pathlib.Path(file).resolve().as_uri() + fragment)
        try:
            if "errorText" in answer:
                raise PageError(answer["errorText"])
            self.run(f"{BUILT}({seconds})")
        except PageError as error:
            raise PageError(f"{file}: {error}") from None

    def resize(self, width, height, mobile=False, scale=1):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=scale, mobile=mobile)

    def dark(self, on):
        self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark" if on else "light"}])

    def key(self, name, text="", modifiers=0):
        codes = {"ArrowLeft": 37, "ArrowUp": 38, "ArrowRight": 39, "ArrowDown": 40, "Home": 36, "End": 35, "PageUp": 33, "PageDown": 34, " ": 32}
        code = codes.get(name, ord(name[0].upper()))
        about = {"key": name, "windowsVirtualKeyCode": code, "modifiers": modifiers}
        self.call("Input.dispatchKeyEvent", type="keyDown", **about, **({"text": text} if text else {}))
        self.call("Input.dispatchKeyEvent", type="keyUp", **about)

    def settle(self):
        """Waits until what was asked for is painted, and the model in 3D is at rest."""
        self.run("""new Promise(done => { const wait = () => page.models.some(m => m.moving) ? setTimeout(wait, 20)
          : requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 30))); wait(); })""")

    def screenshot(self, file):
        self.settle()
        pathlib.Path(file).write_bytes(base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"]))

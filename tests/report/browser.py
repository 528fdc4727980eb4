"""Headless Chromium over its debugging pipe: no driver, no port, the standard library alone."""
import base64
import json
import os
import select
import shutil
import subprocess
import tempfile
import time

FLAGS = ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars", "--no-first-run",
         "--disable-background-networking", "--disable-component-update", "--remote-debugging-pipe"]
NAMES = ["chromium", "chromium-browser", "google-chrome"]
PATIENCE = 60.0
KEYS = {"Tab": 9, "Enter": 13, "End": 35, "Home": 36, "ArrowLeft": 37, "ArrowUp": 38, "ArrowRight": 39, "ArrowDown": 40, "Insert": 45, "Delete": 46}


def find():
    """The browser; Debian's is installed if there is none."""
    found = next((path for name in NAMES if (path := shutil.which(name))), None)
    if found is None:
        for command in (["apt-get", "update", "-qq"], ["apt-get", "install", "-y", "-qq", "--no-install-recommends", "chromium"]):
            subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        found = shutil.which("chromium")
    return found


class Browser:
    """A browser with one page."""

    def __init__(self):
        child_in, self.into = os.pipe()
        self.out, child_out = os.pipe()
        self.profile = tempfile.mkdtemp(prefix="report_check_")

        def wire():
            os.dup2(child_in, 103)
            os.dup2(child_out, 104)
            os.dup2(103, 3)
            os.dup2(104, 4)

        self.process = subprocess.Popen([find(), *FLAGS, f"--user-data-dir={self.profile}", "about:blank"], preexec_fn=wire,
                                        close_fds=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(child_in)
        os.close(child_out)
        self.buffer, self.next, self.events = b"", 0, []
        self.session = None
        self.session = self.tab()

    def tab(self):
        """A new tab: its session, in which `session` puts the calls."""
        before, self.session = self.session, None
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        self.call("Page.bringToFront")
        for domain in ("Page", "Runtime", "Network", "Log"):
            self.call(f"{domain}.enable")
        made, self.session = self.session, before
        return made

    def call(self, method, **params):
        """Call a method of the protocol and wait for its result."""
        self.next += 1
        message = {"id": self.next, "method": method, "params": params}
        if getattr(self, "session", None):
            message["sessionId"] = self.session
        os.write(self.into, json.dumps(message).encode() + b"\0")
        while True:
            answer = self.read(PATIENCE)
            if answer is None:
                raise SystemExit(f"{method}: no answer from the browser")
            if answer.get("id") == self.next:
                if "error" in answer:
                    raise SystemExit(f"{method}: {answer['error']}")
                return answer["result"]
            self.events.append(answer)

    def read(self, patience):
        """The next message, or None."""
        while b"\0" not in self.buffer:
            if not select.select([self.out], [], [], patience)[0]:
                return None
            more = os.read(self.out, 1 << 20)
            if not more:
                return None
            self.buffer += more
        message, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(message)

    def open(self, path, width, height=900, dark=False, mobile=False):
        """Load a file, or an address, at a width; events before are forgotten."""
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=2 if mobile else 1, mobile=mobile)
        scheme = [{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}]
        self.call("Emulation.setEmulatedMedia", media="", features=scheme)
        self.events = []
        self.call("Page.navigate", url=path if isinstance(path, str) else path.resolve().as_uri())
        if not self.wait("document.readyState === 'complete'"):
            raise SystemExit(f"{path}: not loaded within {PATIENCE:.0f} s")

    def value(self, expression):
        """The value of an expression on the page."""
        result = self.call("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)
        return result["result"].get("value")

    def wait(self, expression, patience=PATIENCE):
        """Wait until an expression is true."""
        end = time.time() + patience
        while not self.value(expression):
            if time.time() > end:
                return False
            time.sleep(0.05)
        return True

    def press(self, key, code=None, text=None, modifiers=0):
        """Press a key and release it."""
        of_key = {"key": key, "code": code or key, "modifiers": modifiers, **({"text": text} if text else {})}
        of_key["windowsVirtualKeyCode"] = KEYS.get(key, ord(key.upper()) if len(key) == 1 else 0)
        self.call("Input.dispatchKeyEvent", type="keyDown", **of_key)
        self.call("Input.dispatchKeyEvent", type="keyUp", **of_key)

    def write(self, text):
        """Type a text into the active element."""
        self.call("Input.insertText", text=text)

    def mouse(self, kind, x, y, **more):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)

    def screenshot(self, path):
        """The whole page as PNG."""
        size = self.call("Page.getLayoutMetrics")["cssContentSize"]
        clip = {"x": 0, "y": 0, "width": size["width"], "height": size["height"], "scale": 1}
        image = self.call("Page.captureScreenshot", format="png", captureBeyondViewport=True, clip=clip)
        path.write_bytes(base64.b64decode(image["data"]))

    def pdf(self, path):
        """The page as it prints."""
        printed = self.call("Page.printToPDF", preferCSSPageSize=True, printBackground=False)
        path.write_bytes(base64.b64decode(printed["data"]))

    def complaints(self, own="file:"):
        """Errors of scripts, and requests that leave the page; addresses that begin with `own` are its own."""
        found = []
        for event in self.events:
            params, method = event.get("params", {}), event.get("method")
            if method == "Runtime.exceptionThrown":
                found.append(params["exceptionDetails"].get("exception", {}).get("description", "an exception"))
            elif method == "Runtime.consoleAPICalled" and params["type"] in ("error", "warning"):
                found.append(f"console: {params['args']}")
            elif method == "Log.entryAdded" and params["entry"]["level"] == "error":
                found.append(params["entry"]["text"])
            elif method == "Network.requestWillBeSent" and not params["request"]["url"].startswith((own, "data:", "blob:")):
                found.append(f"the page asks for {params['request']['url']}")
        return found

    def close(self):
        self.process.terminate()
        self.process.wait(10)
        shutil.rmtree(self.profile, ignore_errors=True)

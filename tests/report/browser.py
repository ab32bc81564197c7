"""A page in headless Chromium, as a reader sees it: opened from disk, without a network, at a given width."""
import json
import pathlib
import time
from typing import Any

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common import utils

PATIENCE_S = 600
SCHEMES_OF_THE_PAGE = ("file:", "data:", "blob:")
ADDRESS = "127.0.0.1"


class ServiceByAddress(Service):
    """Uses an address, because Selenium looks for its driver at localhost, a name that a container may not know."""

    @property
    def service_url(self) -> str:
        return f"http://{utils.join_host_port(ADDRESS, self.port)}"

    def is_connectable(self) -> bool:
        return utils.is_connectable(self.port, ADDRESS)


class Browser:
    """One browser window. Its renderer's threads draw 3D scenes without a GPU."""

    def __init__(self) -> None:
        options = Options()
        options.binary_location = "/usr/bin/chromium"
        # No sandbox, because the user is root in containers. A pipe, because the driver would look for the browser at localhost.
        for argument in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--hide-scrollbars",
                         "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-background-networking", "--disable-extensions",
                         "--disable-component-update", "--no-first-run", "--remote-debugging-pipe", "--force-color-profile=srgb"):
            options.add_argument(argument)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        self.driver = webdriver.Chrome(service=ServiceByAddress("/usr/bin/chromedriver"), options=options)
        self.driver.execute_cdp_cmd("Network.enable", {})
        self.driver.execute_cdp_cmd("Network.emulateNetworkConditions",
                                    {"offline": True, "latency": 0, "downloadThroughput": 0, "uploadThroughput": 0})
        self.resize(1280)

    def close(self) -> None:
        self.driver.quit()

    def resize(self, width: int, height: int = 900) -> None:
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                    {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})

    def open(self, page: pathlib.Path, fragment: str = "") -> None:
        self.driver.get("about:blank")  # changing only the fragment would not reload the page
        self.driver.get(page.resolve().as_uri() + fragment)
        self.wait_for("document.body.classList.contains('ready')")

    def go(self, fragment: str) -> None:
        self.run("location.hash = arguments[0]", fragment)
        self.wait_for("[null, false].includes(document.getElementById(arguments[0])?.hidden ?? null)", fragment.lstrip("#"))

    def click(self, x: float, y: float) -> None:
        """Clicks like a user: moves the mouse, waits, and presses."""
        for kind, more in (("mouseMoved", {}), ("mousePressed", {"button": "left", "clickCount": 1}),
                           ("mouseReleased", {"button": "left", "clickCount": 1})):
            self.driver.execute_cdp_cmd("Input.dispatchMouseEvent", {"type": kind, "x": x, "y": y} | more)
            time.sleep(0.2)

    def run(self, script: str, *arguments: Any) -> Any:
        return self.driver.execute_script(script, *arguments)

    def wait_for(self, condition: str, *arguments: Any) -> None:
        end = time.monotonic() + PATIENCE_S
        while not self.run(f"return Boolean({condition})", *arguments):
            if time.monotonic() > end:
                raise AssertionError(f"not so within {PATIENCE_S} s: {condition} {arguments}")
            time.sleep(0.05)

    def all_drawn(self) -> None:
        """Scrolls to every chart and scene of the visible part, and waits until it is drawn."""
        here = "document.querySelectorAll('section:not([hidden]) .drawing, section:not([hidden]) canvas[role=img]')"
        for place in range(self.run(f"return {here}.length")):
            self.run(f"{here}[arguments[0]].scrollIntoView({{block: 'center'}})", place)
            self.wait_for(f"{here}[arguments[0]].classList.contains('drawn')", place)
        self.run("scrollTo(0, 0)")

    def complaints(self) -> list[str]:
        """Returns console messages since the last call, except a driver's remarks on its speed without a GPU."""
        said = [entry["message"] for entry in self.driver.get_log("browser")]
        return [message for message in said if "GPU stall due to ReadPixels" not in message]

    def requests(self) -> list[str]:
        """Returns the network requests since the last call, except for the page itself and its contents."""
        messages = (json.loads(entry["message"])["message"] for entry in self.driver.get_log("performance"))
        urls = [message["params"]["request"]["url"] for message in messages if message["method"] == "Network.requestWillBeSent"]
        return [url for url in urls if not url.startswith(SCHEMES_OF_THE_PAGE)]

"""The page in a real browser: Debian's Chromium, over its DevTools protocol."""

import functools
import http.server
import json
import os
import pathlib
import socket
import subprocess
import threading

import pytest
from playwright.sync_api import sync_playwright

CHECKOUT = pathlib.Path(__file__).resolve().parents[3]
PROGRAM = pathlib.Path(os.environ.get("MOTION_RTL", CHECKOUT / "target/release/motion-rtl"))
WASM = pathlib.Path(
    os.environ.get(
        "MOTION_RTL_WASM", CHECKOUT / "target/wasm32-wasip1/release/motion-rtl.wasm"
    )
)


def program(*words, code=0, cwd=CHECKOUT):
    """Runs the program; returns what it printed."""
    done = subprocess.run([PROGRAM, *words], cwd=cwd, capture_output=True, text=True, check=False)
    assert done.returncode == code, done.stderr
    return done.stdout


needs_wasm = pytest.mark.skipif(not WASM.exists(), reason="bindings/web/build was not run")


@pytest.fixture(scope="session")
def page_files(tmp_path_factory):
    """Directory of the page as files, with the program inside or beside it."""
    out = tmp_path_factory.mktemp("page")
    program("page", WASM, "--out", out)
    return out


class Quiet(http.server.SimpleHTTPRequestHandler):
    """Serves files and logs nothing."""

    extensions_map = http.server.SimpleHTTPRequestHandler.extensions_map | {".wasm": "application/wasm"}

    def log_message(self, *_):
        pass


def free_port():
    """A port on which nobody listens."""
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        return found.getsockname()[1]


@pytest.fixture(scope="session", params=["served", pytest.param("browser", marks=needs_wasm)])
def address(request):
    """Address of the page: as the program serves it, and as files on a server."""
    if request.param == "served":
        words = [PROGRAM, "serve", "--port", str(free_port())]
        with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as server:
            try:
                yield server.stdout.readline().strip()
            finally:
                server.terminate()
        return
    handler = functools.partial(Quiet, directory=request.getfixturevalue("page_files"))
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}/index.html"
        server.shutdown()


@pytest.fixture(scope="session")
def browser():
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path="/usr/bin/chromium", args=["--no-sandbox", "--enable-precise-memory-info"]
        )
        yield browser
        browser.close()


@pytest.fixture
def page(browser):
    """A page without a document; the test fails if anything is said on its console."""
    context = browser.new_context(viewport={"width": 1400, "height": 900}, accept_downloads=True)
    page = context.new_page()
    page.set_default_timeout(120_000)
    said = []
    page.on("console", lambda message: said.append(f"{message.type}: {message.text}"))
    page.on("pageerror", lambda error: said.append(f"error: {error}"))
    yield page
    context.close()
    assert said == []


@pytest.fixture
def opened(page, address):
    """The page after its first run."""
    page.goto(address)
    ended(page)
    return page


def ended(page, seconds=120):
    """Waits for the end of a run; returns what the status says."""
    status = page.locator(".status")
    page.wait_for_function(
        "() => /exit code|Cancelled|rror/.test(document.querySelector('.status').textContent)",
        timeout=1000 * seconds,
    )
    return status.inner_text()


def summary(page):
    """The JSON of the last run, as the page saves it."""
    page.locator(".files details").evaluate("node => { node.open = true }")
    text = page.evaluate(
        "async () => (await fetch(document.querySelector('a[download=\"summary.json\"]').href)).text()"
    )
    return json.loads(text)

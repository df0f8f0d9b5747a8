"""Writes a picture of the page as the program serves it, after its first run: picture.py FILE."""

import subprocess
import sys

from conftest import PROGRAM, ended, free_port
from playwright.sync_api import sync_playwright


def main():
    words = [PROGRAM, "serve", "--port", str(free_port())]
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as server, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path="/usr/bin/chromium", args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 1280, "height": 760})
        page.goto(server.stdout.readline().strip())
        ended(page)
        # The time of the run differs from run to run.
        page.locator(".status").evaluate("node => { node.textContent = 'motion-rtl run waves/bracket.toml: exit code 0' }")
        page.screenshot(path=sys.argv[1])
        browser.close()
        server.terminate()


if __name__ == "__main__":
    main()

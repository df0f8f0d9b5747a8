"""Time of a frame while the page pans and zooms over a million points and changes.

Chromium runs without its limit of frames, so that the time from frame to frame is that of the work.
Prints median, 95th percentile and greatest time in ms, a row for each drawing.
"""

import argparse
import pathlib
import tempfile

from conftest import program
from playwright.sync_api import sync_playwright

# A window filled by strokes, and one filled by points in no order.
PATHS = {
    "path, strokes": "(k) => [k / 5000, 100 * Math.abs(k / 250 % 2 - 1)]",
    "path, random": "(k) => [200 * Math.abs(Math.sin(k * k)), 100 * Math.abs(Math.sin(1.7 * k * k))]",
    "path, rosette": "(k) => [90 * Math.cos(k / 700) * Math.sin(k / 1e5), 90 * Math.sin(k / 500)]",
}

SHOW_PATH = """
async (point) => {
  const at = eval(point);
  const lines = ["tick,time_s,x_commanded_mm,x_actual_mm,x_error_mm,y_commanded_mm,y_actual_mm,y_error_mm"];
  for (let k = 0; k < 1e6; k += 1) {
    const [x, y] = at(k).map((value) => value.toFixed(4));
    lines.push(`${k},${k / 1e6},${x},${x},0,${y},${y},0`);
  }
  const csv = new TextEncoder().encode(lines.join("\\n"));
  const page = window.motionRtl;
  await page.show({ code: 0, out: '{"clock_hz": 1e6, "ticks": 1000000, "input": "a path"}', errors: "", files: new Map([["path.csv", csv]]) });
  page.tabs.open("Path");
}
"""

SHOW_WAVES = """
async () => {
  const lines = ["$timescale 1 ns $end", "$scope module top $end"];
  const names = Array.from({ length: 12 }, (_, k) => `${k % 3 === 0 ? "bit" : "word"}${k}`);
  names.forEach((name, k) => lines.push(`$var wire ${k % 3 === 0 ? 1 : 16} ${"abcdefghijkl"[k]} ${name} $end`));
  lines.push("$upscope $end", "$enddefinitions $end");
  for (let time = 0; time < 1e6; time += 1) {
    const k = time % 12;
    const value = (time * 40503 >> 4) & 0xffff;
    lines.push(`#${time}`, `${time % 2}a`, `b${value.toString(2)} b`);
    if (k > 1) lines.push(k % 3 === 0 ? `${value & 1}${"abcdefghijkl"[k]}` : `b${value.toString(2)} ${"abcdefghijkl"[k]}`);
  }
  const vcd = new TextEncoder().encode(lines.join("\\n"));
  await window.motionRtl.counterexample({ code: 0, out: "", errors: "", files: new Map([["waves.vcd", vcd]]) });
}
"""

# Pans to and fro and zooms in and out by the wheel for some seconds.
MOVE = """
([selector, seconds]) => new Promise((resolve) => {
  const canvas = [...document.querySelectorAll(selector)].at(-1);
  const box = canvas.getBoundingClientRect();
  const [clientX, clientY] = [box.left + 0.4 * box.width, box.top + 0.6 * box.height];
  const spans = [];
  let [count, before] = [0, performance.now()];
  const end = before + 1000 * seconds;
  const frame = () => {
    const now = performance.now();
    spans.push(now - before);
    before = now;
    if (now > end) return resolve(spans.slice(1));
    const turn = Math.floor(count / 60) % 4;
    const deltas = [{ deltaY: -6 }, { deltaX: 9, shiftKey: true }, { deltaY: 6 }, { deltaX: -9, shiftKey: true }];
    canvas.dispatchEvent(new WheelEvent("wheel", { clientX, clientY, bubbles: true, cancelable: true, ...deltas[turn] }));
    if (turn % 2) canvas.dispatchEvent(new KeyboardEvent("keydown", { key: turn === 1 ? "a" : "d", bubbles: true }));
    count += 1;
    requestAnimationFrame(frame);
  };
  requestAnimationFrame(frame);
})
"""


def figures(spans):
    spans = sorted(spans)
    at = lambda part: spans[min(len(spans) - 1, int(part * len(spans)))]
    return f"{at(0.5):8.1f} {at(0.95):8.1f} {spans[-1]:8.1f} {len(spans):8d}"


def measure(page, seconds, wanted):
    print(f"{'':16} {'median':>8} {'95 %':>8} {'greatest':>8} {'frames':>8}")
    for name, point in PATHS.items():
        if wanted not in name:
            continue
        page.evaluate(SHOW_PATH, point)
        page.wait_for_timeout(3000)
        print(f"{name:16} {figures(page.evaluate(MOVE, ['.path-canvas', seconds]))}", flush=True)
    if wanted not in "waves":
        return
    page.evaluate(SHOW_WAVES)
    page.wait_for_timeout(3000)
    print(f"{'waves':16} {figures(page.evaluate(MOVE, ['.waves-view canvas', seconds]))}")


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--seconds", type=float, default=4, help="time of each drawing")
    arguments.add_argument("--page", help="file with a page of a run; made anew by default")
    arguments.add_argument("--only", default="", help="part of the names of the drawings")
    given = arguments.parse_args()
    with tempfile.TemporaryDirectory() as out, sync_playwright() as playwright:
        report = pathlib.Path(given.page or f"{out}/circle.html").absolute()
        if not report.exists():
            program("run", "waves/circle.toml", "--out", out, "--html", report)
        browser = playwright.chromium.launch(
            executable_path="/usr/bin/chromium",
            args=["--no-sandbox", "--disable-frame-rate-limit", "--disable-gpu-vsync"],
        )
        page = browser.new_page(viewport={"width": 1400, "height": 900})
        page.goto(report.as_uri())
        measure(page, given.seconds, given.only)
        browser.close()


if __name__ == "__main__":
    main()

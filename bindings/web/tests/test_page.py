"""What a reader does with the page, and that it shows what the program prints and writes."""

import contextlib
import functools
import json
import os
import pathlib
import re
import signal
import subprocess
import tempfile
import time
import urllib.error
import urllib.parse
import urllib.request

import pytest
from axe_playwright_python.sync_playwright import Axe
from conftest import CHECKOUT, PROGRAM, WASM, ended, free_port, needs_wasm, program, summary

SCENARIOS = [scenario["file"] for scenario in json.loads(program("list", "--json"))["scenarios"]]


def compared(found):
    """A summary without what depends on where files are written."""
    return {key: value for key, value in found.items() if key not in ("files", "vcd_window")}


def close(value):
    """A value that equals another one of which numbers differ in their last digits: browsers have other sines."""
    if isinstance(value, dict):
        return {key: close(item) for key, item in value.items()}
    if isinstance(value, list):
        return [close(item) for item in value]
    return pytest.approx(value, rel=1e-9, abs=1e-9) if isinstance(value, float) else value


def is_served(address):
    """True if the program itself runs the jobs of this page."""
    return not address.endswith("index.html")


@functools.cache
def summary_of(scenario):
    """The program's summary of a shipped scenario."""
    with tempfile.TemporaryDirectory() as out:
        return compared(json.loads(program("run", scenario, "--json", "--no-vcd", "--out", out)))


@pytest.mark.parametrize("scenario", SCENARIOS)
def test_every_shipped_scenario_has_the_summary_of_the_program(page, address, scenario):
    page.goto(f"{address}#run={scenario}")
    assert "exit code 0" in ended(page, 400)
    expected = summary_of(scenario)
    assert compared(summary(page)) == (expected if is_served(address) else close(expected))


def test_the_first_run_is_there_soon(page, address):
    limit = 3000
    times = []
    # Others use the machine, too: the least of three loads counts.
    for _ in range(3):
        page.goto("about:blank")
        page.goto(address)
        paint = page.evaluate(
            """() => new Promise(resolve => new PerformanceObserver((list) =>
                resolve(list.getEntries()[0].startTime)).observe({type: "paint", buffered: true}))"""
        )
        ended(page)
        times.append((page.evaluate("performance.now()"), paint))
        if times[-1][0] < limit and paint < 1000:
            return
    raise AssertionError(f"run and paint in ms: {times}")


def test_a_run_fits_into_the_memory(browser, opened):
    session = browser.new_browser_cdp_session()
    processes = session.send("SystemInfo.getProcessInfo")["processInfo"]
    session.detach()
    # Shared pages count in part. The page has one of these processes, with its workers.
    used = [memory(process["id"]) for process in processes if process["type"] == "renderer"]
    assert max(used) < 300e6


def memory(pid):
    """Memory of a process in bytes; what it shares with others counts in part."""
    rows = pathlib.Path(f"/proc/{pid}/smaps_rollup").read_text().splitlines()
    return next(1024 * int(row.split()[1]) for row in rows if row.startswith("Pss:"))


REACHABLE = """
() => [...document.querySelectorAll("a[href], button, input, select, textarea, summary, [tabindex='0']")]
  .filter((node) => node.checkVisibility({ visibilityProperty: true }) && !node.disabled)
  .filter((node) => {
    node.scrollIntoView({ block: "center", inline: "center" });
    const box = node.getBoundingClientRect();
    // A region may be higher than the window.
    const [right, down] = [box.left + Math.min(box.width / 2, 20), Math.max(0, box.top) + Math.min(box.height / 2, 20)];
    const hit = document.elementFromPoint(right, down);
    return box.width === 0 || box.left < -1 || !hit || !(node.contains(hit) || hit.contains(node));
  })
  .map((node) => `${node.outerHTML.slice(0, 120)}`)
"""


@pytest.mark.parametrize("pane", ["Path", "Waves", "Circuit", "Try a law", "Summary"])
def test_a_narrow_window_is_not_scrolled_sideways(opened, pane):
    opened.set_viewport_size({"width": 400, "height": 800})
    opened.get_by_role("tab", name=pane).click()
    opened.locator("details:not(.waves-keys)").evaluate_all("nodes => nodes.forEach((node) => { node.open = true })")
    opened.wait_for_timeout(300)
    assert opened.evaluate("document.documentElement.scrollWidth") <= 400
    assert opened.evaluate(REACHABLE) == []
    assert opened.evaluate("document.documentElement.scrollLeft") == 0


@needs_wasm
def test_a_file_opened_without_a_server(page, page_files):
    page.goto((page_files / "motion-rtl.html").as_uri())
    assert "exit code 0" in ended(page)
    assert summary(page)["circuit"] == "pulse_interpolator"
    # The quick build is large.
    if WASM.parent.name == "release":
        assert (page_files / "motion-rtl.html").stat().st_size <= 6e6
    assert page.evaluate("async () => (await window.motionRtl.notes.texts()).size") > 120


def test_a_drawing_of_the_reader(opened, tmp_path):
    drawing = CHECKOUT / "waves/rosette.hpgl"
    own = tmp_path / "mine.hpgl"
    own.write_bytes(drawing.read_bytes())
    opened.set_input_files("#file", own)
    opened.wait_for_function("() => document.querySelector('.status').textContent.includes('mine.hpgl')")
    assert "exit code 0" in ended(opened)
    words = ["run", own, "--set", "circuit=pulse_interpolator", "--json", "--no-vcd", "--out", tmp_path]
    expected = compared(json.loads(program(*words)))
    assert compared(summary(opened)) | {"input": 0} == expected | {"input": 0}


def test_a_bad_file_is_shown_with_line_and_caret(opened, tmp_path):
    own = tmp_path / "bad.ngc"
    own.write_text("G21 G90\nG1 X10 F600\nG1 X1O\n")
    opened.set_input_files("#file", own)
    opened.wait_for_selector(".problem pre")
    text = opened.locator(".problem").inner_text()
    assert "bad.ngc:3" in text and "^" in text


def test_a_run_is_cancelled(opened):
    assert opened.locator(".outdated").count() == 0
    opened.select_option("#scenario", "waves/feed.toml")
    opened.get_by_role("button", name="Cancel").first.click()
    opened.wait_for_function("() => document.querySelector('.status').textContent === 'Cancelled.'")
    # What is seen is of the run before, and its files are not those of this one.
    assert opened.locator(".outdated").count() == 4
    assert opened.locator(".files a").count() == 0


def test_a_position_log_runs_on_the_circuit_that_takes_it(opened, tmp_path):
    log = tmp_path / "log.csv"
    log.write_text("time_s,position_deg\n" + "".join(f"{k / 100},{k * k / 500}\n" for k in range(100)))
    opened.set_input_files("#file", log)
    opened.wait_for_function("() => /log.csv|position/.test(document.querySelector('.status').textContent + document.querySelector('.problem').textContent)")
    assert opened.locator("#on").input_value() == "lead_angle"
    assert "#" not in opened.url


def test_a_setting_is_refused_at_its_field(opened):
    opened.evaluate("location.hash = 'run=waves/bracket.toml&set=clock_hz=0'")
    opened.wait_for_selector(".problem pre")
    assert "clock_hz" in opened.locator(".problem").inner_text()


def changed(page, key, value):
    """Changes a setting as a reader does."""
    page.locator("details.more").evaluate("node => { node.open = true }")
    control = page.locator(f"#setting-{key}")
    control.wait_for()
    if control.evaluate("node => node.tagName") == "SELECT":
        control.select_option(value)
    else:
        control.fill(value)


def test_another_circuit_has_its_own_settings(opened):
    changed(opened, "clock_hz", "2000000")
    changed(opened, "circuit", "arc_generator")
    keys = json.loads(program("keys", "arc_generator", "--json"))["scenario"]
    own = next(row["key"] for row in keys if row["key"].startswith("mechanism.") and row["kind"] == "number")
    opened.wait_for_selector(f"#setting-{own.replace('.', '-')}", state="attached")
    assert opened.locator("#setting-circuit").input_value() == "arc_generator"
    assert opened.locator("#setting-clock_hz").input_value() == "2000000"
    opened.get_by_role("button", name="Run", exact=True).click()
    opened.wait_for_function("() => /circuit=.?arc_generator/.test(document.querySelector('.status').textContent)")


def test_tables_of_a_scenario_are_found_after_they_were_edited(page, address, tmp_path):
    page.goto(f"{address}#run=waves/patterns.toml")
    ended(page)
    tables = page.locator("#setting-pattern")
    tables.wait_for(state="attached")
    edited = tables.input_value().replace('"3/2"', '"2"')
    assert '"waves/ring.csv"' in edited and '"2"' in edited
    changed(page, "pattern", edited)
    page.get_by_role("button", name="Run", exact=True).click()
    page.wait_for_function("() => document.querySelector('.status').textContent.includes('pattern')")
    assert "exit code 0" in ended(page)
    change = "pattern=" + edited.replace("\n", " ")
    expected = json.loads(program("run", "waves/patterns.toml", "--set", change, "--json", "--no-vcd", "--out", tmp_path))
    assert compared(summary(page)) == compared(expected)


def test_a_scenario_with_the_file_that_it_names(opened, tmp_path):
    scenario, table = tmp_path / "mine.toml", tmp_path / "ring.csv"
    text = (CHECKOUT / "waves/patterns.toml").read_text()
    scenario.write_text(text.replace('"stroke.csv"', '"ring.csv"'))
    table.write_bytes((CHECKOUT / "waves/ring.csv").read_bytes())
    opened.set_input_files("#file", [table, scenario])
    opened.wait_for_function("() => document.querySelector('.status').textContent.includes('mine.toml')")
    assert "exit code 0" in ended(opened)
    expected = json.loads(program("run", scenario.name, "--json", "--no-vcd", "--out", "out", cwd=tmp_path))
    assert compared(summary(opened)) == compared(expected)


def test_a_value_at_the_play_head_is_that_of_the_vcd(opened, tmp_path):
    program("run", "waves/bracket.toml", "--to", "2000", "--out", tmp_path)
    opened.get_by_role("tab", name="Circuit").click()
    opened.wait_for_selector(".diagram")
    values = last_values(tmp_path / "bracket.vcd", 1500)
    opened.evaluate("window.motionRtl.playhead.set(1500, null)")
    opened.wait_for_function("() => document.querySelector('td.value').textContent !== ''")
    rows = opened.locator(".pane-circuit tr:has(td.value)")
    seen = 0
    for row in rows.all():
        name = row.locator("th").inner_text()
        value = row.locator("td.value").inner_text()
        expected = values.get(f"pulse_interpolator.{name}")
        if expected is not None and re.fullmatch("[01]", value):
            assert value == expected, name
            seen += 1
    assert seen >= 5


def last_values(path, tick):
    """Values of one-bit signals in a tick, by path. A tick begins where `clk` rises."""
    names, scopes, changes, rises = {}, [], [], []
    time = 0
    for line in path.read_text().splitlines():
        words = line.split()
        if line.startswith("$scope"):
            scopes.append(words[2])
        elif line.startswith("$upscope"):
            scopes.pop()
        elif line.startswith("$var"):
            names.setdefault(words[3], []).append(".".join([*scopes, words[4]]))
        elif line.startswith("#"):
            time = int(line[1:])
        elif line[:1] in ("0", "1"):
            changes.append((time, line))
            if line[0] == "1" and any(name.endswith(".clk") for name in names[line[1:]]):
                rises.append(time)
    last = rises[tick]
    return {name: line[0] for time, line in changes if time <= last for name in names[line[1:]]}


def test_a_proof_and_a_counterexample(opened):
    opened.get_by_role("tab", name="Try a law").click()
    opened.wait_for_selector("#law-circuit")
    opened.get_by_role("button", name="Prove").click()
    opened.wait_for_selector(".law-result .good")
    text = opened.locator(".law-result").inner_text()
    row = json.loads(program("check", "unit_law", "--json"))["rows"][0]
    assert f"{row['states']} states, {row['transitions']} transitions" in text
    opened.fill("#law-set", "variant=literal")
    opened.get_by_role("button", name="Prove").click()
    opened.wait_for_selector(".law-result .bad")
    opened.get_by_role("button", name="Show the counterexample in the waves").click()
    assert opened.locator("#pane-waves").is_visible()


def test_the_note_of_a_part(opened):
    opened.get_by_role("tab", name="Circuit").click()
    opened.get_by_role("button", name="Show part unit_time, unit_time_register, JP3640909B2 ¶0016").click()
    opened.get_by_role("heading", name="unit_time_register").wait_for()
    note = opened.get_by_role("button", name="Note", exact=True)
    loads = "performance.getEntriesByType('resource').filter(({ name }) => name.endsWith('/notes.json')).length"
    assert opened.evaluate(loads) == 0
    note.focus()
    opened.keyboard.press("Enter")
    dialog = opened.get_by_role("dialog")
    dialog.locator("#note-unit-time-register").wait_for()
    assert dialog.locator(".note-path").inner_text() == "rtl_notes/pulse_interpolator/unit_time.md"
    # Two circuits share this note: it is open where the part's begins.
    assert dialog.locator(".note-text").evaluate("node => node.scrollTop") > 0
    dialog.get_by_role("link", name="pulse interpolator").first.click()
    assert dialog.locator(".note-path").inner_text() == "rtl_notes/pulse_interpolator/README.md"
    dialog.get_by_role("button", name="Back").click()
    assert dialog.locator(".note-path").inner_text().endswith("unit_time.md")
    assert Axe().run(opened).violations_count == 0
    opened.keyboard.press("Escape")
    assert not dialog.is_visible()
    assert opened.evaluate(loads) == 1
    assert note.evaluate("node => node === document.activeElement")


def test_parts_are_shown_with_their_figure_numerals(opened):
    opened.get_by_role("tab", name="Circuit").click()
    opened.wait_for_selector(".diagram")
    circuit = json.loads(program("list", "pulse_interpolator", "--json"))["circuits"][0]
    rows = opened.get_by_role("region", name="Parts").locator("tbody tr").all()
    shown = [row.locator("th, td").all_inner_texts() for row in rows]
    parts = circuit["connections"]["parts"]
    assert shown == [[part["name"], part["circuit"], part["source"]] for part in parts]
    x = opened.get_by_role("button", name="Show part x, axis, JP3640909B2 10 + 20 + 40")
    assert x.locator("text").all_text_contents() == ["x", "axis", "10 + 20 + 40"]
    # A part without parts has registers.
    opened.get_by_role("button", name="unit_time", exact=True).click()
    assert "shadow" in opened.get_by_role("region", name="Registers").inner_text()


def test_faults_are_found_by_the_charts_of_the_notes(opened):
    opened.get_by_role("tab", name="Try a law").click()
    opened.wait_for_selector("#law-circuit")
    opened.select_option("#law-circuit", "sync_stage")
    opened.get_by_role("button", name="Inject faults").click()
    opened.wait_for_selector(".law-result table")
    report = json.loads(program("mutate", "sync_stage", "--json"))["circuits"][0]
    rows = opened.locator(".law-result tbody tr").all()
    # The program for browsers may be compiled with paths from the root.
    shown = [[re.sub("^/.*/src/", "src/", text) for text in row.locator("td").all_inner_texts()[1:4]] for row in rows]
    assert shown == [[found["fault"], found["fate"], found.get("by", "")] for found in report["suspects"]]
    assert any(fate == "chart" for _, fate, _ in shown)


def test_one_property_is_proved(opened):
    opened.get_by_role("tab", name="Try a law").click()
    listed = json.loads(program("list", "unit_law", "--json"))["circuits"][0]["properties"]
    opened.wait_for_selector("#law-property option:nth-child(2)", state="attached")
    assert opened.locator("#law-property option").all_inner_texts() == ["all", *listed]
    opened.select_option("#law-property", listed[1])
    opened.get_by_role("button", name="Prove").click()
    opened.wait_for_selector(".law-result .good")
    assert opened.locator(".law-result li").all_inner_texts() == [listed[1]]


def test_a_single_fault_and_its_waves(opened, tmp_path):
    opened.get_by_role("tab", name="Try a law").click()
    opened.wait_for_selector("#law-circuit")
    opened.select_option("#law-circuit", "enable_counter")
    opened.get_by_role("button", name="Inject faults").click()
    opened.get_by_role("button", name="Try fault 1:").click()
    opened.wait_for_selector(".law-fault")
    width = json.loads(program("list", "enable_counter", "--json"))["circuits"][0]["keys"]["width"]["small"]
    words = ["mutate", "enable_counter", "--width", width, "--fault", "1", "--json", "--out", tmp_path]
    single = json.loads(program(*words))
    headings = opened.locator(".law-fault h3").all_inner_texts()
    properties = [run["name"] for run in single["found"] if run["by"] == "proof"]
    assert properties and len(headings) == len(single["found"])
    for heading, name in zip(headings, properties):
        assert heading == f"found by the property {name}"
    opened.get_by_role("button", name="Show it in the waves").last.click()
    assert opened.locator("#pane-waves").is_visible()
    values = "() => motionRtl.waves.valueAtCursor('enable_counter.without_fault.enable')"
    opened.wait_for_function(values)


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_every_pane_is_accessible(opened, scheme):
    opened.emulate_media(color_scheme=scheme)
    for pane in ["Path", "Waves", "Circuit", "Try a law", "Summary"]:
        opened.get_by_role("tab", name=pane).click()
        found = Axe().run(opened)
        assert found.violations_count == 0, f"{pane}: {found.generate_report()}"


def test_tabs_by_keys(opened):
    opened.get_by_role("tab", name="Path").focus()
    opened.keyboard.press("ArrowRight")
    assert opened.get_by_role("tab", name="Waves").get_attribute("aria-selected") == "true"
    assert opened.locator("#pane-waves").is_visible()


@pytest.mark.parametrize("series", ["csv", "npy"])
def test_the_page_of_a_run_shows_it_without_the_program(page, tmp_path, series):
    report = tmp_path / "report.html"
    words = ["run", "waves/weld.toml", "--json", "--out", tmp_path, "--html", report]
    words += ["--series", tmp_path / f"path.{series}"]
    expected = json.loads(program(*words))
    page.goto(report.as_uri())
    page.wait_for_selector('a[download="summary.json"]', state="attached")
    assert compared(summary(page)) == compared(expected)
    assert page.get_by_role("button", name="Note", exact=True).count() == 0
    assert page.locator(".path-canvas").is_visible()


@contextlib.contextmanager
def serving(**more):
    """A server and its address; it ends with the test, however that ends."""
    words = [PROGRAM, "serve", "--port", str(free_port())]
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True, **more) as server:
        try:
            yield server, server.stdout.readline().strip()
        finally:
            server.terminate()


def test_another_site_is_refused():
    with serving() as (_, address):
        port = urllib.parse.urlsplit(address).port
        statuses = []
        for headers in [{}, {"Origin": "http://example.org"}, {"Host": f"example.org:{port}"}]:
            asked = urllib.request.Request(address, headers=headers)
            try:
                with urllib.request.urlopen(asked) as answer:
                    statuses.append(answer.status)
            except urllib.error.HTTPError as error:
                statuses.append(error.code)
    assert statuses == [200, 403, 403]


def asked(address, **more):
    """Answer of a served page as JSON."""
    with urllib.request.urlopen(urllib.request.Request(address, **more)) as answer:
        return json.loads(answer.read())


def begun(address, *words):
    """Begins a job; returns its address."""
    body = json.dumps({"words": words, "files": []}).encode()
    return f"{address}run/{asked(f'{address}run', data=body, method='POST')['id']}"


def until(found, seconds=60):
    """Waits for something; returns it."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if value := found():
            return value
        time.sleep(0.05)
    raise AssertionError("not in time")


ENDING = ["SIGTERM", "SIGINT", "SIGHUP"]


def heard():
    """A test in the background is begun with some signals ignored, which its children would be too."""
    for name in ENDING:
        signal.signal(getattr(signal, name), signal.SIG_DFL)


@pytest.mark.parametrize("name", ENDING)
def test_a_signal_ends_jobs_and_removes_their_directories(tmp_path, name):
    environment = os.environ | {"TMPDIR": str(tmp_path)}
    with serving(env=environment, preexec_fn=heard) as (server, address):
        begun(address, "run", "waves/feed.toml", "--out", "out")
        job = until(lambda: list(tmp_path.glob("motion-rtl-*/work/out/.*")))[0]
        # A child is that of the thread that has begun it.
        tasks = pathlib.Path(f"/proc/{server.pid}/task").glob("*/children")
        child = "".join(task.read_text() for task in tasks).split()
        assert len(child) == 1 and job.exists()
        server.send_signal(getattr(signal, name))
        assert server.wait(30) == 128 + getattr(signal, name)
    assert list(tmp_path.iterdir()) == []
    assert not pathlib.Path(f"/proc/{child[0]}").exists()


def test_the_series_so_far_is_read_in_parts():
    with serving() as (_, address):
        job = begun(
            address,
            "run", "waves/feed.toml", "--no-vcd", "--out", "out", "--series", "out/path.csv", "--series-every", "1",
        )
        series = ""
        for _ in range(3):
            part = until(lambda: asked(f"{job}?from=0&series={len(series)}")["series"])
            assert part.endswith("\n")
            series += part
        assert asked(f"{job}?from=0")["series"] == ""
        asked_to_end = urllib.request.Request(job, method="DELETE")
        urllib.request.urlopen(asked_to_end).close()
    head, *rows = series.splitlines()
    assert head.startswith("tick,time_s,")
    assert [int(row.split(",")[0]) for row in rows] == list(range(len(rows)))

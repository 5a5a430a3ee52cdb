#!/usr/bin/env python3
"""Opens a report in a real browser: it loads, filters, unfolds a trial, and logs no error.

Usage: report_check.py REPORT.html [SCREENSHOT-FOLDER]
Needs chromium and chromedriver, and nothing of Python beyond its standard library.
"""
import base64
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import urllib.request


def call(method, url, body=None):
    """One WebDriver command; its value."""
    data = None if body is None else json.dumps(body).encode()
    request = urllib.request.Request(url, data=data, method=method, headers={"Content-Type": "application/json"})
    with urllib.request.urlopen(request, timeout=120) as answer:
        return json.load(answer)["value"]


def wait_for(what, seconds=60):
    end = time.monotonic() + seconds
    while True:
        try:
            return what()
        except OSError:
            if time.monotonic() > end:
                raise
            time.sleep(0.2)


def check(session, report, shots):
    run = lambda script: call("POST", f"{session}/execute/sync", {"script": f"return ({script});", "args": []})
    shoot = lambda name: shots and pathlib.Path(shots, name).write_bytes(
        base64.b64decode(call("GET", f"{session}/screenshot")))
    size = lambda width, height: call("POST", f"{session}/window/rect", {"width": width, "height": height})

    size(1280, 1000)
    call("POST", f"{session}/url", {"url": pathlib.Path(report).resolve().as_uri()})
    assert run("document.querySelectorAll('table').length") == 3, "three tables"
    assert run("document.querySelectorAll('table caption, table th[scope]').length") > 30, "captions and scopes"
    total = run("document.querySelectorAll('details.trial').length")
    visible = "[...document.querySelectorAll('details.trial')].filter(t => !t.hidden)"
    assert total > 0 and run(f"{visible}.length") == total, "all trials show at first"
    order = run("[...document.querySelectorAll('details.trial')].map(t => t.dataset.result)")
    ranks = [["failed", "wrong-first", "good"].index(result) for result in order]
    assert ranks == sorted(ranks), "failures come first"

    choose = ("(() => {{ const f = document.getElementById('filter'); f.{0}.value = '{1}';"
              " f.dispatchEvent(new Event('input', {{bubbles: true}})); return true; }})()")
    run(choose.format("result", "good"))
    good = run(f"{visible}.length")
    assert good == ranks.count(2) < total or ranks.count(2) == total, "the filter narrows"
    run(choose.format("home", "moved"))
    assert run(f"{visible}.every(t => t.dataset.home === 'moved' && t.dataset.result === 'good')"), "both hold"
    assert run("document.getElementById('shown').textContent").endswith(f"of {total} trials shown")
    run(choose.format("result", ""))
    run(choose.format("home", ""))

    # By keyboard: the first trial unfolds, and its pictures are there, with words for those who cannot see them.
    run("(() => { document.querySelector('details.trial > summary').focus(); return true; })()")
    active = call("GET", f"{session}/element/active")
    element = next(iter(active.values()))
    call("POST", f"{session}/element/{element}/value", {"text": "\ue007"})
    assert run("document.querySelector('details.trial').open"), "Enter unfolds a trial"
    loaded = "[...document.querySelector('details.trial').querySelectorAll('img')].map(i => [i.complete && i.naturalWidth > 0, i.alt.length])"
    wait_until = time.monotonic() + 20
    while not all(done for done, _ in run(loaded)) and time.monotonic() < wait_until:
        time.sleep(0.2)
    pictures = run(loaded)
    assert len(pictures) == 2 and all(done and alt > 20 for done, alt in pictures), f"way and picture: {pictures}"
    shoot("desktop.png")
    size(400, 860)
    assert run("document.documentElement.scrollWidth <= window.innerWidth + 1"), "no sideways scrolling on a phone"
    shoot("phone.png")
    run("(() => { document.querySelector('.pictures').scrollIntoView(); return true; })()")
    shoot("phone-trial.png")
    return total, call("POST", f"{session}/se/log", {"type": "browser"})


def main():
    report, shots = sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else None
    driver = subprocess.Popen(["chromedriver", "--port=0"], stdout=subprocess.PIPE, text=True)
    try:
        port = next(line.rsplit("port ", 1)[1].strip(". \n") for line in driver.stdout if "successfully on port" in line)
        base = f"http://127.0.0.1:{port}"
        with tempfile.TemporaryDirectory() as profile:
            arguments = ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                         "--disable-background-networking", f"--user-data-dir={profile}"]
            wanted = {"alwaysMatch": {"goog:chromeOptions": {"args": arguments},
                                      "goog:loggingPrefs": {"browser": "ALL"}}}
            made = wait_for(lambda: call("POST", f"{base}/session", {"capabilities": wanted}))
            session = f"{base}/session/{made['sessionId']}"
            try:
                total, log = check(session, report, shots)
            finally:
                call("DELETE", session)
    finally:
        driver.terminate()
        driver.wait()
    if log:
        sys.exit(f"the browser's console says: {log}")
    print(f"{os.path.basename(report)}: opens, filters and unfolds {total} trials; the console is silent")


if __name__ == "__main__":
    main()

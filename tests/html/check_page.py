#!/usr/bin/env python3
"""Opens a page of skinforge in headless Chromium, uses it as a person would, and prints what it saw as JSON.

    check_page.py build|diff PAGE [PICTURE.png]

Status 3 where there is no browser. `moved`: share of the canvas's pixels that differ between two moments of a clip."""
import json
import pathlib
import sys

from browser import Browser, chromium

READY = "document.readyState === 'complete' && document.body.dataset.viewer !== 'starting'"
SMALL_CANVAS = """(() => { const c = document.createElement('canvas'); c.width = 160; c.height = 120;
  const g = c.getContext('2d'); g.drawImage(document.querySelector('canvas'), 0, 0, 160, 120);
  return Array.from(g.getImageData(0, 0, 160, 120).data); })()"""


def pixels(page):
    data = page.value(SMALL_CANVAS)
    return [tuple(data[i:i + 3]) for i in range(0, len(data), 4)]


def changed(before, after):
    differ = sum(max(abs(x - y) for x, y in zip(a, b)) > 12 for a, b in zip(before, after))
    return differ / len(before)


def choose_clip(page, clip):
    page.value(f"""(() => {{ const s = document.getElementById('clip'); s.value = {json.dumps(clip)};
      s.dispatchEvent(new Event('change')); }})()""")


def click(page, selector):
    page.value(f"document.querySelector({json.dumps(selector)}).click()")


def play(page, seen):
    """Every clip moves: plays it until its clock has gone on, and compares with its beginning."""
    seen["moved"] = {}
    for clip in seen["clips"]:
        choose_clip(page, clip)
        page.wait_for("Number(document.body.dataset.time) > 0")
        click(page, "#play")  # pause
        page.value("document.querySelector('.player input').value = 0; "
                   "document.querySelector('.player input').dispatchEvent(new Event('input'))")
        begin, most = pixels(page), 0
        for share in (150, 350, 500, 800):
            page.value(f"document.querySelector('.player input').value = {share}; "
                       "document.querySelector('.player input').dispatchEvent(new Event('input'))")
            most = max(most, changed(begin, pixels(page)))
        seen["moved"][clip] = most
    choose_clip(page, "")


def look(page, seen):
    """Each colour and each switch changes the picture."""
    seen["changed"] = {}
    click(page, "#colors button[value=materials]")
    plain = pixels(page)
    seen["drawn"] = len(set(plain))
    for color in page.value("[...document.querySelectorAll('#colors button')].map((b) => b.value)"):
        if color == "materials":
            continue
        click(page, f"#colors button[value={color}]")
        seen["changed"][color] = changed(plain, pixels(page))
        if color == "source":
            seen["legend"] = page.value("[...document.querySelectorAll('.swatches li')].map((l) => l.textContent)")
    click(page, "#colors button[value=materials]")
    for switch in ("wire", "skeleton"):
        click(page, f"#{switch}")
        seen["changed"][switch] = changed(plain, pixels(page))
        click(page, f"#{switch}")


def shown_pictures(page):
    """How many images can be drawn; those further down are fetched, too."""
    page.value("[...document.images].forEach((i) => { i.loading = 'eager'; })")
    page.wait_for("[...document.images].every((i) => i.complete)")
    return page.value("[...document.images].filter((i) => i.naturalWidth > 0).length")


def main(kind, path, picture=None):
    if not chromium():
        sys.exit(3)
    page_path = pathlib.Path(path).resolve()
    with Browser() as page:
        page.open(page_path.as_uri())
        page.wait_for(READY)
        seen = {"viewer": page.value("document.body.dataset.viewer"), "kind": kind,
                "sections": page.value("[...document.querySelectorAll('section')].map((s) => s.id)"),
                "clips": page.value("[...document.querySelectorAll('#clip option')].map((o) => o.value)"
                                    ".filter(Boolean)"),
                "text": page.value("document.body.innerText")[:2000]}
        if seen["viewer"] == "ready":
            play(page, seen)
            look(page, seen)
        seen["pictures"] = shown_pictures(page)
        if picture:
            page.picture(picture, full=True)
        seen["complaints"] = page.complaints
        seen["requests"] = [r for r in page.requests if r != page_path.as_uri()]
    print(json.dumps(seen))


if __name__ == "__main__":
    main(*sys.argv[1:])

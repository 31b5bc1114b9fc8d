#!/usr/bin/env python3
"""Lists every issue code that the sources raise, as the page src/report/issues.md.

    scripts/list_issue_codes.py           write the page
    scripts/list_issue_codes.py --check   fail when the page is out of date
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "src" / "report" / "issues.md"
CALL = re.compile(r'\b(note|warn)\(\s*"([a-z0-9]+(?:-[a-z0-9]+)+)"\s*,')
ISSUE = re.compile(r'\{\s*"([a-z0-9]+(?:-[a-z0-9]+)+)"\s*,\s*Severity::(Note|Warning)\s*,')
LITERAL = re.compile(r'"((?:[^"\\]|\\.)*)"')
SEVERITY = {"note": "note", "warn": "warning", "Note": "note", "Warning": "warning"}
HEAD = """# Issue codes

Odd but usable input, and what is done about it. Made from the sources by `scripts/list_issue_codes.py`; do not edit.
`...` stands for values. Notes lose nothing; warnings are worth a look.

| code | severity | raised in | message |
|---|---|---|---|
"""


def arguments(text, start):
    """The rest of a call or braces from `start` (behind the code's comma) to where it closes, split at its commas."""
    depth, parts, part, i = 0, [], "", start
    while i < len(text):
        literal = LITERAL.match(text, i)
        if literal:
            part += literal.group(0)
            i = literal.end()
            continue
        if text[i] in ")}" and depth == 0:
            return parts + [part]
        depth += {"(": 1, "{": 1, "[": 1, ")": -1, "}": -1, "]": -1}.get(text[i], 0)
        if text[i] == "," and depth == 0:
            parts.append(part)
            part = ""
        else:
            part += text[i]
        i += 1
    return parts + [part]


def sentence(argument):
    """What a message argument says: its literals, with `...` for values between them and in braces."""
    argument = argument.strip()
    if argument.startswith("fmt::format("):
        argument = arguments(argument, len("fmt::format("))[0].strip()
    said, i = "", 0
    while i < len(argument):
        literal = LITERAL.match(argument, i)
        if literal:
            said += literal.group(1)
            i = literal.end()
        else:
            skipped = re.compile(r'[^"]+').match(argument, i)
            said += "" if skipped.group(0).isspace() else " ... "
            i = skipped.end()
    said = said.replace('\\"', '"').replace("|", "\\|")
    return re.sub(r"\s+", " ", re.sub(r"\{[^{}]*\}", "...", said)).strip()


def found_codes():
    codes = {}
    for path in sorted((ROOT / "src").rglob("*.cpp")) + sorted((ROOT / "src").rglob("*.h")):
        text = path.read_text(encoding="utf-8")
        raised = [(m.group(2), m.group(1), m.end()) for m in CALL.finditer(text)]
        raised += [(m.group(1), m.group(2), m.end()) for m in ISSUE.finditer(text)]
        for code, severity, end in raised:
            parts = arguments(text, end)
            if len(parts) < 2:
                continue
            where = path.relative_to(ROOT).as_posix()
            row = codes.setdefault((code, SEVERITY[severity]), [set(), set()])
            row[0].add(where.removeprefix("src/"))
            row[1].add(sentence(parts[-1]))
    return codes


def page():
    rows = [
        f"| `{code}` | {severity} | {'<br>'.join(sorted(places))} | {'<br>'.join(sorted(said))} |\n"
        for (code, severity), (places, said) in sorted(found_codes().items())
    ]
    return HEAD + "".join(rows)


def main():
    if sys.argv[1:] == ["--check"]:
        current = PAGE.read_text(encoding="utf-8") if PAGE.exists() else ""
        if current != page():
            print(f"{PAGE.relative_to(ROOT)} is out of date: run scripts/list_issue_codes.py")
            return 1
        return 0
    if sys.argv[1:]:
        print(__doc__)
        return 2
    PAGE.write_text(page(), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())

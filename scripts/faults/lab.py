"""One program, one recipe, a scratch folder: builds, and what must come out of them."""
import dataclasses
import hashlib
import pathlib
import shutil
import subprocess

TEMPORARY = ".skinforge-"


@dataclasses.dataclass
class Run:
    status: int  # exit status; negative: the signal that ended it; None: it hung
    text: str  # what it said on both streams


def digests(folder):
    """SHA-256 of each file below a folder but timings.json and report.html, which tell of one run, and temporaries."""
    folder = pathlib.Path(folder)
    return {
        str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(folder.rglob("*"))
        if path.is_file() and path.name not in ("timings.json", "report.html") and not path.name.startswith(TEMPORARY)
    }


class Lab:
    """Counts what broke; `expected` are the bytes of a clean build, `warm` the cache it left."""

    def __init__(self, program, recipe, scratch, report="json", jobs=1, timeout=120):
        self.program, self.recipe = pathlib.Path(program).resolve(), pathlib.Path(recipe).resolve()
        self.scratch, self.report, self.jobs, self.timeout = pathlib.Path(scratch), report, jobs, timeout
        self.warm = self.scratch / "warm"
        self.broken = []
        clean = self.build(self.warm, self.scratch / "clean")
        if clean.status != 0:
            raise SystemExit(f"the clean build failed: {clean.text.strip()[-300:]}")
        self.expected = digests(self.scratch / "clean")

    def command(self, cache, out):
        return [self.program, "build", self.recipe, "--report", self.report, "-j", str(self.jobs), "--cache", cache,
                "--out", out]

    def call(self, command, **more):
        try:
            done = subprocess.run([str(word) for word in command], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, timeout=self.timeout, cwd=self.scratch, **more)
        except subprocess.TimeoutExpired:
            return Run(None, "")
        return Run(done.returncode, done.stdout.decode("utf-8", "replace"))

    def build(self, cache, out, prefix=(), **more):
        return self.call([*prefix, *self.command(cache, out)], **more)

    def cache(self, *words):
        return self.call([self.program, "cache", *words[:1], "--cache", words[1], *words[2:]])

    def fresh(self, name, warm=False):
        """An empty folder of the scratch, or a copy of the warm cache."""
        folder = self.scratch / name
        shutil.rmtree(folder, ignore_errors=True)
        if warm:
            shutil.copytree(self.warm, folder)
        else:
            folder.mkdir()
        return folder

    def expect(self, holds, what, run=None):
        if not holds:
            self.broken.append(what)
            print(f"  BROKEN: {what}" + (f": {run.status} {run.text.strip()[-200:]}" if run else ""), flush=True)
        return holds

    def expect_whole(self, out, what):
        """Each file is absent or as it must be."""
        found = digests(out)
        torn = [name for name, digest in found.items() if self.expected.get(name) != digest]
        return self.expect(not torn, f"{what}: {torn[:3]} in the output")

    def expect_right(self, run, out, what):
        good = self.expect(run.status == 0, f"{what}: the build failed", run)
        return good and self.expect(digests(out) == self.expected, f"{what}: other bytes", run)

    def expect_error(self, run, what):
        """An exit status of the table in the README and something said; no signal, no hang."""
        good = run.status is not None and 0 < run.status < 128 and "error: " in run.text
        return self.expect(good, f"{what}: no clear error", run)

    def expect_recovery(self, cache, out, what):
        self.expect_right(self.build(cache, out), out, f"{what}, next build")
        verdict = self.cache("verify", cache)
        self.expect(verdict.status == 0, f"{what}: cache verify", verdict)

"""Kills at random moments, and many builds at once."""
import os
import signal
import subprocess
import threading
import time

from .disk import temporaries
from .lab import TEMPORARY, digests


def kills(lab, rounds, random):
    """Each build is killed at a random moment, then one runs to its end."""
    begin = time.monotonic()
    lab.build(lab.fresh("cache"), lab.fresh("out"))
    whole = time.monotonic() - begin
    killed = 0
    for i in range(rounds):
        cache, out = lab.fresh("cache"), lab.fresh("out")
        process = subprocess.Popen([str(word) for word in lab.command(cache, out)], stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        try:
            process.wait(timeout=random.uniform(0, whole))
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            killed += 1
        lab.expect_whole(out, f"kill {i}")
        lab.expect_recovery(cache, out, f"kill {i}")
        left = [path for folder in (cache, out) for path in folder.rglob(TEMPORARY + "*")]
        for path in left:
            os.utime(path, (0, 0))
        if left:  # an hour later, as it were; a hit writes nothing into the cache, so that is for its next miss
            lab.build(cache, out)
            lab.expect(not temporaries(out), f"kill {i}: temporaries left in the output")
    print(f"kills: {rounds} rounds, {killed} of them killed in {whole:.1f} s")


def crowd(lab, builders, rounds):
    """Builds at once on one cache, cold and warm by turns, with `cache gc` beside them."""
    runs = 0
    for i in range(rounds):
        cache = lab.fresh("cache", warm=i % 2 == 1)
        outs = [lab.fresh(f"out{k}") for k in range(builders)]
        results = [None] * builders
        stop = threading.Event()

        def collect():
            while not stop.is_set():
                run = lab.cache("gc", cache, "--max-size", "0.0005")
                lab.expect(run.status == 0, f"round {i}: cache gc", run)

        def build(k):
            results[k] = lab.build(cache, outs[k])

        collector = threading.Thread(target=collect)
        threads = [threading.Thread(target=build, args=(k,)) for k in range(builders)]
        for thread in [collector, *threads]:
            thread.start()
        for thread in threads:
            thread.join()
        stop.set()
        collector.join()
        for k, run in enumerate(results):
            runs += lab.expect_right(run, outs[k], f"round {i}, build {k}")
        left = temporaries(cache)
        lab.expect(not left, f"round {i}: {len(left)} temporaries left")
        verdict = lab.cache("verify", cache)
        lab.expect(verdict.status == 0, f"round {i}: cache verify", verdict)
    print(f"crowd: {rounds} rounds of {builders} builds with cache gc beside them, {runs} right")


def surroundings(lab, rounds):
    """Threads, languages, time zones, folders, umasks, with and without a random layout of memory."""
    languages, zones = ("C", "de_DE.UTF-8", "tr_TR.UTF-8"), ("UTC", "Asia/Kolkata", "America/Caracas")
    for i in range(rounds):
        cache, out = lab.fresh("cache"), lab.fresh("out")
        folder = lab.fresh("here" if i % 2 else "there")
        variables = dict(os.environ, LC_ALL=languages[i % 3], TZ=zones[i // 3 % 3], HOME=str(folder))
        command = ["sh", "-c", f"umask {(0o22, 0o77, 0)[i % 3]:o}; cd {folder}; exec \"$@\"", "sh",
                   *(["setarch", "-R"] if i % 4 < 2 else []), *lab.command(cache, out)]
        command[command.index("-j") + 1] = str((1, 2, 8)[i % 3])
        lab.expect_right(lab.call(command, env=variables), out, f"surroundings {i}")
    print(f"surroundings: {rounds} runs over threads, languages, zones, folders, umasks, layouts")


def changing_input(lab, rounds, random):
    """An input is rewritten all the time: each build is right for one content of it, or an error, and no entry of the
    cache is wrong for its key."""
    source = lab.recipe.parent
    text = lab.recipe.read_text()
    first = next(word for word in text.split('"') if word.endswith(".glb"))
    folder = lab.fresh("changing")
    for word in {word for word in text.split('"') if word.endswith((".glb", ".fbx"))}:
        target = folder / "data" / os.path.basename(word)
        target.parent.mkdir(exist_ok=True)
        if (source / word).exists():
            target.write_bytes((source / word).read_bytes())
        text = text.replace(f'"{word}"', f'"data/{os.path.basename(word)}"')
    recipe = folder / "recipe.json"
    recipe.write_text(text)
    victim = folder / "data" / os.path.basename(first)
    content = victim.read_bytes()
    stop = threading.Event()

    def rewrite():
        while not stop.is_set():
            data = bytearray(content)
            data[-1 - random.randrange(len(data) // 4)] ^= 1
            victim.write_bytes(data)
            time.sleep(0.001)

    writer = threading.Thread(target=rewrite)
    writer.start()
    cache, good = lab.fresh("cache"), 0
    for i in range(rounds):
        run = lab.call([lab.program, "build", recipe, "--report", "none", "-j", str(lab.jobs), "--cache", cache, "--out",
                        lab.fresh("out")])
        good += run.status == 0
        if run.status != 0:
            lab.expect_error(run, f"input that changes, build {i}")
    stop.set()
    writer.join()
    victim.write_bytes(content)
    outs = []
    for where in (cache, lab.fresh("cache2")):
        outs.append(lab.fresh(f"out{len(outs)}"))
        run = lab.call([lab.program, "build", recipe, "--report", "none", "-j", str(lab.jobs), "--cache", where, "--out",
                        outs[-1]])
        lab.expect(run.status == 0, "input that changed, last build", run)
    lab.expect(digests(outs[0]) == digests(outs[1]), "input that changed: the cache gives other bytes")
    print(f"changing input: {rounds} builds, {good} with a result")

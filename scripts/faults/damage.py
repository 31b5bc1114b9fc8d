"""Damage to a warm cache: it must be noticed, never believed, and mended."""
import os
import pathlib
import shutil

ENTRIES = ("ac", "cas")  # the others hold reasons and reminders only


def entries(cache):
    return sorted(path for folder in ENTRIES for path in (pathlib.Path(cache) / folder).iterdir())


def flip(path, random, _):
    data = bytearray(path.read_bytes())
    data[random.randrange(len(data))] ^= 1 << random.randrange(8)
    path.write_bytes(data)


def cut(path, random, _):
    data = path.read_bytes()
    path.write_bytes(data[: random.randrange(len(data))])


def empty(path, _random, _all):
    path.write_bytes(b"")


def lengthen(path, random, _):
    path.write_bytes(path.read_bytes() + random.randbytes(random.randrange(1, 5000)))


def blank(path, random, _):
    """A run of zeros, as a page that never reached the disk."""
    data = bytearray(path.read_bytes())
    begin = random.randrange(len(data))
    piece = data[begin : begin + 4096]
    data[begin : begin + 4096] = bytes(len(piece))
    if not any(piece):
        data[begin] ^= 1
    path.write_bytes(data)


def swap(path, random, all_entries):
    other = random.choice([p for p in all_entries if p.parent == path.parent and p != path])
    data = path.read_bytes()
    path.write_bytes(other.read_bytes())
    other.write_bytes(data)


def stretch(path, _random, _all):
    """A hole of a terabyte: no disk space, but more than any memory holds."""
    os.truncate(path, 1 << 40)


def folder(path, _random, _all):
    path.unlink()
    (path / "inside").mkdir(parents=True)


def link(path, random, all_entries):
    target = random.choice([p for p in all_entries if p != path])
    path.unlink()
    path.symlink_to(target)


def delete(path, _random, _all):
    path.unlink()


KINDS = (flip, cut, empty, lengthen, blank, swap, stretch, folder, link, delete)


def one(lab, path, kind, random, what):
    """Damages one entry of a copy of the warm cache and builds. True when the program said so."""
    cache = lab.fresh("cache", warm=True)
    out = lab.fresh("out")
    victim = cache / path.relative_to(lab.warm)
    if kind in (flip, cut, empty, blank) and victim.stat().st_size == 0:
        kind = lengthen  # there is nothing to take away
    kind(victim, random, entries(cache))
    run = lab.build(cache, out)
    lab.expect_right(run, out, what)
    noticed = "warning" in run.text and "cache" in run.text
    if not (kind is delete and path.parent.name == "ac"):  # a manifest that is gone is a plain miss
        lab.expect(noticed, f"{what}: not noticed", run)
    verdict = lab.cache("verify", cache)
    lab.expect(verdict.status == 0, f"{what}: not mended", verdict)
    shutil.rmtree(cache)
    return noticed


def damage(lab, rounds, random):
    """Random damages over all entries."""
    targets = entries(lab.warm)
    noticed = sum(
        one(lab, path, kind, random, f"round {i}, {kind.__name__} {path.parent.name}/{path.name[:12]}")
        for i in range(rounds)
        for path, kind in [(random.choice(targets), random.choice(KINDS))]
    )
    print(f"damage: {rounds} rounds over {len(targets)} entries, {noticed} warnings")


def delete_each(lab, random):
    targets = entries(lab.warm)
    noticed = sum(one(lab, path, delete, random, f"delete {path.parent.name}/{path.name[:12]}") for path in targets)
    print(f"delete: each of {len(targets)} entries in turn, {noticed} warnings, the others plain misses")

"""Records of a cache."""
import json

from .variations import variations

DIGEST = "ab" * 32
MANIFEST = {"build": "b", "stage": "s", "instance": "i", "version": 1, "parameters": [["p", DIGEST]], "inputs": [["n", DIGEST]],
            "outputs": [{"name": "o", "sha256": DIGEST, "size": 3}],
            "issues": [{"code": "c", "warning": True, "place": "p", "message": "m"}],
            "cost": {"wall_seconds": 1.5, "cpu_seconds": 1, "peak_bytes": 5}}
RUN = {"stages": {"s": [DIGEST, 0], "t": [DIGEST, 1]}, "settings": [{"/name": "1"}, {"/base": "2"}]}
USAGE = {"builds": 1, "hits": 2, "runs": 3, "saved_seconds": 4.5, "spent_seconds": 6}


def seeds():
    for document in variations(MANIFEST):
        yield "cache", b"b" + json.dumps(document).encode()
    for record in (RUN, USAGE):
        for document in variations(record):
            yield "cache", b"a" + json.dumps(document).encode()
    yield "cache", b"a" + "\n".join([json.dumps(RUN), "x", json.dumps({**RUN, "settings": [{}]})]).encode()
    for failure in ("1\nmessage", "99999999999\n", "x\n\n", "message", "3"):
        yield "cache", b"d" + failure.encode()
    for line in (f"1 2 3 4 5 {DIGEST}\n", f"1 2 3 4 5 {DIGEST}\n6 7 8 9 10 {DIGEST}\n", "1 2 3 4 5 x\n", "-1 2", f"99999999999999999999 2 3 4 5 {DIGEST}"):
        yield "cache", b"d" + line.encode()
    yield "cache", b"b{" + b"[" * 200

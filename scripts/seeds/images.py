"""Small PNG files of each kind, made here; JPEG files the fuzzer makes of them."""
import struct
import zlib

SIGNATURE = b"\x89PNG\r\n\x1a\n"


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(width=3, height=2, depth=8, color=6, extra=(), rows=None, interlace=0, size=None):
    channels = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}.get(color, 1)
    row = bytes([1]) + bytes(range((width * channels * depth + 7) // 8))
    header = struct.pack(">IIBBBBB", *(size or (width, height)), depth, color, 0, 0, interlace)
    palette = [chunk(b"PLTE", bytes(range(12)))] if color == 3 else []
    parts = [chunk(b"IHDR", header), *palette, *extra, chunk(b"IDAT", zlib.compress(rows or row * height)), chunk(b"IEND", b"")]
    return SIGNATURE + b"".join(parts)


def jpeg(*segments):
    return b"\xff\xd8" + b"".join(b"\xff" + bytes([kind]) + struct.pack(">H", len(data) + 2) + data for kind, data in segments)


FRAME = (0xC0, struct.pack(">BHHB", 8, 2, 3, 1) + b"\x01\x11\x00")


def seeds():
    for color in (0, 2, 3, 4, 6):
        for depth in (1, 2, 4, 8, 16):
            yield "image", png(depth=depth, color=color)
    yield "image", png(color=3, extra=[chunk(b"tRNS", b"\x00\x80")])
    yield "image", png(color=0, extra=[chunk(b"tRNS", b"\x00\x01"), chunk(b"tEXt", b"a\0b")])
    yield "image", png(rows=b"".join(bytes([kind]) + bytes(range(12)) for kind in range(5)), height=5)
    yield "image", png(interlace=1)
    for size in ((0, 1), (1, 0), (20000, 1), (1, 20000), (16000, 16000), (4, 2)):
        yield "image", png(size=size)
    whole = png()
    for end in (4, 8, 20, 30, 40, len(whole) - 12, len(whole) - 1):
        yield "image", whole[:end]
    yield "image", SIGNATURE + chunk(b"IDAT", b"") + chunk(b"IEND", b"")
    yield "image", whole[:-20] + b"x" + whole[-19:]
    yield "image", b"GIF89a"
    for segments in ([FRAME], [(0xE0, b"JFIF\0"), FRAME], [(0xDA, b"")], [(0xC0, b"\x08")], [(0xD9, b"")],
                     [(0xC0, struct.pack(">BHHB", 8, 0, 3, 1))]):
        yield "image", jpeg(*segments)
    yield "image", b"\xff\xd8\xff\xff\xc0\x00\x0b" + FRAME[1]
    yield "image", b"\xff\xd8\xff\xe0\x00\x02x"
    yield "image", b"\xff\xd8\xff\xc0\xff\xff"

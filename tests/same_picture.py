"""Are two PNG files the same picture, drawn by any version of Cascade?

usage: same_picture.py [--surface] ONE OTHER

All bytes must be equal, except the chunk that names the version. With --surface, pixels may differ a little: processors
differ in the last bits of the reciprocals that Embree's rays are computed with, so a ray along the edge of
a thorn or a scale may hit it on one processor and miss it on another. All other chunks must be equal. One
sample of 1000 may differ, one of 5000 by more than four levels of 255, and none by more than 64. Exits with 1
otherwise.
"""
import struct
import sys
import zlib


def chunks(path):
    """All chunks as (kind, content), except the one that names the version."""
    with open(path, "rb") as file:
        data = file.read()
    at = 8
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if not body.startswith(b"Software\0"):
            yield kind, body
        at += length + 12


def paeth(left, up, corner):
    guess = left + up - corner
    by_left, by_up, by_corner = abs(guess - left), abs(guess - up), abs(guess - corner)
    if by_left <= by_up and by_left <= by_corner:
        return left
    return up if by_up <= by_corner else corner


def samples(compressed, row_bytes, pixel_bytes):
    """The bytes of all rows without their filters (PNG specification, section 9)."""
    raw = zlib.decompress(compressed)
    rows, above = [], bytes(row_bytes)
    for start in range(0, len(raw), row_bytes + 1):
        kind, row = raw[start], bytearray(raw[start + 1:start + 1 + row_bytes])
        for k in range(row_bytes):
            left = row[k - pixel_bytes] if k >= pixel_bytes else 0
            corner = above[k - pixel_bytes] if k >= pixel_bytes else 0
            guess = (0, left, above[k], (left + above[k]) // 2, paeth(left, above[k], corner))[kind]
            row[k] = (row[k] + guess) & 255
        rows.append(bytes(row))
        above = row
    return b"".join(rows)


def picture(path):
    others, compressed = [], b""
    for kind, body in chunks(path):
        if kind == b"IDAT":
            compressed += body
        else:
            others.append((kind, body))
    width, _, depth, colour = struct.unpack(">IIBB", others[0][1][:10])
    pixel_bytes = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}[colour] * depth // 8
    return others, samples(compressed, width * pixel_bytes, pixel_bytes)


def same(path, other_path, surface=False):
    if not surface:
        return list(chunks(path)) == list(chunks(other_path))
    (one, a), (other, b) = picture(path), picture(other_path)
    if one != other or len(a) != len(b):
        return False
    apart = [abs(x - y) for x, y in zip(a, b) if x != y]
    at_edges = sum(levels > 4 for levels in apart)
    return 1000 * len(apart) <= len(a) and 5000 * at_edges <= len(a) and max(apart, default=0) <= 64


if __name__ == "__main__":
    sys.exit(0 if same(sys.argv[-2], sys.argv[-1], sys.argv[1] == "--surface") else 1)

"""Checks of the maps that tests/material_test.sh bakes. Needs nothing but Python's own library.

usage: maps.py CHECK NAME ARGUMENTS…
"""
import json
import math
import struct
import sys
import zlib


def png(data):
    """Width, height and the rows of a PNG file: lists of pixels, tuples of numbers from 0 to 1."""
    at, compressed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", data[at + 8:at + 18])
        elif kind == b"IDAT":
            compressed += data[at + 8:at + 8 + length]
        at += length + 12
    channels, size = {0: 1, 2: 3, 4: 2, 6: 4}[colour], depth // 8
    raw, pixel = zlib.decompress(compressed), channels * size
    above, rows = bytes(width * pixel), []
    for start in range(0, len(raw), width * pixel + 1):
        kind, row = raw[start], bytearray(raw[start + 1:start + 1 + width * pixel])
        for k in range(len(row)):
            left = row[k - pixel] if k >= pixel else 0
            corner = above[k - pixel] if k >= pixel else 0
            up = above[k]
            if kind == 4:
                guess = left + up - corner
                near = sorted((abs(guess - v), order, v) for order, v in enumerate((left, up, corner)))
                guess = near[0][2]
            else:
                guess = (0, left, up, (left + up) // 2)[kind]
            row[k] = (row[k] + guess) & 255
        above = bytes(row)
        numbers = [int.from_bytes(above[k:k + size], "big") / (256 ** size - 1)
                   for k in range(0, len(above), size)]
        rows.append([tuple(numbers[k:k + channels]) for k in range(0, len(numbers), channels)])
    assert (width, height) == (len(rows[0]), len(rows))
    return rows


def beside(name, ending):
    with open(f"{name}_{ending}.png", "rb") as file:
        return png(file.read())


class Glb:
    def __init__(self, name):
        with open(name + ".glb", "rb") as file:
            data = file.read()
        length = struct.unpack("<I", data[12:16])[0]
        self.json = json.loads(data[20:20 + length])
        self.bytes = data[28 + length:]
        self.material = self.json["materials"][0]

    def texture(self, where):
        source = self.json["textures"][where["index"]]["source"]
        view = self.json["bufferViews"][self.json["images"][source]["bufferView"]]
        return png(self.bytes[view["byteOffset"]:view["byteOffset"] + view["byteLength"]])


def light(stored):
    return stored / 12.92 if stored <= 0.04045 else ((stored + 0.055) / 1.055) ** 2.4


def close(found, wanted, most, what):
    assert abs(found - wanted) <= most, f"{what}: {found} and not {wanted}"


def check_seams(name, endings):
    """No jump is larger across a side than inside."""
    for ending in endings:
        rows = beside(name, ending)
        for lines in (rows, list(zip(*rows))):
            jumps = [max(abs(a - b) for p, q in zip(lines[k], lines[(k + 1) % len(lines)])
                         for a, b in zip(p, q)) for k in range(len(lines))]
            assert jumps[-1] <= max(jumps[:-1]) + 1e-9, f"{ending}: {jumps[-1]} {max(jumps[:-1])}"


def check_waves(name, _saved):
    """Every texel but those at the edge of w is what the formulas give there."""
    glb = Glb(name)
    shine, packed = glb.material["pbrMetallicRoughness"], glb.texture(glb.material["occlusionTexture"])
    assert shine["roughnessFactor"] == 1 and shine["metallicFactor"] == 1
    assert shine["metallicRoughnessTexture"] == glb.material["occlusionTexture"]
    assert glb.material["emissiveFactor"] == [1, 1, 1] and glb.material["alphaMode"] == "BLEND"
    assert "samplers" not in glb.json  # The default sampler repeats.
    colour, emission = glb.texture(shine["baseColorTexture"]), glb.texture(glb.material["emissiveTexture"])
    separate = {map: beside(name, map) for map in
                ("color", "height", "normal", "occlusion", "roughness", "metalness", "emission", "opacity")}
    assert all(len(rows) == 256 and len(rows[0]) == 384 for rows in separate.values())
    for row in range(0, 256, 5):
        for column in range(0, 384, 3):
            x, y = (column + 0.5) / 384, (row + 0.5) / 256
            # The centres of cells are at (k + 0.5) / N, so the edge lies between columns 23 and 24.
            if min(abs(x - edge) for edge in (0, 0.5, 1)) < 1.6 / 48:
                continue
            at = lambda rows: rows[row][column]
            u = 0.5 + 0.5 * math.sin(2 * math.pi * x) * math.cos(4 * math.pi * y)
            w = 1 if x < 0.5 else 0
            red, green, blue, alpha = at(colour)
            for found, wanted in ((red, u), (green, 0.25), (blue, 1 - u)):
                close(light(found), light(wanted), 0.02, f"colour at {x}, {y}")
            assert at(separate["color"]) == (red, green, blue)
            close(alpha, 1 - 0.5 * w, 0.003, "alpha")
            close(at(packed)[1], 0.2 + 0.6 * u, 0.01, "roughness in green")
            close(at(packed)[2], w, 0.003, "metalness in blue")
            close(light(at(emission)[1]), w, 0.003, "emission")
            close(light(at(emission)[2]), light(0.5 * u), 0.01, "emission")
            close(at(separate["height"])[0], u, 0.01, "height")
            # The sides of the plane are 24 and 16; heights are 2 u.
            right = 2 * math.pi * math.cos(2 * math.pi * x) * math.cos(4 * math.pi * y) / 24
            up = 4 * math.pi * math.sin(2 * math.pi * x) * math.sin(4 * math.pi * y) / 16
            size = math.sqrt(1 + right ** 2 + up ** 2)
            normal = [2 * c - 1 for c in at(separate["normal"])]
            for found, wanted in zip(normal, (-right / size, -up / size, 1 / size)):
                close(found, wanted, 0.06, f"normal at {x}, {y}")
            for channel, map in enumerate(("occlusion", "roughness", "metalness")):
                assert at(separate[map])[0] == at(packed)[channel], map
            assert at(separate["opacity"])[0] == alpha and at(separate["emission"]) == at(emission)
            assert 0.5 < at(packed)[0] <= 1
    check_seams(name, ("color", "height", "normal", "occlusion", "roughness", "emission"))


def check_disc(name):
    """Less than 1 texel of 250 is on the wrong side: the outline of whole cells would be off in 1 of 60."""
    rows = beside(name, "color")
    away = lambda k: ((k + 0.5) / 512 - 0.5) ** 2
    wrong = sum((pixel[0] > pixel[2]) != (away(column) + away(row) < 0.1)
                for row, pixels in enumerate(rows) for column, pixel in enumerate(pixels))
    assert wrong < 512 * 512 / 250, wrong


def check_size(name, width, height):
    rows = beside(name, "color")
    assert (len(rows[0]), len(rows)) == (int(width), int(height)), (len(rows[0]), len(rows))


def check_json(name, sampler, alpha):
    glb = Glb(name)
    assert glb.json["scenes"] == [{"nodes": [0]}]
    if sampler == "sampler":
        assert glb.json["samplers"] == [{"wrapS": 33071, "wrapT": 10497}]
        assert all(texture["sampler"] == 0 for texture in glb.json["textures"])
    else:
        assert "samplers" not in glb.json
    assert glb.material.get("alphaMode", "opaque") == alpha
    if alpha == "opaque":
        shine = glb.material["pbrMetallicRoughness"]
        assert round(shine["roughnessFactor"], 6) == 0.6 and shine["metallicFactor"] == 0
        assert set(glb.material) <= {"pbrMetallicRoughness", "doubleSided"}


def check_on_model(name):
    glb = Glb(name)
    packed = glb.texture(glb.material["occlusionTexture"])
    emission = glb.texture(glb.material["emissiveTexture"])
    occlusion = [[], []]  # In valleys and on ridges.
    for row in range(4, 124, 5):
        for column in range(6, 122, 4):
            x = (column + 0.5) / 128
            close(packed[row][column][1], 0.25, 0.003, "roughness")
            close(packed[row][column][2], x, 0.02, "metalness")
            close(emission[row][column][0], 0.5, 0.003, "emission")
            wave = math.sin(6 * math.pi * x)
            if abs(wave) > 0.9 and 20 < row < 108:
                occlusion[wave > 0].append(packed[row][column][0])
    valley, ridge = (sum(each) / len(each) for each in occlusion)
    assert ridge > 0.95 and 0.3 < valley < 0.9, (valley, ridge)


globals()["check_" + sys.argv[1]](*sys.argv[2:])

"""Reads springlod assets: springlod.load("bunny.glb").levels[2].springs are pairs of node numbers.

All names and units are those of docs/asset-format.md, but nodes, springs, corners, vertices and
triangles are arrays: numpy's if it is installed, else lists (of tuples).
"""
import array, base64, json, math, struct
from types import SimpleNamespace
try: import numpy
except ImportError: numpy = None

LEVEL = ("rest:d3 mass:d volume:d contactArea:d border:B material:I ends:I2 restLength:d "
         "stiffness:d damping:d nodeOfBase:I")
CORNERS = "cornerNodes:I4 cornerYoung:d cornerYoungNumber:I"
OTHERS = {"terms": "termModulus:d termDampingTime:d termStart:I termNode:I termGradient:d3",
          "contactPoints": "contactStart:I contactNode:I contactWeight:d contactNormal:d3 "
                           "contactPointArea:d contactStiffness:d",
          "baseStart": "baseStart:I baseNode:I baseWeight:d"}
SURFACE = "positions:d3 indices:I3 bindingStart:I bindingNode:I bindingWeight:d"
NAMES = {"nodes": "rest", "springs": "ends", "corners": "cornerNodes", "vertices": "positions",
         "triangles": "indices"}
TYPES = {"float32": "f", "uint8": "B", "uint16": "H", "uint32": "I", "int16": "h"}
SECRET = base64.b64decode(
    "uP5sOSOkS758AYEs9yGtHN7UbemDkJfbckCkpLezZx/LeeZOzMDleIJa0H3M/3IhuAhGdPdDJI7gNZDmgTomTDwoUruR"
    "wwDLiNBlixtTLqNxZEiXog35TjgZ70ap3qzYqPp2P+OcND/53LvHxwtPHYpR4EvNtFkxyJ9+ydl4c2TqxayDNNPrw8WB"
    "oP/6E2PrFw3dUbfw2knTFlUmKdRonisWvlh9R6H8j/i40XrQMc5FyzqPlRYEKK/X+8q7S0B+")

class Record(SimpleNamespace):
    def __repr__(self): return f"<springlod: {', '.join(vars(self))}>"  # not all the numbers

class AssetError(ValueError): """Not a springlod asset, a damaged one, or one of a newer version."""

def xxh3(data, mask=2**64 - 1):  # XXH3, 64 bits, seed 0, of more than 240 bytes
    words = lambda source, at: struct.unpack_from("<8Q", source, at)
    keys, last = [words(SECRET, 8 * n) for n in range(17)], (len(data) - 1) // 64
    sums = [0xC2B2AE3D, 0x9E3779B185EBCA87, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9,
            0x85EBCA77C2B2AE63, 0x85EBCA77, 0x27D4EB2F165667C5, 0x9E3779B1]
    for n in range(last + 1):
        lanes = words(data, 64 * n if n < last else len(data) - 64)
        for i, key in enumerate(keys[n % 16] if n < last else words(SECRET, 121)):
            mixed = lanes[i] ^ key
            sums[i ^ 1] += lanes[i]
            sums[i] += (mixed & 0xFFFFFFFF) * (mixed >> 32)
        sums = [s & mask for s in sums]
        if n % 16 == 15 and n < last:
            sums = [(s ^ s >> 47 ^ key) * 0x9E3779B1 & mask for s, key in zip(sums, keys[16])]
    mixed = [s ^ key for s, key in zip(sums, words(SECRET, 11))]
    products = [mixed[i] * mixed[i + 1] for i in (0, 2, 4, 6)]
    sum_ = len(data) * 0x9E3779B185EBCA87 + sum(p & mask ^ p >> 64 for p in products) & mask
    sum_ = (sum_ ^ sum_ >> 37) * 0x165667919E3779F9 & mask
    return f"xxh3-64:{sum_ ^ sum_ >> 32:016x}"

def interpolate(start, node, weight, x):  # x: a position or velocity of each node
    return [tuple(sum(weight[e] * x[node[e]][d] for e in range(start[p], start[p + 1]))
                  for d in range(3)) for p in range(len(start) - 1)]

def parse(data):
    if data[:4] != b"glTF" or len(data) < 28: raise AssetError("not a .glb file")
    version, length, json_length = struct.unpack_from("<3I", data, 4)
    if version != 2 or length != len(data): raise AssetError("damaged: cut short, or not glTF 2")
    text, key = data[20:20 + json_length].decode(), '"SPRINGLOD_lod_chain":'
    at, binary, hashed = text.find(key + "{") + len(key), data[28 + json_length:], []
    if at < len(key): raise AssetError("not a springlod asset: no extension SPRINGLOD_lod_chain")
    asset, end = json.JSONDecoder(object_hook=lambda o: Record(**o)).raw_decode(text, at)
    if asset.version > 5: raise AssetError(f"of version {asset.version}; this reads up to 5")
    views = json.loads(text)["bufferViews"]

    def view(number, code):
        at, size = views[number].get("byteOffset", 0), views[number]["byteLength"]
        hashed.append(binary[at:at + size])
        return numpy.frombuffer(hashed[-1], code) if numpy else array.array(code, hashed[-1])
    def take(owner, fields):
        for name, code in (field.split(":") for field in fields.split()):
            place, values = getattr(owner, name, None), array.array(code[0])
            if isinstance(place, int): values = view(place, code[0])
            elif place: values = view(place.view, TYPES[place.type])
            else: hashed.append(b"")
            width, scale = int(code[1:] or 1), getattr(place, "scale", None)
            table = view(place.table, "f") if hasattr(place, "table") else None
            if numpy:
                values = numpy.asarray(values if table is None else table[values])
                values = values.astype("d") * scale if scale else values
                values = values.reshape(-1, width) if width > 1 else values
            else:
                values = [v if table is None else table[v] for v in values]
                values = [v * scale for v in values] if scale else values
                values = list(zip(*[iter(values)] * width)) if width > 1 else values
            setattr(owner, name, values)
        for name, field in NAMES.items():
            if hasattr(owner, field): setattr(owner, name, getattr(owner, field))
    for level in asset.levels:
        take(level, LEVEL + " " + CORNERS if asset.version > 1 else LEVEL)
        for name in OTHERS: hasattr(level, name) and take(level, OTHERS[name])
        if len(level.restLength) == 0:
            lengths = [math.dist(level.rest[a], level.rest[b]) for a, b in level.ends]
            level.restLength = numpy.array(lengths) if numpy else lengths
        given = getattr(level, "certificate", None) and level.certificate.stableStep
        level.stableStep = getattr(level, "stableStep", given)
    if not asset.levels[0].stableStep and hasattr(asset.levels[-1], "certificate"):
        asset.levels[0].stableStep = asset.levels[-1].certificate.baseStableStep
    if hasattr(asset, "surface"): take(asset.surface, SURFACE)
    hashed.append(text[at:end].replace(f'"checksum":"{asset.checksum}",', "", 1).encode())
    if xxh3(b"".join(struct.pack("<Q", len(h)) + h for h in hashed)) != asset.checksum:
        raise AssetError("damaged: its contents do not match its checksum")
    return asset

def load(path):
    with open(path, "rb") as file: data = file.read()
    try: return parse(data)
    except AssetError as e: raise AssetError(f"{path}: {e}") from None
    except Exception as e: raise AssetError(f"{path}: damaged: {type(e).__name__}: {e}") from e

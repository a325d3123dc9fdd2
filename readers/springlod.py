"""Reads springlod assets: springlod.load("bunny.glb").levels[2].springs are pairs of node numbers.

Names and units are those of docs/asset-format.md, but nodes, springs, corners, vertices and
triangles are arrays: numpy's if it is installed, else lists and tuples."""
import json, math, re, struct, types, zlib
try: import numpy
except ImportError: numpy = None

TYPES = {"float64": "d", "float32": "f", "uint8": "B", "uint16": "H", "uint32": "I", "int16": "h"}
NAMES = {"nodes": "rest", "springs": "ends", "corners": "cornerNodes", "vertices": "positions",
         "triangles": "indices"}

class AssetError(ValueError): """Not a springlod asset, a damaged one, or one of another version."""

class Record(types.SimpleNamespace):
    def __repr__(self): return f"<springlod: {', '.join(vars(self))}>"  # not all the numbers

def interpolate(start, node, weight, x):  # x: a position or velocity of each node
    return [tuple(sum(weight[e] * x[node[e]][d] for e in range(start[p], start[p + 1]))
                  for d in range(3)) for p in range(len(start) - 1)]

def rows(values, width=1):
    if numpy: return numpy.reshape(values, (-1, width) if width > 1 else -1)
    return list(zip(*[iter(values)] * width)) if width > 1 else values

def parse(data, name="asset"):  # data: the bytes of a file
    def check(fine, why):
        if not fine: raise AssetError(f"{name}: {why}")
    check(len(data) >= 28 and data[:4] == b"glTF", "not a .glb file")
    length, size = struct.unpack_from("<2I", data, 8)
    check(length == len(data), "damaged: cut short")
    stated = re.search(rb'"SPRINGLOD_lod_chain":{"checksum":"(crc32:\w{8})"', data)
    check(stated, "not a springlod asset of version 6; springlod slim writes older ones again")
    blank = data.replace(stated[1], b"crc32:00000000", 1)
    check(stated[1] == b"crc32:%08x" % zlib.crc32(blank), "damaged: wrong checksum")
    gltf = json.loads(data[20:20 + size])
    asset = gltf["extensions"]["SPRINGLOD_lod_chain"]
    check(asset["version"] == 6, f"of version {asset['version']}: take a newer springlod.py")

    def view(number, code):
        place = gltf["bufferViews"][number]
        count = place["byteLength"] // struct.calcsize(code)
        return struct.unpack_from(f"<{count}{code}", data, 28 + size + place.get("byteOffset", 0))
    def unpack(fields):  # an object of the JSON, after those in it
        if "view" in fields:
            values, table = view(fields["view"], TYPES[fields["type"]]), fields.get("table")
            if table is not None: values = [*map(view(table, "f").__getitem__, values)]
            if "scale" in fields: values = [v * fields["scale"] for v in values]
            return rows(values, fields.get("width", 1))
        for count in NAMES.keys() & fields.keys():
            check(len(fields[NAMES[count]]) == fields[count], f"damaged: {count}")
            fields[count] = fields[NAMES[count]]
        if "springs" in fields and len(fields["restLength"]) == 0:  # no spring has a force at rest
            x = fields["rest"]
            fields["restLength"] = rows([math.dist(x[a], x[b]) for a, b in fields["ends"]])
        return Record(**fields)
    return json.loads(json.dumps(asset), object_hook=unpack)

def load(path):
    with open(path, "rb") as file: return parse(file.read(), path)

# blender --background --factory-startup --python blender_motion.py -- FOLDER
#
# Shows a motion that springlod exported in each of its formats (skin.glb, morph.glb, cache.pc2 and
# cache.mdd with cache.obj) and holds the vertices against those of the OBJ sequence (frame_*.obj).
# Prints a line for each: name, largest distance over the size of the body at rest.
import glob
import os
import sys

import bpy
import numpy

# Debian 12's Blender 3.4 imports glTF with a name that its numpy 1.24 no longer has.
numpy.bool = bool

folder = sys.argv[sys.argv.index("--") + 1]


def obj_points(path):
    with open(path, encoding="utf-8") as file:
        return [tuple(map(float, line.split()[1:])) for line in file if line.startswith("v ")]


truth = [obj_points(path) for path in sorted(glob.glob(os.path.join(folder, "frame_*.obj")))]
FRAME_RATE = 30
bpy.context.scene.render.fps = FRAME_RATE


def shown(item, frame):
    """Positions of the vertices of an object in the world, as drawn in a frame."""
    bpy.context.scene.frame_set(frame)
    evaluated = item.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return [tuple(evaluated.matrix_world @ v.co) for v in evaluated.data.vertices]


def distance(a, b):
    return sum((x - y) ** 2 for x, y in zip(a, b)) ** 0.5


def size(points):
    return distance(*[[pick(axis) for axis in zip(*points)] for pick in (min, max)])


def clear():
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.delete()


def cached(kind):
    clear()
    before = set(bpy.data.objects)
    bpy.ops.wm.obj_import(filepath=os.path.join(folder, "cache.obj"), forward_axis="Y", up_axis="Z")
    (item,) = [o for o in bpy.data.objects if o not in before]
    modifier = item.modifiers.new("motion", "MESH_CACHE")
    modifier.cache_format = kind.upper()
    modifier.filepath = os.path.join(folder, "cache." + kind)
    return item


def imported_glb(name):
    clear()
    before = set(bpy.data.objects)
    bpy.ops.import_scene.gltf(filepath=os.path.join(folder, name))
    return next(o for o in bpy.data.objects if o not in before and o.type == "MESH")


def worst(item, first_frame, matching):
    """Over frames; `matching`: the vertex of the sequence for each vertex that is shown."""
    found = 0
    for number, points in enumerate(truth):
        places = shown(item, first_frame + number)
        found = max(found, max(distance(places[i], points[m]) for i, m in enumerate(matching)))
    return found / size(obj_points(os.path.join(folder, "cache.obj")))


def nearest(places, points):
    """For each place the nearest point: importers split the vertices at creases."""
    return [min(range(len(points)), key=lambda m: distance(place, points[m])) for place in places]


for kind in ("pc2", "mdd"):
    print("result", kind, worst(cached(kind), 0, range(len(truth[0]))))
for name in ("skin.glb", "morph.glb"):
    glb = imported_glb(name)
    print("result", name, worst(glb, 0, nearest(shown(glb, 0), truth[0])))

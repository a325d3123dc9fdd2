# python3 vtk_motion.py FOLDER: reads run.pvd and the .vtu files that it lists with VTK's readers and
# holds them against the OBJ sequence (frame_*.obj). Prints the largest distance [m] of the surface's
# points, the number of files, points and springs, and the sum of the masses [kg].
import glob
import os
import sys
import xml.etree.ElementTree

from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

folder = sys.argv[1]


def read(name):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(os.path.join(folder, name))
    reader.Update()
    return reader.GetOutput()


def obj_points(path):
    with open(path, encoding="utf-8") as file:
        return [tuple(map(float, line.split()[1:])) for line in file if line.startswith("v ")]


entries = xml.etree.ElementTree.parse(os.path.join(folder, "run.pvd")).findall(".//DataSet")
surfaces = [entry.get("file") for entry in entries if entry.get("part") == "1"]
frames = sorted(glob.glob(os.path.join(folder, "frame_*.obj")))
assert len(surfaces) == len(frames), (len(surfaces), len(frames))
worst = 0
for name, path in zip(surfaces, frames):
    grid, points = read(name), obj_points(path)
    assert grid.GetNumberOfPoints() == len(points)
    for i, point in enumerate(points):
        worst = max(worst, *(abs(a - b) for a, b in zip(grid.GetPoint(i), point)))
springs = read(entries[0].get("file"))
masses = springs.GetPointData().GetArray("mass")
print("distance", worst)
print("files", len(entries))
print("nodes", springs.GetNumberOfPoints())
print("springs", springs.GetNumberOfCells())
print("mass", sum(masses.GetValue(i) for i in range(masses.GetNumberOfValues())))

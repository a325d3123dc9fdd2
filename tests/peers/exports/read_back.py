"""Reads an export by another program and compares it with the JSON export of the same level.

    python3 read_back.py FORMAT STEM

FORMAT: npz, newton, vtk, msh, gmsh, sofa, usda, obj. The files are STEM.json and those of the
format with the same stem. Exit code: 0 equal, 1 different, 77 the program that reads is missing.
"""
import ast
import json
import re
import runpy
import shutil
import subprocess
import sys
import types
import xml.etree.ElementTree
from pathlib import Path

MISSING = 77
SINGLE = 1e-7  # relative, of single precision
try:
    import numpy as np
except ImportError:
    print("python3-numpy is not installed")
    sys.exit(MISSING)


def expected(stem):
    """The level as springlod's JSON holds it."""
    level = json.loads(Path(stem + ".json").read_text())
    springs, nodes = level["springs"], level["nodes"]
    result = {"rest": np.reshape(nodes["rest"], (-1, 3)), "mass": nodes["mass"],
              "springs": np.column_stack((springs["a"], springs["b"])),
              "rest_length": springs["rest_length"], "stiffness": springs["stiffness"],
              "damping": springs["damping"]}
    if "tetrahedra" in level:
        cells, materials = level["tetrahedra"], level["materials"]
        of = [materials[m] for m in cells["material"]]
        result.update(tetrahedra=np.reshape(cells["nodes"], (-1, 4)),
                      young=[m["young"] * f for m, f in zip(of, cells["fraction"])],
                      poisson=[m["poisson"] for m in of],
                      density=[m["density"] * f for m, f in zip(of, cells["fraction"])])
    if "surface" in level:
        result["triangles"] = np.reshape(level["surface"]["triangles"], (-1, 3))
    return result


def read_npz(stem):
    a = np.load(stem + ".npz")
    names = {"tetrahedra": "tetrahedra", "triangles": "surface_triangles"}
    names.update({n: "tetrahedron_" + n for n in ("young", "poisson", "density")})
    names.update({n: n for n in ("rest", "mass", "springs", "rest_length", "stiffness", "damping")})
    return {ours: a[theirs] for ours, theirs in names.items() if theirs in a}, 0


class Builder:
    """Stands in for newton.ModelBuilder, with the members that the reader uses."""

    def __init__(self, up_axis=None, gravity=None):
        self.up_axis, self.gravity = up_axis, gravity
        self.mass, self.rest, self.springs, self.stiffness, self.damping = [], [], [], [], []
        self.spring_rest_length, self.tetrahedra, self.moduli = [], [], []

    particle_count = property(lambda self: len(self.mass))

    def add_particle(self, pos, vel, mass, radius=None):
        assert vel == (0, 0, 0) and radius == 0
        self.rest.append(pos)
        self.mass.append(mass)

    def add_spring(self, i, j, ke, kd, control):
        assert control == 0
        self.springs.append((i, j))
        self.stiffness.append(ke)
        self.damping.append(kd)
        self.spring_rest_length.append(None)

    def add_tetrahedron(self, i, j, k, l, k_mu, k_lambda, k_damp):
        assert k_damp == 0
        self.tetrahedra.append((i, j, k, l))
        self.moduli.append((k_mu, k_lambda))


def read_newton(stem):
    ast.parse(Path(stem + ".py").read_text())
    newton = types.ModuleType("newton")
    newton.ModelBuilder, newton.Axis = Builder, types.SimpleNamespace(Z="Z")
    sys.modules["newton"] = newton
    build = runpy.run_path(stem + ".py")["build"]
    twice = build(build())  # two bodies in one builder
    half = twice.particle_count // 2
    b = build()
    assert (b.up_axis, round(b.gravity, 4)) == ("Z", -9.81) and b.particle_count == half
    assert twice.springs == b.springs + [(i + half, j + half) for i, j in b.springs]
    result = {"rest": b.rest, "mass": b.mass, "springs": b.springs, "stiffness": b.stiffness,
              "damping": b.damping, "rest_length": b.spring_rest_length}
    if "tet_indices" in np.load(stem + ".npz"):
        cells = build(tetrahedra=True)
        assert not cells.springs
        mu, lame = np.array(cells.moduli).T
        result.update(tetrahedra=cells.tetrahedra, young=mu * (3 * lame + 2 * mu) / (lame + mu),
                      poisson=lame / (2 * (lame + mu)))
    return result, 4 * SINGLE


def read_vtk(stem):
    try:
        from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
        from vtkmodules.util.numpy_support import vtk_to_numpy
    except ImportError:
        print("python3-vtk9 is not installed")
        sys.exit(MISSING)

    def grid_of(path):
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(path)
        reader.Update()
        assert reader.GetErrorCode() == 0, path
        grid = reader.GetOutput()
        size = grid.GetCell(0).GetNumberOfPoints()
        cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, size)
        return grid, vtk_to_numpy(grid.GetPoints().GetData()), cells

    def array(data, name):
        return vtk_to_numpy(data.GetArray(name))

    grid, rest, springs = grid_of(stem + ".vtu")
    result = {"rest": rest, "springs": springs, "mass": array(grid.GetPointData(), "mass")}
    for name in "rest_length", "stiffness", "damping":
        result[name] = array(grid.GetCellData(), name)
    if Path(stem + "-tetrahedra.vtu").exists():
        grid, _, result["tetrahedra"] = grid_of(stem + "-tetrahedra.vtu")
        for name in "young", "poisson", "density":
            result[name] = array(grid.GetCellData(), name)
    if Path(stem + "-surface.vtu").exists():
        result["triangles"] = grid_of(stem + "-surface.vtu")[2]
    return result, 0


def read_msh(stem):
    try:
        import meshio
    except ImportError:
        print("python3-meshio is not installed")
        sys.exit(MISSING)

    def elements(mesh, kind, names):
        """Nodes and values of the elements of one kind."""
        blocks = [b for b, block in enumerate(mesh.cells) if block.type == kind]
        return [np.concatenate([mesh.cells[b].data for b in blocks])] + [
            np.concatenate([np.ravel(mesh.cell_data[name][b]) for b in blocks]) for name in names]

    mesh = meshio.read(stem + ".msh")
    result = {"rest": mesh.points, "mass": mesh.point_data["mass"]}
    names = "rest_length", "stiffness", "damping"
    result.update(zip(("springs",) + names, elements(mesh, "line", names)))
    if Path(stem + "-tetrahedra.msh").exists():
        mesh = meshio.read(stem + "-tetrahedra.msh")
        names = "young", "poisson", "density", "gmsh:physical"
        result.update(zip(("tetrahedra",) + names, elements(mesh, "tetra", names)))
        result["material"] = result.pop("gmsh:physical") - 1
        groups = {name: list(group) for name, group in mesh.field_data.items()}
        assert groups == {"rod": [1, 3], "rubber": [2, 3]}, groups
    return result, 0


def read_gmsh(stem):
    """Gmsh itself opens the file and states its counts; meshio reads its values."""
    if not shutil.which("gmsh"):
        print("gmsh is not installed")
        sys.exit(MISSING)
    level = expected(stem)
    for path in stem + ".msh", stem + "-tetrahedra.msh":
        if not Path(path).exists():
            continue
        ran = subprocess.run(["gmsh", "-parse_and_exit", path], capture_output=True, text=True)
        output = ran.stdout + ran.stderr
        assert ran.returncode == 0 and not re.search("error|warning", output, re.I), output
        assert re.search(r"\b%d nodes" % len(level["rest"]), output), output
    return {"rest": level["rest"]}, 0


def read_sofa(stem):
    def scene(path):
        return xml.etree.ElementTree.parse(path).getroot()

    def values(element, name, columns=1):
        return np.array(element.get(name).split(), float).reshape(-1, columns)

    root = scene(stem + ".scn")
    springs = values(root.find(".//SpringForceField"), "spring", 5)
    result = {"rest": values(root.find(".//MechanicalObject"), "position", 3),
              "mass": values(root.find(".//DiagonalMass"), "vertexMass"),
              "springs": springs[:, :2], "stiffness": springs[:, 2], "damping": springs[:, 3],
              "rest_length": springs[:, 4]}
    assert 0 < float(root.get("dt")) < 1e-2 and root.get("gravity") == "0 0 -9.81"
    if not Path(stem + "-tetrahedra.scn").exists():
        return result, 0
    assert root.find(".//OglModel/../BarycentricMapping") is not None
    result["triangles"] = values(root.find(".//OglModel"), "triangles", 3)
    root = scene(stem + "-tetrahedra.scn")
    rows = []
    for node in root.iter("Node"):
        field = node.find("TetrahedronFEMForceField")
        if field is not None:
            nodes = values(node.find("MeshTopology"), "tetrahedra", 4)
            ratio = np.full((len(nodes), 1), float(field.get("poissonRatio")))
            rows.append(np.hstack((nodes, values(field, "youngModulus"), ratio)))
    rows = np.concatenate(rows)
    # By material there, by cell here: compare in the order of the cells.
    order = {tuple(t): i for i, t in enumerate(expected(stem)["tetrahedra"].tolist())}
    rows = rows[np.argsort([order[tuple(t)] for t in rows[:, :4].astype(int).tolist()])]
    result.update(tetrahedra=rows[:, :4], young=rows[:, 4], poisson=rows[:, 5])
    return result, 0


def read_usda(stem):
    text = Path(stem + ".usda").read_text()
    assert text.startswith("#usda 1.0\n") and text.count("{") == text.count("}")
    assert 'upAxis = "Z"' in text and "metersPerUnit = 1\n" in text

    def array(prim, name, columns=1):
        body = re.search(r'def \w+ "%s"\n    \{(.*?)\n    \}' % prim, text, re.S)[1]
        numbers = re.search(r"\] %s = \[(.*)\]" % name, body)[1]
        return np.array(re.sub("[()]", "", numbers).split(", "), float).reshape(-1, columns)

    result = {"rest": array("nodes", "springlod:rest", 3), "mass": array("nodes", "springlod:mass"),
              "springs": np.hstack((array("springs", "springlod:a"),
                                    array("springs", "springlod:b"))),
              "rest_length": array("springs", "springlod:restLength"),
              "stiffness": array("springs", "springlod:stiffness"),
              "damping": array("springs", "springlod:damping"),
              "triangles": array("skin", "faceVertexIndices", 3)}
    ends = array("springs", "points", 6)
    assert np.array_equal(ends[:, 3:] - ends[:, :3],
                          np.diff(result["rest"][result["springs"].astype(int)], axis=1)[:, 0])
    assert np.all(array("springs", "curveVertexCounts") == 2)
    assert np.all(array("skin", "faceVertexCounts") == 3)
    return result, 0


def read_obj(stem):
    if not shutil.which("assimp"):
        print("assimp-utils is not installed")
        sys.exit(MISSING)
    ran = subprocess.run(["assimp", "info", stem + ".obj"], capture_output=True, text=True)
    assert ran.returncode == 0, ran.stdout + ran.stderr
    level = expected(stem)
    assert int(re.search(r"Faces:\s+(\d+)", ran.stdout)[1]) == len(level["triangles"]), ran.stdout
    return {"rest": level["rest"]}, 0


def main():
    kind, stem = sys.argv[1:]
    ours, (theirs, tolerance) = expected(stem), globals()["read_" + kind](stem)
    if kind == "msh" and "material" in theirs:
        level = json.loads(Path(stem + ".json").read_text())
        ours["material"] = level["tetrahedra"]["material"]
    failed = False
    for name, values in theirs.items():
        a, b = np.asarray(ours[name], float), np.asarray(values, float)
        b = b.reshape(a.shape) if a.size == b.size else b
        if a.shape != b.shape:
            print(f"{kind}: {name} has the shape {b.shape}, not {a.shape}")
            failed = True
        elif a.size and np.max(np.abs(a - b)) > tolerance * np.max(np.abs(a)):
            print(f"{kind}: {name} differs by up to {np.max(np.abs(a - b))}")
            failed = True
    print(f"{kind}: {', '.join(theirs)}")
    sys.exit(failed)


main()

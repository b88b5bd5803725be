"""Compare speed with pyrender and OSMesa, or with VTK if OSMesa is missing.

    python compare_speed.py [alberti] [pyrender] [vtk]

The model is a sphere of 15,000 triangles with a texture of 1024 × 1024 texels. The script measures
color, depth and ids at 640 × 480 on one thread after a warm-up, and 100 views at 256 × 256 on two
threads. Every renderer runs in a separate process.
"""

import os
import subprocess
import sys
import time

SIZE = (640, 480)


def sphere():
    """Return a sphere of 76 x 100 quads: 15,000 triangles."""
    import numpy as np

    rows, columns = 76, 100
    v, u = np.meshgrid(np.linspace(0, 1, rows + 1), np.linspace(0, 1, columns + 1), indexing="ij")
    ring = np.sin(np.pi * v)
    points = np.stack(
        [ring * np.cos(2 * np.pi * u), np.cos(np.pi * v), ring * np.sin(2 * np.pi * u)], axis=-1
    ).reshape(-1, 3)
    i, j = (a.ravel() for a in np.meshgrid(range(rows), range(columns), indexing="ij"))
    corner = i * (columns + 1) + j
    below = corner + columns + 1
    first = np.stack([corner, corner + 1, below], axis=1)[i > 0]
    second = np.stack([corner + 1, below + 1, below], axis=1)[i < rows - 1]
    uv = np.stack([u.ravel(), 1 - v.ravel()], axis=1)
    texture = np.random.default_rng(1).integers(0, 256, (1024, 1024, 3), np.uint8)
    return points, np.concatenate([first, second]), uv, texture


def report(name, call, count=15):
    """Print the medians of wall-clock time and of CPU time over all threads."""
    for _ in range(3):
        call()
    walls, processors = [], []
    for _ in range(count):
        wall, processor = time.perf_counter(), time.process_time()
        call()
        walls.append(1e3 * (time.perf_counter() - wall))
        processors.append(1e3 * (time.process_time() - processor))
    wall, processor = sorted(walls)[count // 2], sorted(processors)[count // 2]
    print(f"{name:50} {wall:9.2f} ms, {processor:9.2f} ms of CPU time", flush=True)


def time_alberti():
    begin = time.perf_counter()
    import alberti

    print(f"import alberti {1e3 * (time.perf_counter() - begin):.1f} ms")
    points, faces, uv, texture = sphere()
    model = alberti.Model.from_arrays(points, faces, normals=points, uv=uv, texture=texture)
    camera = alberti.Camera.look_at((0, 1, 3), (0, 0, 0), fov_y=45)
    print(model.triangle_count, "triangles")
    for passes in (("rgb", "depth", "ids"), ("rgb",), ("depth", "ids")):

        def render():
            frame = alberti.render(model, camera=camera, size=SIZE, passes=passes, threads=1)
            return frame.rgb if "rgb" in passes else frame.depth

        report(f"alberti {' '.join(passes)} {SIZE[0]} x {SIZE[1]}, one thread", render)
    cameras = [alberti.Camera.frame((1, 0.3, number / 20 - 2.5)) for number in range(100)]
    passes = ("rgb", "depth", "ids")
    jobs = [{"model": model, "camera": c, "size": (256, 256), "passes": passes} for c in cameras]
    report(
        "alberti 100 views 256 x 256, two threads", lambda: alberti.render_many(jobs, threads=2), 5
    )


def time_pyrender():
    os.environ["PYOPENGL_PLATFORM"] = "osmesa"
    import numpy as np

    np.infty = np.inf
    import pyrender
    import trimesh
    from PIL import Image

    points, faces, uv, texture = sphere()
    material = trimesh.visual.material.PBRMaterial(
        baseColorTexture=Image.fromarray(texture), metallicFactor=0.0
    )
    visual = trimesh.visual.TextureVisuals(uv=uv, material=material)
    mesh = trimesh.Trimesh(points, faces, vertex_normals=points, visual=visual, process=False)
    scene = pyrender.Scene(ambient_light=[0.3] * 3)
    node = scene.add(pyrender.Mesh.from_trimesh(mesh))
    pose = np.eye(4)
    pose[2, 3] = 3
    scene.add(pyrender.PerspectiveCamera(np.pi / 4), pose=pose)
    scene.add(pyrender.DirectionalLight(intensity=3), pose=pose)
    renderer = pyrender.OffscreenRenderer(*SIZE)
    flags = pyrender.RenderFlags

    def render():
        color, depth = renderer.render(scene)
        ids, _ = renderer.render(scene, flags=flags.SEG, seg_node_map={node: (1, 2, 3)})
        return color, depth, ids

    report(f"pyrender (OSMesa) color, depth, ids {SIZE[0]} x {SIZE[1]}", render, 7)


def time_vtk():
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

    points, faces, uv, texture = sphere()
    import numpy as np

    data = vtk.vtkPolyData()
    places = vtk.vtkPoints()
    places.SetData(numpy_to_vtk(points.copy(), deep=True))
    cells = vtk.vtkCellArray()
    flat = np.insert(faces, 0, 3, axis=1).ravel().astype(np.int64)
    ids = vtk.util.numpy_support.numpy_to_vtkIdTypeArray(flat, deep=True)
    cells.SetCells(len(faces), ids)
    data.SetPoints(places)
    data.SetPolys(cells)
    data.GetPointData().SetNormals(numpy_to_vtk(points.copy(), deep=True))
    data.GetPointData().SetTCoords(numpy_to_vtk(uv.copy(), deep=True))
    image = vtk.vtkImageData()
    image.SetDimensions(1024, 1024, 1)
    image.GetPointData().SetScalars(numpy_to_vtk(texture.reshape(-1, 3), deep=True))
    map_of = vtk.vtkTexture()
    map_of.SetInputData(image)
    map_of.InterpolateOn()
    map_of.MipmapOn()
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.SetTexture(map_of)
    renderer = vtk.vtkRenderer()
    renderer.AddActor(actor)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetSize(*SIZE)
    window.SetMultiSamples(4)
    window.AddRenderer(renderer)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(0, 1, 3)
    camera.SetViewAngle(45)
    renderer.ResetCameraClippingRange()
    width, height = SIZE

    def render():
        camera.Azimuth(0.001)
        window.Render()
        color, depth = vtk.vtkUnsignedCharArray(), vtk.vtkFloatArray()
        window.GetRGBACharPixelData(0, 0, width - 1, height - 1, 1, color)
        window.GetZbufferData(0, 0, width - 1, height - 1, depth)
        return vtk_to_numpy(color), vtk_to_numpy(depth)

    print("VTK", vtk.VTK_VERSION, window.GetClassName())
    report(f"VTK color, depth (no ids) {SIZE[0]} x {SIZE[1]}", render, 7)


def main():
    known = {"alberti": time_alberti, "pyrender": time_pyrender, "vtk": time_vtk}
    if len(sys.argv) == 3 and sys.argv[1] == "only":
        known[sys.argv[2]]()
        return
    for name in sys.argv[1:] or known:
        # Without this, several Mesa threads would be compared with a single thread of Alberti.
        environment = {**os.environ, "LP_NUM_THREADS": "0"}
        command = [sys.executable, __file__, "only", name]
        done = subprocess.run(command, capture_output=True, text=True, env=environment)
        print(done.stdout, end="")
        if done.returncode:
            last = (done.stderr.strip().splitlines() or ["no message"])[-1]
            print(f"{name} cannot be measured: {last}")


if __name__ == "__main__":
    main()

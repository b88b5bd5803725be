"""Check the program's DXF files with ezdxf: check.py PROGRAM FOLDER INPUT…

Every INPUT, which is a scene, a model or a folder of them, is drawn as DXF. The ezdxf audit must find nothing, and the total line
length on each layer must match the SVG to 1e-6 mm. Models are also drawn as sheets. Then parts with known cross sections are cut: their
outlines must be closed and simple, and have the area of the section. Files are written to FOLDER. Prints a line `FAILED …` for each error;
the last line has the counts.
"""

import math
import pathlib
import re
import subprocess
import sys

import ezdxf

PROGRAM, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])
# The time limit for one drawing, in seconds.
PATIENCE = 120
TOO_LONG = f"it took more than {PATIENCE} seconds"
# Larger drawings are skipped.
MOST_SVG_BYTES = 2_000_000
# The extensions of models in folders, and their maximum size.
MODELS, MOST_BYTES = {".glb", ".gltf", ".stl", ".obj", ".ply", ".3mf"}, 12_000_000
checked, failures = 0, 0


def report(case, faults):
    """Count a case and print its errors."""
    global checked, failures
    checked += 1
    failures += bool(faults)
    for fault in faults:
        print(f"FAILED {case}: {fault}", flush=True)


def run(*arguments):
    """Run the program; return its message if it fails."""
    try:
        done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=PATIENCE)
    except subprocess.TimeoutExpired:
        return TOO_LONG
    return done.stderr.strip() if done.returncode else None


def audit(path):
    """Return the document in a file, and the findings of the audit."""
    document = ezdxf.readfile(path)
    auditor = document.audit()
    return document, [f"{entry.code}: {entry.message}" for entry in auditor.errors + auditor.fixes]


def lengths_of_dxf(document):
    """Return the length of the lines on each layer, not counting the objects; None for layers that contain more than lines."""
    lengths = {}
    for entity in document.modelspace():
        layer = entity.dxf.layer.split(".")[0]
        if entity.dxftype() == "LINE":
            length = entity.dxf.start.distance(entity.dxf.end)
        elif entity.dxftype() == "LWPOLYLINE":
            points = [(x, y) for x, y in entity.get_points("xy")]
            points += points[:1] if entity.closed else []
            length = sum(math.dist(a, b) for a, b in zip(points, points[1:]))
        else:
            length = math.nan
        lengths[layer] = lengths.get(layer, 0.0) + length
    return lengths


NUMBER = re.compile(r"-?(?:\d+\.?\d*|\.\d+)")


def length_of_path(data):
    """Return the length of a path that consists of M, m, l, h, v and z."""
    total, at, start = 0.0, [0, 0], [0, 0]
    for command, text in re.findall(r"([Mmlhvz])([^Mmlhvz]*)", data):
        # In thousandths, so that sums are exact.
        numbers = [round(float(number) * 1000) for number in NUMBER.findall(text)]
        if command in "hv":
            for number in numbers:
                at[command == "v"] += number
                total += abs(number)
        elif command == "z":
            total += math.dist(at, start)
            at = list(start)
        else:
            for x, y in zip(numbers[::2], numbers[1::2]):
                to = [x, y] if command == "M" else [at[0] + x, at[1] + y]
                if command == "l":
                    total += math.dist(at, to)
                at = to
            if command in "Mm":
                start = list(at)
    return total / 1000


def lengths_of_svg(text):
    """Return the length of the lines on each layer, by layer id."""
    lengths = {}
    for part in re.split(r"^(?=<g id=\"[^\".]*\" fill)", text, flags=re.MULTILINE)[1:]:
        layer = re.match(r"<g id=\"([^\"]*)\"", part)[1]
        paths = re.findall(r"<path d=\"([^\"]*)\"(?! fill)", part)
        lengths[layer] = sum(map(length_of_path, paths))
    return lengths


def compare_lengths(document, svg):
    """Return the differences between the lengths on paper; coordinates may use units other than the page's."""
    ours, theirs = lengths_of_dxf(document), lengths_of_svg(svg)
    lines = [layer for layer, length in theirs.items() if length > 0]
    missing = [layer for layer in lines if layer not in ours]
    faults = [f"layer {layer} is missing" for layer in missing]
    plain = [layer for layer in lines if layer in ours and not math.isnan(ours[layer])]
    whole = sum(theirs[layer] for layer in plain)
    unit = sum(ours[layer] for layer in plain) / whole if whole else 1.0
    for layer in plain:
        difference = ours[layer] / unit - theirs[layer]
        # Sums of many lengths have an error of a few bits.
        if abs(difference) > 1e-6 + 1e-12 * whole:
            faults.append(f"layer {layer} differs by {difference} mm from {theirs[layer]}")
    return faults


def check_drawing(name, command, *flags):
    """Check one drawing: the audit with and without arcs, and the lengths without arcs."""
    path = FOLDER / f"{name}.dxf"
    fault = run(*command, *flags, "-o", path.with_suffix(".svg"))
    if fault == TOO_LONG:
        print(f"skipped: {name}: {fault}")
        return []
    if fault:
        return [fault]
    if path.with_suffix(".svg").stat().st_size > MOST_SVG_BYTES:
        print(f"skipped: {name}, which would take ezdxf minutes")
        return []
    for tolerance in ([], ["--arc-tolerance", "0"]):
        fault = run(*command, *flags, "-o", path, *tolerance)
        if fault:
            return [fault]
        document, faults = audit(path)
        if faults:
            return faults
    return compare_lengths(document, path.with_suffix(".svg").read_text("utf-8"))


# Parts: 10 mm prisms whose cross section consists of polygons, some of them with a hole that has the same number of corners.


def regular(count, radius, turn=0.0, center=(0.0, 0.0)):
    angles = [math.tau * (k / count + turn) for k in range(count)]
    return [(center[0] + radius * math.cos(a), center[1] + radius * math.sin(a)) for a in angles]


def alternating(count, inner, outer):
    return [(r * math.cos(a), r * math.sin(a)) for k in range(count) for r, a in [((inner, outer)[k % 2], math.tau * k / count)]]


def square_like(count, half, center):
    """Return a square with as many points as a circle, each in the direction of one of the circle's points."""
    scale = [half / max(abs(x), abs(y)) for x, y in regular(count, 1.0)]
    return [(center[0] + s * x, center[1] + s * y) for s, (x, y) in zip(scale, regular(count, 1.0))]


CELLS = [(20.0 * x, 20.0 * y) for x in range(3) for y in range(2)]
PARTS = {
    "nut": [(regular(6, 12.0), regular(6, 6.0))],
    "ring": [(regular(48, 30.0), regular(48, 21.0))],
    "square": [([(0, 0), (40, 0), (40, 40), (0, 40)], None)],
    "l_profile": [([(0, 0), (60, 0), (60, 8), (8, 8), (8, 50), (0, 50)], None)],
    "t_profile": [([(-4, 0), (4, 0), (4, 40), (30, 40), (30, 48), (-30, 48), (-30, 40), (-4, 40)], None)],
    "star": [(alternating(10, 12.0, 31.0), None)],
    "gear": [(alternating(40, 27.0, 30.0), regular(40, 8.0))],
    "slot": [(regular(48, 9.0)[:1] + [(20 + x, y) if x > -1e-9 else (x - 20, y) for x, y in regular(48, 9.0)[1:]], None)],
    "plate": [(square_like(32, 10.0, cell), regular(32, 6.0, center=cell)) for cell in CELLS],
    "two": [(regular(24, 10.0, center=(-15, 0)), None), (regular(5, 10.0, center=(15, 0)), regular(5, 4.0, center=(15, 0)))],
}


def doubled_area(points):
    return sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(points, points[1:] + points[:1]))


def write_part(path, regions):
    """Return a prism as OBJ."""
    lines, count = [], 0
    for outer, hole in regions:
        n = len(outer)
        for loop in [outer, hole] if hole else [outer]:
            for z in (0, 10):
                lines += [f"v {x!r} {y!r} {z}" for x, y in loop]
        ring = lambda start: [count + start + k % n + 1 for k in range(n + 1)]
        low, high = ring(0), ring(n)
        faces = [(low[k], low[k + 1], high[k + 1], high[k]) for k in range(n)]
        if hole:
            inner_low, inner_high = ring(2 * n), ring(3 * n)
            faces += [(inner_low[k + 1], inner_low[k], inner_high[k], inner_high[k + 1]) for k in range(n)]
            faces += [(high[k], high[k + 1], inner_high[k + 1], inner_high[k]) for k in range(n)]
            faces += [(low[k + 1], low[k], inner_low[k], inner_low[k + 1]) for k in range(n)]
        else:
            faces += [tuple(high[:n]), tuple(reversed(low[:n]))]
        lines += ["f " + " ".join(map(str, face)) for face in faces]
        count += n * (4 if hole else 2)
    path.write_text("\n".join(lines) + "\n")


def crosses(a, b, c, d):
    """Return whether two sides intersect in the interior of both."""
    side = lambda p, q, r: (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
    return side(a, b, c) * side(a, b, d) < 0 and side(c, d, a) * side(c, d, b) < 0


def check_outline(name, regions, *flags):
    """Check that the outline of a part is closed and simple, and has the area and position of the section."""
    part, path = FOLDER / f"{name}.obj", FOLDER / f"{name}_outline.dxf"
    write_part(part, regions)
    # The page grid is one micrometer, so a larger page has finer steps relative to the part.
    view = ["--unit", "mm", "--view", "front", "--projection", "orthographic", "--style", "outline", "--size", "4800x3600"]
    fault = run("render", part, *view, *flags, "-o", path, "--arc-tolerance", "0")
    if fault:
        return [fault]
    document, faults = audit(path)
    if document.header["$INSUNITS"] != 4:
        faults.append("the unit is not the millimeter")
    loops = []
    for entity in document.modelspace():
        if entity.dxftype() != "LWPOLYLINE" or not entity.closed:
            faults.append(f"a {entity.dxftype()} that is not a closed polyline")
            continue
        loops.append([(x, y) for x, y in entity.get_points("xy")])
    sides = [(points[k - 1], points[k]) for points in loops for k in range(len(points))]
    pairs = ((one, other) for at, one in enumerate(sides) for other in sides[:at])
    if any(crosses(*one, *other) for one, other in pairs):
        faults.append("its sides cross")
    if len({frozenset(side) for side in sides}) != len(sides):
        faults.append("a side is duplicated")
    # Loops around material and around holes run in opposite directions.
    area = abs(sum(map(doubled_area, loops))) / 2
    expected = sum(doubled_area(outer) - (doubled_area(hole) if hole else 0) for outer, hole in regions) / 2
    if abs(area - expected) > 1e-5 * expected:
        faults.append(f"its area is {area}, not {expected}")
    flat = [point for points in loops for point in points]
    all_points = [point for outer, _ in regions for point in outer]
    for extreme in (min, max):
        for axis in (0, 1):
            ours, theirs = extreme(p[axis] for p in flat), extreme(p[axis] for p in all_points)
            if abs(ours - theirs) > 1e-3:
                faults.append(f"it extends to {ours}, not to {theirs}")
    return faults


def check_circles():
    """Check that the holes in a plate are circles of the right size, and that its outline stays straight."""
    path = FOLDER / "plate_circles.dxf"
    view = ["--unit", "mm", "--view", "front", "--projection", "orthographic", "--style", "outline"]
    fault = run("render", FOLDER / "plate.obj", *view, "-o", path)
    if fault:
        return [fault]
    entities = list(audit(path)[0].modelspace())
    circles = [entity.dxf for entity in entities if entity.dxftype() == "CIRCLE"]
    centers = sorted((round(circle.center.x), round(circle.center.y)) for circle in circles)
    faults = [] if centers == sorted(CELLS) else [f"circles at {centers}"]
    faults += [f"a radius of {circle.radius}" for circle in circles if abs(circle.radius - 6) > 1e-3]
    straight = [entity for entity in entities if entity.dxftype() == "LWPOLYLINE"]
    if len(straight) != 1 or any(bulge for *_, bulge in straight[0].get_points("xyb")):
        faults.append("the outline is not one polyline of straight sides")
    return faults


def inputs(path):
    """Return a file itself, the scenes in a folder, or, if the folder has no scenes, all models below it."""
    if path.is_file():
        return [path]
    scenes = sorted(path.glob("*.ron"))
    models = (file for file in path.rglob("*") if file.suffix in MODELS and file.stat().st_size <= MOST_BYTES)
    return scenes or sorted(models)


FOLDER.mkdir(parents=True, exist_ok=True)
items = [item for argument in sys.argv[3:] for item in inputs(pathlib.Path(argument))]
for number, item in enumerate(items):
    name = f"{number}_{item.stem}"
    # Some models are broken or empty; other tests cover those.
    if item.suffix != ".ron" and run("render", item, "--size", "16x16", "-o", FOLDER / f"{name}.png"):
        print(f"skipped: {item}")
        continue
    # Copies of a model may exceed the limits that follow from its size.
    render = ["render", item, "--no-line-limits"]
    report(item, check_drawing(name, render))
    if item.suffix != ".ron":
        technical = ["--style", "technical", "--projection", "isometric"]
        report(f"{item} isometric", check_drawing(f"{name}_isometric", render, *technical))
        report(f"{item} sheet", check_drawing(f"{name}_sheet", ["sheet", item]))
for name, regions in PARTS.items():
    report(f"{name} section", check_outline(name, regions, "--section", "z=4"))
    report(f"{name} outline", check_outline(name, regions))
report("plate circles", check_circles())
print(f"dxf: {checked - failures} passed, {failures} failed")
sys.exit(1 if failures else 0)

"""Scenes in the languages of octrace and POV-Ray, and as fidget's runner reads them."""

from __future__ import annotations

from collections.abc import Iterator

from .digest import listing
from .scenes import Camera, Material, Scene
from .solids import Below, Box, Combined, Copy, Cylinder, Node, Sphere, Vec, bounds, difference

# ---- octrace


def oct(scene: Scene) -> str:
    """An .oct file. Its colours are sRGB encoded; its diffuse coefficient is the whole one."""
    camera = scene.camera
    lines = [
        f"camera(eye={vector(camera.eye)}, at={vector(camera.at)}, fov={camera.up_deg!r});",
        "ambient(1);",
        f"background({vector(map(srgb, scene.background))});",
    ]
    lines += [f"light(position={vector(at)}, intensity={intensity!r});" for at, intensity in scene.lights]
    for material, node in scene.parts:
        m = material
        lines.append(
            f"material(color={vector(map(srgb, m.color))}, ka={m.ambient!r}, kd={m.diffuse * (1.0 - m.transmit)!r},"
            f" ks={m.specular!r}, shininess={m.shininess!r}, kr={m.reflect!r}, kt={m.transmit!r}, ior={m.ior!r}, tint=0)"
        )
        lines.append(oct_node(node, {}))
    return "\n".join(lines) + "\n"


def oct_node(node: Node, written: dict[int, str]) -> str:
    """The node; what is copied many times is written in words only once, and pasted."""
    match node:
        case Combined(op, children):
            return f"{op}() {{\n" + "\n".join(oct_node(child, written) for child in children) + "\n}"
        case Copy(child, offset):
            if id(child) not in written:
                written[id(child)] = oct_node(child, written)
            return f"translate({vector(offset)}) {written[id(child)]}"
        case Sphere(center, radius):
            return f"translate({vector(center)}) sphere({radius!r});"
        case Box(low, high):
            return f"translate({vector(low)}) cube({vector(b - a for a, b in zip(low, high))});"
        case Cylinder(axis, low, length, radius):
            turn = ("rotate([0, 90, 0]) ", "rotate([-90, 0, 0]) ", "")[axis]
            return f"translate({vector(low)}) {turn}cylinder(h={length!r}, r={radius!r});"
        case Below(height):
            return f"translate([0, 0, {height!r}]) mirror([0, 0, 1]) halfspace();"


def vector(values) -> str:
    return "[" + ", ".join(repr(float(value)) for value in values) + "]"


def srgb(linear: float) -> float:
    return 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1.0 / 2.4) - 0.055


# ---- fidget


def fidget(scene: Scene, near: float, far: float) -> str:
    """The camera's frame and depths ahead of everything that is seen, and the listing."""
    right, up, ahead = scene.camera.frame()
    frame = " ".join(repr(c) for v in (scene.camera.eye, right, up, ahead) for c in v)
    return f"{frame}\n{near!r} {far!r}\n{listing(scene)}"


# ---- POV-Ray

# From this line on a file is solids.
SOLIDS = "// solids"


def pov(scene: Scene) -> str:
    """The scene as one writes it."""
    return "\n".join(pov_head(scene) + pov_lights(scene) + list(pov_parts(scene))) + "\n"


def pov_cells(scene: Scene) -> str | None:
    """The scene with its difference cut into cells by hand, if it is a box minus many things: each cell is a small
    difference, and POV-Ray's own hierarchy of bounds finds the cells. Right for what is opaque."""
    cut = [(material, cells(node)) for material, node in scene.parts if is_cut(node)]
    if len(cut) != len(scene.parts):
        return None
    objects = [pov_node(node, pov_material(material)) for material, nodes in cut for node in nodes]
    return "\n".join([*pov_head(scene), *pov_lights(scene), SOLIDS, *objects]) + "\n"


def pov_normals(scene: Scene, text: str) -> str:
    """The same solids, white, under a red light from the right, a green one from above and a blue one from the viewer, all
    far away: what is seen is the normal, as far as it is positive."""
    head, solids = pov_head(scene, background=(0.0, 0.0, 0.0)), text.split(SOLIDS + "\n")[1]
    right, up, ahead = (unit(v) for v in scene.camera.frame())
    far = 1e6
    for toward, color in ((right, "<1,0,0>"), (up, "<0,1,0>"), (tuple(-c for c in ahead), "<0,0,1>")):
        place = tuple(a + far * c for a, c in zip(scene.camera.at, toward))
        head.append(f"light_source {{ {angled(place)}, rgb {color} parallel point_at {angled(scene.camera.at)} }}")
    white = "pigment { color rgb 1 } finish { ambient 0 diffuse 1 }"
    return "\n".join(head) + "\n" + "\n".join(white_of(line, white) for line in solids.splitlines()) + "\n"


def white_of(line: str, white: str) -> str:
    start = line.find("texture {")
    return line if start < 0 else line[:start] + "texture { " + white + " } }"


def unit(v: Vec) -> Vec:
    length = sum(c * c for c in v) ** 0.5
    return tuple(c / length for c in v)


def pov_head(scene: Scene, background: Vec | None = None) -> list[str]:
    camera: Camera = scene.camera
    return [
        "#version 3.7;",
        f"global_settings {{ assumed_gamma 1 max_trace_level {max(5, scene.max_bounces)} adc_bailout 0 }}",
        f"background {{ rgb {angled(background or scene.background)} }}",
        # Mirrored in x, POV-Ray's left-handed space is right-handed.
        f"camera {{ perspective location {angled(camera.eye)} sky z right -x*4/3 up z angle {camera.across_deg!r}"
        f" look_at {angled(camera.at)} }}",
    ]


def pov_lights(scene: Scene) -> list[str]:
    return [f"light_source {{ {angled(at)}, rgb {intensity!r} }}" for at, intensity in scene.lights]


def pov_parts(scene: Scene) -> Iterator[str]:
    """Unions at the top are written as objects of their own, as one would, so that each is bounded by itself."""
    copied: dict[int, str] = {}
    objects = []
    yield SOLIDS
    for material, node in scene.parts:
        children = node.children if isinstance(node, Combined) and node.op == "union" else (node,)
        for child in children:
            if isinstance(child, Copy) and id(child.node) not in copied:
                name = copied[id(child.node)] = f"Copied{len(copied)}"
                yield f"#declare {name} =\n{pov_node(child.node, pov_material(material))}"
            if isinstance(child, Copy):
                objects.append(f"object {{ {copied[id(child.node)]} translate {angled(child.offset)} }}")
            else:
                objects.append(pov_node(child, pov_material(material)))
    yield from objects


def pov_node(node: Node, more: str = "") -> str:
    match node:
        case Combined(op, children):
            return f"{op} {{\n" + "\n".join(pov_node(child) for child in children) + f"\n{more} }}"
        case Sphere(center, radius):
            return f"sphere {{ {angled(center)}, {radius!r} {more} }}"
        case Box(low, high):
            return f"box {{ {angled(low)}, {angled(high)} {more} }}"
        case Cylinder(_, low, _, radius):
            return f"cylinder {{ {angled(low)}, {angled(node.high)}, {radius!r} {more} }}"
        case Below(height):
            return f"plane {{ z, {height!r} {more} }}"
        case Copy(child, offset):
            return f"object {{ {pov_node(child)} translate {angled(offset)} {more} }}"


def pov_material(m: Material) -> str:
    passes = f" transmit {m.transmit!r}" if m.transmit else ""
    bends = f" interior {{ ior {m.ior!r} }}" if m.transmit else ""
    finish = f"ambient {m.ambient!r} diffuse {m.diffuse!r} phong {m.specular!r} phong_size {m.shininess!r} reflection {m.reflect!r}"
    return f"{bends} texture {{ pigment {{ color rgb {angled(m.color)}{passes} }} finish {{ {finish} }} }}"


def angled(values) -> str:
    return "<" + ",".join(repr(float(value)) for value in values) + ">"


# ---- cells, cut by hand

CELL_HOLES, CELL_DEPTH = 4, 21


def is_cut(node: Node) -> bool:
    return (
        isinstance(node, Combined)
        and node.op == "difference"
        and isinstance(node.children[0], Box)
        and len(node.children) > 16
        and all(isinstance(hole, Sphere | Box) for hole in node.children[1:])
    )


def cells(node: Combined) -> list[Node]:
    """The box cut in two, again and again across its longest side, while more than a few holes reach a cell."""
    whole, *holes = node.children
    found: list[Node] = []
    pending = [(whole.low, whole.high, holes, 0)]
    while pending:
        low, high, holes, depth = pending.pop()
        if any(swallows(hole, low, high) for hole in holes):
            continue
        holes = [hole for hole in holes if reaches(hole, low, high)]
        if len(holes) <= CELL_HOLES or depth >= CELL_DEPTH:
            found.append(difference(Box(low, high), *holes) if holes else Box(low, high))
            continue
        axis = max(range(3), key=lambda k: high[k] - low[k])
        middle = (low[axis] + high[axis]) / 2.0
        replaced = lambda p: tuple(middle if k == axis else c for k, c in enumerate(p))
        pending += [(low, replaced(high), holes, depth + 1), (replaced(low), high, holes, depth + 1)]
    return found


def reaches(hole: Node, low: Vec, high: Vec) -> bool:
    if isinstance(hole, Sphere):
        return sum(max(a - c, 0.0, c - b) ** 2 for c, a, b in zip(hole.center, low, high)) < hole.radius**2
    a, b = bounds(hole)
    return all(a[k] < high[k] and low[k] < b[k] for k in range(3))


def swallows(hole: Node, low: Vec, high: Vec) -> bool:
    if isinstance(hole, Sphere):
        far = sum(max(c - a, b - c) ** 2 for c, a, b in zip(hole.center, low, high))
        return far <= hole.radius**2
    a, b = bounds(hole)
    return all(a[k] <= low[k] and high[k] <= b[k] for k in range(3))

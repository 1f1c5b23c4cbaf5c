"""One number for everything in a scene, so that a test of octrace's can tell that its own scenes are these."""

from __future__ import annotations

from .scenes import Material, Scene
from .solids import Below, Box, Combined, Copy, Cylinder, Node, Sphere, moved, union


def listing(scene: Scene) -> str:
    """The scene in words, one line for each thing in it; copies are written out."""
    camera = scene.camera
    lines = [f"camera {numbers(*camera.eye, *camera.at, camera.up_deg)}"]
    lines += [f"light {numbers(*at, intensity)}" for at, intensity in scene.lights]
    lines.append(f"background {numbers(*scene.background)}")
    nodes = [Painted(material, node) for material, node in scene.parts]
    top = nodes[0] if len(nodes) == 1 else union(*nodes)
    # Without recursion on what may be deep: a stack.
    pending: list[Node | Painted] = [top]
    while pending:
        node = pending.pop()
        match node:
            case Painted():
                lines.append(f"material {node.words()}")
                pending.append(node.node)
            case Combined(op, children):
                lines.append(f"{op} {len(children)}")
                pending += reversed(children)
            case Copy(child, offset):
                pending.append(moved(child, offset))
            case Sphere(center, radius):
                lines.append(f"sphere {numbers(*center, radius)}")
            case Box(low, high):
                lines.append(f"box {numbers(*low, *high)}")
            case Cylinder(_, low, _, radius):
                lines.append(f"cylinder {numbers(*low, *node.high, radius)}")
            case Below(height):
                lines.append(f"below {numbers(height)}")
    return "".join(line + "\n" for line in lines)


class Painted:
    """A part: a material, and the node that is made of it."""

    def __init__(self, material: Material, node: Node):
        self.material, self.node = material, node

    def words(self) -> str:
        m = self.material
        # Of light that is scattered a clear surface keeps what does not pass, as POV-Ray has it.
        diffuse = m.diffuse * (1.0 - m.transmit)
        return numbers(*m.color, m.ambient, diffuse, m.specular, m.shininess, m.reflect, m.transmit, m.ior)


def numbers(*values: float) -> str:
    # Nine decimals: what differs by rounding is the same. There is no -0.
    return " ".join(f"{round(value, 9) + 0.0:.9f}" for value in values)


def digest(scene: Scene) -> str:
    """FNV-1a of the listing, 64 bits, in hexadecimal."""
    value = 0xCBF29CE484222325
    for byte in listing(scene).encode():
        value = (value ^ byte) * 0x100000001B3 & 0xFFFFFFFFFFFFFFFF
    return f"{value:016x}"

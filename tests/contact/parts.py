"""What a random scene consists of, and the files it is written as."""

import math
import pathlib
import random
from dataclasses import dataclass, field

import meshes
import numpy as np

# Law, density, Young's modulus, Poisson's ratio.
MATERIALS = {
    "gel": ("neo_hookean", 1000.0, 2e4, 0.4),
    "rubber": ("neo_hookean", 1100.0, 1e6, 0.45),
    "soft": ("elastic", 1000.0, 1e6, 0.3),
    "hard": ("elastic", 2000.0, 2e8, 0.3),
    "steel": ("elastic", 7800.0, 2e11, 0.3),
}
# Steps that a scene may need, about: stiffer materials are replaced by others.
STEPS = 2500
FRAMES = (12, 60)


def wave(material):
    _, density, young, _ = MATERIALS[material]
    return math.sqrt(young / density)


@dataclass
class Part:
    name: str
    material: str
    mesh: meshes.Mesh | None
    velocity: tuple = (0.0, 0.0, 0.0)
    shape: str = ""
    rigid: bool = False
    height: float = 0.0


@dataclass
class Scene:
    """Parts and what they meet; `thickness` is that of the thinnest body, `travel` how far bodies are to move against each other."""

    family: str
    seed: int
    parts: list = field(default_factory=list)
    obstacles: list = field(default_factory=list)
    gravity: float = 0.0
    friction: float = 0.0
    speed: float = 1.0
    travel: float = 1.0
    thickness: float = 1.0
    search: str = ""
    is_plane: bool = False
    # What else is in the model file, and other files by their names.
    more: list = field(default_factory=list)
    extra: dict = field(default_factory=dict)
    # Whether bodies meet obstacles only.
    is_alone: bool = False

    def name(self):
        return f"{self.family}-{self.seed}"

    def end(self):
        return self.travel / self.speed

    def turned(self, rotation):
        """The whole scene turned about the origin; only without obstacles and gravity."""
        for part in self.parts:
            part.mesh = part.mesh.moved(rotation)
            part.velocity = tuple((rotation @ np.asarray(part.velocity)).tolist())
        return self

    def cells(self):
        return sum(len(part.mesh.cells) for part in self.parts if part.mesh is not None)

    def softened(self):
        """Stiff materials replaced by softer ones until the steps are few enough; a stiff body may be rigid instead."""
        for part in self.parts:
            height = part.height or part.mesh.shortest()
            while (
                not part.rigid
                and self.end() * 1.2 * wave(part.material) / (0.6 * height) > STEPS
                and part.material in ("steel", "hard")
            ):
                part.material = "hard" if part.material == "steel" else "rubber"
        return self

    def files(self):
        """The text of each file of the scene."""
        numbers = self.vector
        lines = [f"run.end = {float(self.end())!r}"]
        for material in sorted({part.material for part in self.parts}):
            law, density, young, poisson = MATERIALS[material]
            lines.append(f'material.{material} = {{ law = "{law}", density = {density}, young = {young}, poisson = {poisson} }}')
        lines.append("part = [")
        for part in self.parts:
            shape = part.shape
            if not shape:
                tetrahedron = "tet10" if len(lines) % 2 else "tet4"
                kind = {4: tetrahedron, 6: "wedge6", 8: "hex8"}[max(len(cell) for cell in part.mesh.cells)]
                shape = f'element = "{kind}", mesh = {{ file = "bodies.msh", group = "{part.name}" }}'
            rigid = ", rigid = true" if part.rigid else ""
            lines.append(
                f'  {{ name = "{part.name}", material = "{part.material}", {shape}, velocity = {numbers(part.velocity)}{rigid} }},'
            )
        lines.append("]")
        more = (f", friction = {self.friction!r}" if self.friction else "") + (
            f', search = "{self.search}"' if self.search else ""
        )
        if not self.is_alone:
            lines.append(f'contact = [{{ bodies = "all"{more} }}]')
        if self.obstacles:
            lines += ["obstacle = [", *(f"  {obstacle}," for obstacle in self.obstacles), "]"]
        if self.gravity:
            down = (0.0, -self.gravity) if self.is_plane else (0.0, 0.0, -self.gravity)
            lines.append(f"load = [{{ gravity = {numbers(down)} }}]")
        frames = min(FRAMES[1], max(FRAMES[0], math.ceil(self.travel / (0.5 * self.thickness))))
        lines += self.more
        lines += [f"output.fields = {frames}", "output.history = 50", "output.pictures = false", ""]
        files = {"model.toml": "\n".join(lines), **self.extra}
        bodies = {part.name: part.mesh for part in self.parts if part.mesh is not None}
        if bodies:
            files["bodies.msh"] = meshes.gmsh(bodies)
        return files

    def vector(self, values):
        return "[" + ", ".join(repr(float(x)) for x in values[: 2 if self.is_plane else 3]) + "]"

    def write(self, folder):
        folder = pathlib.Path(folder) / self.name()
        folder.mkdir(parents=True, exist_ok=True)
        for name, text in self.files().items():
            (folder / name).write_text(text, encoding="utf-8")
        return folder


class Dice(random.Random):
    def order(self, low, high):
        """Between two positive numbers, each order of magnitude as often."""
        return math.exp(self.uniform(math.log(low), math.log(high)))

    def kind(self):
        return self.choice(["hex", "hex", "tet", "tet", "wedge", "mixed"])

    def soft(self):
        return self.choice(["gel", "rubber", "rubber", "soft"])

    def speed(self, *materials):
        return self.order(0.1, 2.0) * min(wave(material) for material in materials)

#!/usr/bin/env python3
"""Writes the mesh of the tools, a quarter of punch, die and holder in mm: python tools.py > tools.msh

z is upwards, the punch goes down; a gap of 5 um is left to the blank, 0.81 mm thick around z = 0.
"""

import math

GAP = 0.41
AROUND_LINE, AROUND_CORNER, EDGE = 6, 8, 8


def outline(half, radius):
    """From (half, 0) around the corner to (0, half): places, and directions outward."""
    c = half - radius
    line = [((half, c * i / AROUND_LINE), (1.0, 0.0)) for i in range(AROUND_LINE)]
    angles = [math.pi / 2 * i / AROUND_CORNER for i in range(AROUND_CORNER + 1)]
    corner = [((c + radius * math.cos(a), c + radius * math.sin(a)), (math.cos(a), math.sin(a))) for a in angles]
    return line + corner + [((c * (1 - i / AROUND_LINE), half), (0.0, 1.0)) for i in range(1, AROUND_LINE + 1)]


def sweep(places, profile):
    """A row of nodes for each (way outward, z) of the profile."""
    return [[(x + way * n, y + way * m, z) for (x, y), (n, m) in places] for way, z in profile]


def round_edge():
    return [math.pi / 2 * i / EDGE for i in range(EDGE + 1)]


def bottom(row):
    """Rows of nodes between half of a closed row and the axes."""
    n = (len(row) - 1) // 2
    right, top = row[: n + 1], row[n:][::-1]
    rows = []
    for j in range(n + 1):
        v, rows = j / n, [*rows, []]
        for i in range(n + 1):
            u = i / n
            place = []
            for d in (0, 1):
                left, low = (0.0, right[0][0] * u) if d == 0 else (top[0][1] * v, 0.0)
                flat = [0.0, u * (1 - v) * right[0][d], (1 - u) * v * top[0][d], u * v * right[n][d]]
                place.append((1 - u) * left + u * right[j][d] + (1 - v) * low + v * top[i][d] - sum(flat))
            rows[-1].append((*place, GAP))
    return rows


def quadrilaterals(rows, turned):
    quads = [(a, b, c, d) for low, high in zip(rows, rows[1:]) for a, b, c, d in zip(low, low[1:], high[1:], high)]
    return [quad[::-1] if turned else quad for quad in quads]


def main():
    punch = sweep(
        outline(35, 10),
        [(0, GAP + 50), (0, GAP + 29)] + [(8 * math.cos(a) - 8, GAP + 8 - 8 * math.sin(a)) for a in round_edge()],
    )
    opening = outline(37, 12)
    flat = [45, 33, 22, 12]
    die = sweep(
        opening,
        [(x, -GAP) for x in flat]
        + [(5 - 5 * math.sin(a), -GAP - 5 + 5 * math.cos(a)) for a in round_edge()]
        + [(0, -GAP - 25), (0, -GAP - 50)],
    )
    holder = sweep(opening, [(x, GAP) for x in [*flat, 3]])
    groups = {
        "punch": quadrilaterals(punch, True) + quadrilaterals(bottom(punch[-1]), True),
        "die": quadrilaterals(die, False),
        "holder": quadrilaterals(holder, True),
    }
    numbers, cells = {}, []
    for group, (name, quads) in enumerate(groups.items(), 1):
        for quad in quads:
            nodes = [numbers.setdefault((name, *(round(x, 4) + 0.0 for x in place)), len(numbers) + 1) for place in quad]
            cells.append(f"{len(cells) + 1} 3 2 {group} {group} {' '.join(map(str, nodes))}")
    print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames", len(groups), sep="\n")
    print(*(f'2 {number} "{name}"' for number, name in enumerate(groups, 1)), "$EndPhysicalNames", sep="\n")
    print("$Nodes", len(numbers), *(f"{number} {x:.7g} {y:.7g} {z:.7g}" for (_, x, y, z), number in numbers.items()), sep="\n")
    print("$EndNodes", "$Elements", len(cells), *cells, "$EndElements", sep="\n")


if __name__ == "__main__":
    main()

"""A docking connector for a tool changer: flanged shell, contact insert with one chamber left out, unequal guide pins, gasket."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound, Pos, RectangleRounded, extrude

from benchmark.kit import Model
from benchmark.shapes import BACK, FRONT, assembly, block, cone, grid, named, rod

MODEL = Model("Docking connector", "held_out", bodies=5)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the flange's underside is z = 0, mating goes along z, x = y = 0 is the middle."""

    flange: tuple[float, float, float] = (124, 58, 6)
    flange_corner: float = 8
    screw: float = 4.5
    screw_dx: float = 108
    screw_dy: float = 42
    shell: tuple[float, float] = (80, 40)  # outside
    shell_corner: float = 6
    shell_top: float = 36  # over the flange's underside
    wall: float = 3
    opening: tuple[float, float] = (60, 26)  # through the flange below the insert
    insert_play: float = 0.2  # all round
    insert_top: float = 28
    columns: int = 8
    rows: int = 3
    pitch_x: float = 7.5
    pitch_y: float = 7
    chamber: float = 3.4  # through the insert
    funnel: float = 5  # mouth of the chambers at the mating side
    funnel_depth: float = 1.6
    tie: float = 3.2  # two holes for the insert's screws, on the x axis's line
    tie_dx: float = 66
    core: float = 2.5  # their core holes M3 through the flange
    lug: float = 7  # locking pegs on the shell's long sides
    lug_long: float = 5
    lug_z: float = 24
    code: tuple[float, float] = (6, 9)  # notch in the shell's rim at the side x > 0: width, depth
    pin_left: float = 6  # guide pins, pressed in flush with the flange's underside
    pin_right: float = 5
    pin_dx: float = 100
    pin_top: float = 48
    pin_tip: float = 5  # length of the conical tip
    pin_end: float = 2  # diameter at the tip's end
    gasket: tuple[float, float] = (88, 48)
    gasket_play: float = 0.3  # about the shell
    gasket_thick: float = 2


def build(p: P) -> Compound:
    """The shell with its flange, then insert, pins and gasket."""
    low = p.flange[2]
    shell = extrude(RectangleRounded(p.flange[0], p.flange[1], p.flange_corner), amount=low)
    shell += extrude(RectangleRounded(*p.shell, p.shell_corner), amount=p.shell_top)
    inner = (p.shell[0] - 2 * p.wall, p.shell[1] - 2 * p.wall)
    corner = p.shell_corner - p.wall
    shell -= Pos(0, 0, low) * extrude(RectangleRounded(*inner, corner), amount=p.shell_top)
    shell -= block((*p.opening, low))
    for x, y in grid(2, 2, p.screw_dx, p.screw_dy):
        shell -= rod(p.screw, low, (x, y, 0))
    for s, along in ((-1, FRONT), (1, BACK)):
        shell += rod(p.lug, p.lug_long, (0, s * p.shell[1] / 2, p.lug_z), along)
    width, depth = p.code
    shell -= block((4 * p.wall, width, depth), (p.shell[0] / 2, 0, p.shell_top - depth))
    insert = Pos(0, 0, low) * extrude(
        RectangleRounded(inner[0] - 2 * p.insert_play, inner[1] - 2 * p.insert_play, corner), amount=p.insert_top - low
    )
    for x, y in grid(p.columns, p.rows, p.pitch_x, p.pitch_y)[:-1]:
        insert -= rod(p.chamber, p.insert_top, (x, y, 0))
        insert -= cone(p.chamber, p.funnel, p.funnel_depth, (x, y, p.insert_top - p.funnel_depth))
    for x, y in grid(2, 1, p.tie_dx, 0):
        insert -= rod(p.tie, p.insert_top, (x, y, 0))
        shell -= rod(p.core, low, (x, y, 0))
    parts = [named(insert, "contact_insert", "ivory")]
    for s, d, name in ((-1, p.pin_left, "left"), (1, p.pin_right, "right")):
        x = s * p.pin_dx / 2
        shell -= rod(d, low, (x, 0, 0))
        pin = rod(d, p.pin_top - p.pin_tip, (x, 0, 0)) + cone(d, p.pin_end, p.pin_tip, (x, 0, p.pin_top - p.pin_tip))
        parts.append(named(pin, f"guide_pin_{name}", "silver"))
    hole = (p.shell[0] + 2 * p.gasket_play, p.shell[1] + 2 * p.gasket_play)
    ring = RectangleRounded(*p.gasket, p.shell_corner + 3) - RectangleRounded(*hole, p.shell_corner)
    parts.append(named(Pos(0, 0, low) * extrude(ring, amount=p.gasket_thick), "gasket", "black"))
    return assembly([named(shell, "shell", "gray"), *parts])

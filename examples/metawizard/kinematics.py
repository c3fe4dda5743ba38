"""Would the robot do it? Follows a program through the scene, and knows of the scene what it was built from.

Nothing that QueryCAD said is used here. Metres, the world's coordinates.
"""

from __future__ import annotations

import numpy as np

from metawizard.scene import BLOCK, BLOCK_IN_WORLD, GEAR, GEAR_IN_WORLD, Matrix
from metawizard.synthesise import OPENS, Program, Vector

MM = 1e-3
STEP = 0.5 * MM
"""Between two looks along a straight motion."""
PARALLEL = np.sin(np.radians(0.5))
ROOM_OF_BORE = (GEAR.bore - BLOCK.shaft) / 2 * MM
"""How far the two axes may be apart before the shaft touches the bore."""
PLAY = 0.2 * MM
"""By which closed fingers may miss the distance of the faces: a gripper gives way by as much."""


class Rejected(Exception):
    """The program cannot be carried out; `str()` says why."""


def check(program: Program) -> None:
    """Raises Rejected unless the gear ends up on the shaft, held where it can be held, along a free way."""
    gripper: Matrix | None = None
    gear, held, width = GEAR_IN_WORLD, None, 0.0
    for step in program:
        if step.do in ("move", "straight"):
            assert step.pose is not None
            _rigid(step.pose)
            if step.do == "straight":
                if gripper is None:
                    raise Rejected("the first motion starts nowhere")
                for between in _line(gripper, step.pose):
                    if held is not None:
                        _free(between @ held)
                    elif np.linalg.norm(between[:3, 3] - step.pose[:3, 3]) > STEP:
                        _fingers_pass(between, gear, width)
            elif held is not None:
                _far_from_shaft(step.pose @ held)
            gripper = step.pose
            gear = gripper @ held if held is not None else gear
        elif step.do == "open":
            width, held = step.width or 0.0, None
            if width > OPENS:
                raise Rejected("the gripper does not open as far")
        else:
            assert gripper is not None
            width = step.width or 0.0
            _grips(gripper, gear, width)
            held = np.linalg.inv(gripper) @ gear
    _seated(gear)


def _rigid(pose: Matrix) -> None:
    turn = pose[:3, :3]
    if not np.allclose(turn @ turn.T, np.eye(3), atol=1e-6) or np.linalg.det(turn) < 0:
        raise Rejected("a pose is no rotation and translation")


def _line(start: Matrix, end: Matrix) -> list[Matrix]:
    """Poses along a straight motion, which does not turn."""
    if not np.allclose(start[:3, :3], end[:3, :3], atol=1e-6):
        raise Rejected("a straight motion turns the gripper")
    way = end[:3, 3] - start[:3, 3]
    poses = []
    for share in np.linspace(0.0, 1.0, 2 + int(np.linalg.norm(way) / STEP)):
        pose = end.copy()
        pose[:3, 3] = start[:3, 3] + share * way
        poses.append(pose)
    return poses


def _grips(gripper: Matrix, gear: Matrix, width: float) -> None:
    """Are the closed fingers on the hub's two flats?"""
    seen = np.linalg.inv(gear) @ gripper
    if np.linalg.norm(np.cross(seen[:3, 0], [1.0, 0.0, 0.0])) > PARALLEL:
        raise Rejected("the fingers do not close across the flats of the hub")
    if abs(width - GEAR.flats * MM) > PLAY:
        raise Rejected(f"the fingers close to {width / MM:.1f} mm, and the flats are {GEAR.flats} mm apart")
    x, y, z = seen[:3, 3] / MM
    if abs(x) > PLAY / MM or abs(y) > GEAR.hub / 2 or not GEAR.rim < z < GEAR.height:
        raise Rejected("the fingers close beside the flats of the hub")


def _fingers_pass(gripper: Matrix, gear: Matrix, width: float) -> None:
    """Do the open fingers keep off the hub on their way?"""
    seen = np.linalg.inv(gear) @ gripper
    if seen[2, 3] < GEAR.height * MM and width < GEAR.flats * MM:
        raise Rejected("the fingers are too narrow to pass the hub")


def _shaft() -> tuple[Vector, Vector]:
    """Its tip, and the way down to the block."""
    tip = BLOCK_IN_WORLD @ np.array(
        [BLOCK.shaft_x * MM, BLOCK.shaft_y * MM, (BLOCK.height + BLOCK.shaft_length) * MM, 1]
    )
    return tip[:3], -BLOCK_IN_WORLD[:3, 2]


def _past_tip(gear: Matrix) -> tuple[float, float]:
    """How far is the rim past the shaft's tip, and the end of the hub?"""
    tip, way = _shaft()
    rim, hub = gear[:3, 3], gear[:3, 3] + GEAR.height * MM * gear[:3, 2]
    return float(np.dot(rim - tip, way)), float(np.dot(hub - tip, way))


def _off_axis(gear: Matrix) -> tuple[float, float]:
    """How far is the bore's axis from the shaft's, in metres, at the worse of its ends; and the sine of their angle."""
    tip, way = _shaft()
    ends = (gear[:3, 3], gear[:3, 3] + GEAR.height * MM * gear[:3, 2])
    apart = max(float(np.linalg.norm(np.cross(end - tip, way))) for end in ends)
    return apart, float(np.linalg.norm(np.cross(gear[:3, 2], way)))


def _free(gear: Matrix) -> None:
    """Is the gear, as it is carried, either off the shaft or on it without touching?"""
    past = max(_past_tip(gear))
    if past <= 0:
        return
    apart, angle = _off_axis(gear)
    reach = (GEAR.module * (GEAR.teeth + 2) + BLOCK.shaft) / 2 * MM
    if apart > reach + GEAR.height * MM:
        return
    if apart > ROOM_OF_BORE or angle > PARALLEL:
        raise Rejected(f"the shaft touches the bore: {apart / MM:.2f} mm off its axis, {np.degrees(angle):.1f} degrees")
    if past > BLOCK.shaft_length * MM + 1e-6:
        raise Rejected("the gear runs into the block")


def _far_from_shaft(gear: Matrix) -> None:
    """A motion that is not straight ends off the shaft."""
    if max(_past_tip(gear)) > 0 and _off_axis(gear)[0] < 0.2:
        raise Rejected("the gear is on the shaft before it is inserted")


def _seated(gear: Matrix) -> None:
    """Is the gear on the shaft, rim first, by at least half the rim?"""
    apart, angle = _off_axis(gear)
    rim, hub = _past_tip(gear)
    if apart > ROOM_OF_BORE or angle > PARALLEL:
        raise Rejected("the gear is not on the shaft")
    if rim < hub:
        raise Rejected("the hub is towards the block, where the fingers have no room")
    if rim < GEAR.rim * MM / 2:
        raise Rejected("the gear is not far enough on the shaft")

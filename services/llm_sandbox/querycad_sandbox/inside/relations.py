# ruff: noqa: ANN001, ANN002, ANN201, ANN202, D103 - for a reader of Python
# ruff: noqa: F821 - what the host and prelude.py define is not seen here
# mypy: ignore-errors
"""What is asked between parts and faces: run inside the sandbox behind prelude.py, for a program that names any of it.

`_noted` and `_left` are what `.ignored_words` and `.not_checked` of a list become: see rewriting.py.
"""

from math import atan2 as _atan2

_notes = []
_OUTWARD = {
    "top": (0.0, 0.0, 1.0),
    "bottom": (0.0, 0.0, -1.0),
    "left": (-1.0, 0.0, 0.0),
    "right": (1.0, 0.0, 0.0),
    "front": (0.0, -1.0, 0.0),
    "back": (0.0, 1.0, 0.0),
}
_PARALLEL = 0.0017  # radians: the tolerance of recognition, 0.1 degrees
_SHARED = 1e-12  # m3: a cube of 0.1 mm, the last digit of drawings
_DRAWING_M = 5e-5  # querycad_contracts.DRAWING_M, as close() has it


def _noted(found):
    ignored, unchecked = _words_left()
    _notes.append((found, ignored, unchecked))
    return found


def _left(found, name):
    for note in _notes:
        if note[0] is found:
            return note[1] if name == "ignored_words" else note[2]
    return _getattr(found, name)


def _axis(item):
    """Point and direction of an item's axis, of a rounded corner that of its faces; None where it has none."""
    if item.axis is not None:
        return (item.axis_point if isinstance(item, Face) else item.center), item.axis
    line = None
    for face in item.faces if isinstance(item, Part) and item.normal is None else []:
        if face.axis is None or face.axis_point is None:
            return None
        own = face.axis_point, face.axis
        if line is not None and not _same_line(own, line):
            return None
        line = own
    return line


def _same_line(one, other):
    return _long(_cross(one[1], other[1])) <= _PARALLEL and _from_line(other[0], one) <= _DRAWING_M


def _minus(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def _times(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _long(a):
    return _times(a, a) ** 0.5


def _from_line(point, line):
    return _long(_cross(_minus(point, line[0]), line[1]))


def _item(*items):
    for item in items:
        if not isinstance(item, (Part, Face)):
            raise TypeError(f"this takes parts or faces, not {type(item).__name__}")


def coaxial(a, b):
    _item(a, b)
    one, other = _axis(a), _axis(b)
    if one is None or other is None:
        return False
    return _same_line(one, other)


def offset(a, b):
    _item(a, b)
    lines, planes = [], []
    for item in (a, b):
        line = _axis(item)
        if line is not None:
            lines.append(line)
        elif item.normal is not None:
            planes.append((item.center, item.normal))
    if len(lines) == 2:
        square = _cross(lines[0][1], lines[1][1])
        if _long(square) <= _PARALLEL:
            return _from_line(lines[1][0], lines[0])
        return abs(_times(_minus(lines[1][0], lines[0][0]), square)) / _long(square)
    if len(planes) == 2 and _long(_cross(planes[0][1], planes[1][1])) <= _PARALLEL:
        return abs(_times(_minus(planes[1][0], planes[0][0]), planes[0][1]))
    if len(lines) == 1 and len(planes) == 1 and abs(_times(lines[0][1], planes[0][1])) <= _PARALLEL:
        return abs(_times(_minus(lines[0][0], planes[0][0]), planes[0][1]))
    told = "offset() takes two axes, two parallel planes, or a plane and an axis along it"
    if len(lines) + len(planes) < 2:
        raise ValueError(f"{told}; one of these has neither axis nor normal")
    of = [("axis along", *way) for _, way in lines] + [("plane square to", *way) for _, way in planes]
    given = [f"{word} ({x:.3g}, {y:.3g}, {z:.3g})" for word, x, y, z in of]
    raise ValueError(f"{told}; these are: {' and '.join(given)}")


def on(items, what):
    _item(what)
    found = []
    for item in items:
        inside = isinstance(what, Part) and item.id != what.id and item.is_in(what)
        if inside or ((isinstance(what, Face) or item.id != what.id) and adjacent(item, what)):
            found.append(item)
    return found


def around(items, center):
    _item(center)
    line = _axis(center)
    if line is None:
        raise ValueError("around() takes something with an axis")
    helper = (1.0, 0.0, 0.0) if abs(line[1][0]) < 0.7 else (0.0, 1.0, 0.0)
    across = _cross(line[1], helper)
    third = _cross(line[1], across)
    rings = []
    for item in items:
        away = _from_line(item.center, line)
        if away <= _DRAWING_M:
            continue
        for ring in rings:
            if ring[0] == item.kind and abs(ring[1] - away) <= _DRAWING_M:
                ring[2].append(item)
                break
        else:
            rings.append((item.kind, away, [item]))
    found = []
    for ring in rings:
        if len(ring[2]) >= 3:
            found += ring[2]
    angles = []
    for item in found:
        way = _minus(item.center, line[0])
        angles.append(_atan2(_times(way, third), _times(way, across)))
    return [found[i] for i in _sorted(range(len(found)), key=lambda i: angles[i])]


def between(items, a, b):
    _item(a, b)
    way = _minus(b.center, a.center)
    far = _times(way, way)
    if not far:
        raise ValueError("between() takes two whose centres differ")
    found = []
    for item in items:
        share = _times(_minus(item.center, a.center), way) / far
        inside = True
        for i in range(3):
            low = _min(a.center[i] - a.extents[i] / 2, b.center[i] - b.extents[i] / 2)
            high = _max(a.center[i] + a.extents[i] / 2, b.center[i] + b.extents[i] / 2)
            inside = inside and low - _DRAWING_M <= item.center[i] <= high + _DRAWING_M
        if inside and 0 < share < 1:
            found.append(item)
    return found


def nearest(items):
    order = sorted(items, key=lambda item: item.center)
    places = [item.center for item in order]
    found, reach = [], []
    for i in range(len(order)):  # outwards along x, until what is next lies farther off than the nearest so far
        best, far = None, None
        for step in (1, -1):
            j = i + step
            while 0 <= j < len(order) and (far is None or abs(places[j][0] - places[i][0]) < far):
                apart = _dist(places[i], places[j])
                if far is None or apart < far:
                    best, far = j, apart
                j += step
        if best is not None:
            found.append((order[i], order[best]))
            reach.append(far)
    ranks = sorted(range(len(found)), key=lambda i: reach[i])
    return [found[i] for i in ranks]


def closest(items, others=None):
    order = [(item.center, item, 0) for item in items]
    order += [(item.center, item, 1) for item in others or ()]
    order = sorted(order, key=lambda one: one[0])
    wide = _max([one[1].extents[0] for one in order], default=0.0)
    far, pairs = None, []
    for i in range(len(order)):  # boxes are as far apart as surfaces at most; these no farther than the boxes' corners
        place, a, group = order[i]
        for j in range(i + 1, len(order)):
            other, b, own = order[j]
            if far is not None and other[0] - place[0] - wide > far:
                break
            if a.id == b.id or (others is not None and group == own):
                continue
            low = high = 0.0
            for k in range(3):
                apart, both = abs(other[k] - place[k]), (a.extents[k] + b.extents[k]) / 2
                low, high = low + _max(0.0, apart - both) ** 2, high + (apart + both) ** 2
            if far is None or low**0.5 <= far:
                pairs.append((low**0.5, a, b) if group <= own else (low**0.5, b, a))
                far = high**0.5 if far is None else _min(far, high**0.5)
    best, found = None, []
    for gap, a, b in sorted(pairs, key=lambda pair: pair[0]):
        if best is not None and gap >= best:
            break
        apart = a.distance_to(b)
        if best is None or apart < best:
            best, found = apart, [a, b]
    return found


def overlaps(items, others=None):
    bodies = list(items)
    found = []
    for i in range(len(bodies)):
        for b in bodies[i + 1 :] if others is None else others:
            a = bodies[i]
            meet = a.id != b.id
            for k in range(3):
                meet = meet and abs(a.center[k] - b.center[k]) < (a.extents[k] + b.extents[k]) / 2
            if meet and a.overlap_with(b) > _SHARED:
                found.append((a, b))
    return found


def outermost(items, side=None):
    if side is not None and side not in _OUTWARD:
        raise ValueError(f"no side is called {side!r}: use {', '.join(_OUTWARD)}")
    reach = []
    for item in items:
        if side is None:
            reach.append(_dist(item.center, shape.center))
        else:
            out, half = _OUTWARD[side], [extent / 2 for extent in item.extents]
            reach.append(_times(item.center, out) + abs(_times(half, out)))
    return [item for item, far in zip(items, reach, strict=True) if far >= _max(reach) - _DRAWING_M]

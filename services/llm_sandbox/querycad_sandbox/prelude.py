# ruff: noqa: A001, ANN001, ANN002, ANN003, ANN201, ANN202, D103 - these replace builtins, for a reader of Python
# ruff: noqa: F821 - what the host defines is not seen here
# mypy: ignore-errors
"""What every program finds defined besides the host's names. Its text is run inside the sandbox, ahead of the program.

`min`, `max`, `sorted`, `map` and `filter` replace the interpreter's own, which call their function where it cannot ask
the host anything: with these, `min(parts, key=lambda p: p.edge_distance())` works as in any Python.
`next` takes the first value of a generator expression, which the interpreter makes a list.
`hasattr` and `getattr` with a default take a measure that an object does not have, which is None, for one that is not
there: programs ask so.
The helpers of the guest API that need no host are here too: a program may call them thousands of times.
`_noted` and `_left` are what `.ignored_words` and `.not_checked` of a list become: see rewriting.py.
`_parts_in` is for the host: the parts in the first layer of variables that has any, so that nothing else leaves.
"""

from math import atan2 as _atan2
from math import dist as _dist

_min, _max, _next, _sorted, _getattr = min, max, next, sorted, getattr
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
_NEAR = 5e-5  # metres: drawing accuracy, as of close()


def getattr(obj, name, /, *default):
    value = _getattr(obj, name, *default)
    return default[0] if default and value is None else value


def hasattr(obj, name, /):
    return getattr(obj, name, None) is not None


def _keys(items, key):
    keys = [key(item) for item in items]
    for one in keys:
        if one is None:  # of one item alone, nothing would be compared
            raise TypeError("a key is of type NoneType")
    return keys


def sorted(iterable, /, *, key=None, reverse=False):
    if key is None:
        return _sorted(iterable, reverse=reverse)
    items = list(iterable)
    keys = _keys(items, key)
    order = _sorted(range(len(items)), key=lambda i: keys[i], reverse=reverse)
    return [items[i] for i in order]


def _extreme(builtin, values, key, default):
    items = list(values[0]) if len(values) == 1 else list(values)
    if key is None or not items:
        return builtin(items, **default)
    keys = _keys(items, key)
    return items[builtin(range(len(items)), key=lambda i: keys[i])]


def min(*values, key=None, **default):
    return _extreme(_min, values, key, default)


def max(*values, key=None, **default):
    return _extreme(_max, values, key, default)


def map(function, /, *iterables):
    return [function(*values) for values in zip(*iterables, strict=False)]


def filter(function, iterable, /):
    return [value for value in iterable if (value if function is None else function(value))]


def next(iterator, /, *default):
    if not isinstance(iterator, list):
        return _next(iterator, *default)
    if iterator:
        return iterator.pop(0)
    if default:
        return default[0]
    raise StopIteration


def _parts_in(layers, kind, most=1000):
    for layer in layers:
        found = []
        for variable in layer:
            room, waiting = most, [(0, variable)]
            while waiting and room > 0:
                depth, value = waiting.pop()
                room -= 1
                if isinstance(value, kind):
                    found.append(value)
                elif depth < 3 and isinstance(value, (list, tuple, dict)):
                    inside = list(value.values()) if isinstance(value, dict) else value[:room]
                    waiting += [(depth + 1, item) for item in reversed(inside)]
        if found:
            return found
    return []


def distance(a, b):
    for point in (a, b):
        if not isinstance(point, (tuple, list)) or len(point) != 3:
            named = type(point).__name__
            raise TypeError(f"distance() takes two points of three numbers, such as part.center, not {named}")
    return _dist(a, b)


def different(values, tolerance=1e-6):
    kept = []
    for value in _sorted(values):
        if not kept or value - kept[-1] >= tolerance:
            kept.append(value)
    return kept


def close(a, b, tolerance=5e-5):
    return abs(a - b) <= tolerance


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
    """Point and direction of an item's axis; None where it has none."""
    if item.axis is None:
        return None
    point = item.axis_point if isinstance(item, Face) else item.center
    return point, item.axis


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
    return _long(_cross(one[1], other[1])) <= _PARALLEL and _from_line(other[0], one) <= _NEAR


def offset(a, b):
    _item(a, b)
    lines, planes = [], []
    for item in (a, b):
        line = _axis(item)
        if line is not None:
            lines.append(line)
        elif item.normal is not None:
            planes.append((item.center, item.normal))
    if len(lines) == 2 and _long(_cross(lines[0][1], lines[1][1])) <= _PARALLEL:
        return _from_line(lines[1][0], lines[0])
    if len(planes) == 2 and _long(_cross(planes[0][1], planes[1][1])) <= _PARALLEL:
        return abs(_times(_minus(planes[1][0], planes[0][0]), planes[0][1]))
    if len(lines) == 1 and len(planes) == 1 and abs(_times(lines[0][1], planes[0][1])) <= _PARALLEL:
        return abs(_times(_minus(lines[0][0], planes[0][0]), planes[0][1]))
    raise ValueError("offset() takes two that are parallel: planes, axes, or a plane and an axis along it")


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
        if away <= _NEAR:
            continue
        for ring in rings:
            if ring[0] == item.kind and abs(ring[1] - away) <= _NEAR:
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
            inside = inside and low - _NEAR <= item.center[i] <= high + _NEAR
        if inside and 0 < share < 1:
            found.append(item)
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
    return [item for item, far in zip(items, reach, strict=True) if far >= _max(reach) - _NEAR]

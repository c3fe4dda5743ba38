# ruff: noqa: A001, ANN001, ANN002, ANN003, ANN201, ANN202, D103 - these replace builtins, for a reader of Python

# mypy: ignore-errors
"""What every program finds defined besides the host's names. Its text is run inside the sandbox, ahead of the program.

`min`, `max`, `sorted`, `map` and `filter` replace the interpreter's own, which call their function where it cannot ask
the host anything: with these, `min(parts, key=lambda p: p.edge_distance())` works as in any Python.
`next` takes the first value of a generator expression, which the interpreter makes a list.
`hasattr` and `getattr` with a default take a measure that an object does not have, which is None, for one that is not
there: programs ask so.
The helpers of the guest API that need no host are here too: a program may call them thousands of times.
`_parts_in` is for the host: the parts in the first layer of variables that has any, so that nothing else leaves.
"""

from math import dist as _dist

_min, _max, _next, _sorted, _getattr = min, max, next, sorted, getattr


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
        if not kept or (value != kept[-1] if isinstance(value, str) else value - kept[-1] >= tolerance):
            kept.append(value)
    return kept


def close(a, b, tolerance=5e-5):
    return abs(a - b) <= tolerance

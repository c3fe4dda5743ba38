"""Programs that mean harm: each ends with the status stated, hands nothing out, and leaves the sandbox as it was.

Two statuses are stated where the machine decides which limit comes first.

`hidden(code)` keeps a program's text from the type check, which would refuse most of these: what the interpreter does
with them is the claim.
"""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from tests.llm_sandbox.conftest import FakeSegCad

from querycad_contracts import RunLimits, RunStatus
from querycad_sandbox import Sandbox

LIMITS = RunLimits(duration_s=0.25, memory_bytes=16 * 2**20, host_calls=500, output_bytes=1000)
OK, RAISED, REFUSED = RunStatus.OK, RunStatus.RAISED, RunStatus.REFUSED
TIMED_OUT, OUT_OF_MEMORY = RunStatus.TIMED_OUT, RunStatus.OUT_OF_MEMORY

Claim = tuple[str, RunStatus | set[RunStatus]]


def hidden(code: str) -> str:
    return f"exec({code!r})\nsolution = eval('solution')"


ESCAPES: list[Claim] = [
    (hidden("solution = ().__class__.__bases__[0].__subclasses__()"), RAISED),
    (hidden("solution = object.__subclasses__()"), RAISED),
    (hidden("solution = type.mro(int)"), RAISED),
    (hidden("solution = (lambda: 0).__code__"), RAISED),
    (hidden("solution = (lambda: 0).__globals__"), RAISED),
    (hidden("solution = find_parts.__globals__"), RAISED),
    (hidden("solution = find_parts.__self__"), RAISED),
    (hidden("solution = find_parts.__func__.__globals__"), RAISED),
    (hidden("solution = print.__self__"), RAISED),
    (hidden("solution = __builtins__"), RAISED),
    (hidden("solution = __import__('os')"), RAISED),
    (hidden("solution = globals()"), RAISED),
    (hidden("solution = vars()"), RAISED),
    (hidden("solution = dir()"), RAISED),
    (hidden("import sys\nsolution = sys.modules"), RAISED),
    (hidden("import sys\nsolution = sys._getframe()"), RAISED),
    (hidden("try:\n    1 / 0\nexcept Exception as e:\n    solution = e.__traceback__"), RAISED),
    (hidden("async def f(): pass\nsolution = f().cr_frame"), RAISED),
    (hidden("solution = (x for x in [1]).gi_frame"), RAISED),
    (hidden("solution = '{0.__class__.__mro__}'.format(1)"), RAISED),
    (hidden("solution = '{0.__globals__}'.format(find_parts)"), RAISED),
    (hidden("solution = '{0._abc}'.format(find_parts('hole')[0])"), RAISED),
    (hidden("solution = f'{find_parts.__code__}'"), RAISED),
    (hidden("solution = getattr((), '__cla' + 'ss__')"), RAISED),
    (hidden("solution = find_parts('hole')[0].__dict__"), RAISED),
    (hidden("solution = find_parts('hole')[0].__class__.__mro__"), RAISED),
    (hidden("solution = find_parts('hole')[0].evidence"), RAISED),
    (hidden("solution = find_parts('hole')[0].guest"), RAISED),
    (hidden("solution = find_parts('hole')[0].model_dump()"), RAISED),
    (hidden("solution = find_parts('hole')[0].__init__()"), RAISED),
    (hidden("solution = find_parts('hole')[0].call_method('faces', (), {})"), RAISED),
    (hidden("solution = find_parts('hole')[0]()"), RAISED),
    (hidden("solution = type(find_parts('hole')[0])(id='hole-9')"), RAISED),
    (hidden("solution = type(find_parts('hole')[0]).model_construct(id='hole-9')"), RAISED),
    (hidden("solution = shape.bodies[0].model_copy()"), RAISED),
    (hidden("solution = Part(id='hole-9')"), RAISED),
    (hidden("solution = Part.model_fields"), RAISED),
    (hidden("solution = Shape.model_validate({})"), RAISED),
    (hidden("setattr(find_parts, 'x', 1)\nsolution = 1"), RAISED),
    (hidden("class A(int):\n    pass\nsolution = 1"), RAISED),
    (hidden("class A:\n    def __del__(self): pass\nA.__bases__ = ()\nsolution = A.__subclasses__()"), RAISED),
    ("solution = breakpoint()", REFUSED),
    ("solution = compile('1', '', 'eval')", REFUSED),
]

REACHES: list[Claim] = [
    ("import subprocess\nsolution = subprocess.run(['id'])", REFUSED),
    ("import socket\nsolution = socket.socket()", REFUSED),
    ("import ctypes\nsolution = 1", REFUSED),
    ("import querycad_sandbox\nsolution = 1", REFUSED),
    ("import pydantic_monty\nsolution = 1", REFUSED),
    ("import urllib.request\nsolution = 1", REFUSED),
    (hidden("import subprocess\nsolution = 1"), RAISED),
    (hidden("import socket\nsolution = 1"), RAISED),
    (hidden("import multiprocessing\nsolution = 1"), RAISED),
    (hidden("import threading\nsolution = 1"), RAISED),
    (hidden("import importlib\nsolution = 1"), RAISED),
    (hidden("import builtins\nsolution = 1"), RAISED),
    (hidden("import gc\nsolution = 1"), RAISED),
    (hidden("import pickle\nsolution = 1"), RAISED),
    (hidden("import os\nsolution = os.system('id')"), RAISED),
    (hidden("import os\nsolution = os.popen('id')"), RAISED),
    (hidden("import os\nsolution = os.environ"), RAISED),
    (hidden("import os\nsolution = os.getenv('SECRET')"), RAISED),
    (hidden("import os\nsolution = os.listdir('/')"), RAISED),
    (hidden("import os\nsolution = os.kill(1, 9)"), RAISED),
    (hidden("import os\nsolution = os.fork()"), RAISED),
    (hidden("import os\nsolution = str(os.urandom(8))"), RAISED),
    (hidden("import os.path\nsolution = os.path.exists('/etc/passwd')"), RAISED),
    (hidden("solution = open('/etc/passwd').read()"), RAISED),
    (hidden("solution = open('/proc/self/environ').read()"), RAISED),
    (hidden("open('/tmp/written', 'w').write('x')\nsolution = 1"), RAISED),
    (hidden("with open('main.py') as f:\n    solution = f.read()"), RAISED),
    (hidden("import pathlib\nsolution = pathlib.Path('/etc/passwd').read_text()"), RAISED),
    (hidden("import pathlib\nsolution = [str(p) for p in pathlib.Path('.').iterdir()]"), RAISED),
    (hidden("import asyncio\nsolution = asyncio.open_connection('localhost', 80)"), RAISED),
    (hidden("import sys\nsolution = sys.stdin.read()"), RAISED),
    (hidden("solution = input()"), RAISED),
]

BOMBS: list[Claim] = [
    ("while True:\n    pass", TIMED_OUT),
    ("while True:\n    try:\n        while True:\n            pass\n    except BaseException: pass", TIMED_OUT),
    ("solution = sum(range(10**9))", TIMED_OUT),
    ("solution = pow(3, 10**7)", {TIMED_OUT, REFUSED}),
    ("x = [1]\nfor i in x:\n    x.append(i)", {TIMED_OUT, OUT_OF_MEMORY}),
    (hidden("def f():\n    try:\n        f()\n    finally:\n        f()\nf()"), TIMED_OUT),
    (hidden("import itertools\nsolution = list(map(str, itertools.count()))"), OUT_OF_MEMORY),
    ("import re\nsolution = str(re.match('(a*)*$', 'a' * 30 + 'b'))", OK),
    ("import time\ntime.sleep(1e9)\nsolution = 1", OK),
    ("import asyncio\nasyncio.run(asyncio.sleep(1e9))\nsolution = 1", OK),
    ("solution = len([0] * 10**9)", OUT_OF_MEMORY),
    ("solution = 'a' * 10**10", OUT_OF_MEMORY),
    ("solution = len(' ' * (1 << 60))", OUT_OF_MEMORY),
    ("solution = 9**9**9", OUT_OF_MEMORY),
    ("solution = 1 << (1 << 40)", OUT_OF_MEMORY),
    ("a = 'a'\nfor i in range(60):\n    a = a + a\nsolution = a", OUT_OF_MEMORY),
    ("x = {}\nfor i in range(10**9):\n    x[i] = i", {OUT_OF_MEMORY, TIMED_OUT}),
    ("x = []\nwhile True:\n    x.append('a' * 100000)", OUT_OF_MEMORY),
    ("x = []\nwhile True:\n    try:\n        x.append('a' * 100000)\n    except MemoryError: pass", OUT_OF_MEMORY),
    ("solution = f'{1:>1000000000}'", OUT_OF_MEMORY),
    ("solution = [None] * 10**6", OUT_OF_MEMORY),
    ("def f():\n    return f()\nsolution = f()", RAISED),
    ("class A:\n    def __repr__(self) -> str:\n        return repr(self)\nsolution = repr(A())", RAISED),
    ("x = []\nfor i in range(20000):\n    x = [x]\nsolution = repr(x) == x", OK),
    ("while True:\n    print('a' * 10000)", TIMED_OUT),
    ("print('a' * 10**6)\nsolution = 1", OK),
    ("while True:\n    find_parts('hole')", REFUSED),
    ("p = find_parts('hole')[0]\nwhile True:\n    p.faces", REFUSED),
    ("p = find_parts('hole')[0]\nwhile True:\n    hasattr(p, 'nothing')", REFUSED),
    ("p = find_parts('hole')[0]\nwhile True:\n    try:\n        p.distance_to(p)\n    except Exception: pass", REFUSED),
    (hidden("while True:\n    try:\n        unknown_name\n    except NameError:\n        pass"), REFUSED),
    (hidden("while True:\n    try:\n        import unknown_module\n    except ImportError:\n        pass"), REFUSED),
    (hidden("import os\nwhile True:\n    try:\n        os.getenv('x')\n    except RuntimeError: pass"), REFUSED),
    ("for i in range(10**6):\n    find_parts(f'hole {i}')", REFUSED),
    ("find_parts('hole' * 10**5)\nsolution = 1", RAISED),
    ("find_parts('hole', sides=['top'] * 10**5)\nsolution = 1", OK),
    (hidden("x = [0] * 1000\nx = [x] * 1000\nx = [x] * 1000\nfind_parts(x)\nsolution = 1"), RAISED),
]  # fmt: skip

FORGERIES: list[Claim] = [
    ("class Part2:\n    def __init__(self) -> None:\n        self.id = 'hole-9'\nsolution = Part2()", REFUSED),
    (hidden("class Part:\n    def __init__(self):\n        self.id = 'hole-9'\nsolution = [Part()]"), REFUSED),
    ("solution = {'part': 'hole-9'}", REFUSED),
    ("solution = [{'face': 1}]", REFUSED),
    (hidden("class P:\n    def __init__(self):\n        self.id = 'hole-9'\n"
            "solution = find_parts('hole')[0].distance_to(P())"), RAISED),
    ("solution = lambda: 1", REFUSED),
    ("solution = find_parts", OK),
    ("solution = print", REFUSED),
    ("import math\nsolution = math", REFUSED),
    ("solution = shape", REFUSED),
    ("solution = type(shape)", REFUSED),
    ("solution = [Part]", REFUSED),
    ("solution = float('nan')", REFUSED),
    ("solution = [1e308 * 10]", REFUSED),
    ("solution = 10**400", REFUSED),
    ("solution = b'bytes'", REFUSED),
    ("x = [1]\nx.append(x)\nsolution = x", REFUSED),
    ("x = {}\nx['x'] = x\nsolution = [x]", REFUSED),
    ("x = [0]\nfor i in range(60):\n    x = [x]\nsolution = x", REFUSED),
    ("x = [0]\nfor i in range(5000):\n    x = [x]\nsolution = x", REFUSED),
    ("x = [0] * 1000\nx = [x] * 1000\nx = [x] * 1000\nsolution = x", REFUSED),
    ("x = [0] * 1000\nx = [x] * 1000\nx = [x] * 1000\nparts = x\nsolution = 1", OK),
    ("x = [[]] * 1000\nx = [x] * 1000\nx = [x] * 1000\npart = x\nparts = [x, x]\nsolution = 1", OK),
    ("solution = list(range(20000))", REFUSED),
    ("solution = ['a' * 1000] * 5000", REFUSED),
    ("solution = range(5)", REFUSED),
    ("solution = {1: 2}.values()", REFUSED),
    ("raise TimeoutError('feed time limit exceeded: mine')", TIMED_OUT),
    ("raise ValueError('x' * 10**6)", RAISED),
    ("assert False, 'x' * 10**6", RAISED),
    ("raise KeyboardInterrupt", RAISED),
    ("raise SystemExit", RAISED),
]  # fmt: skip

TEXTS: list[Claim] = [
    ("x = 1\n" * 20000, REFUSED),
    ("solution = 1\0", REFUSED),
    ("solution = '\0'", REFUSED),
    ("solution = '\ud800'", REFUSED),
    ("\ufeffsolution = 1", REFUSED),
    ("solution = " + "(" * 30000 + "1" + ")" * 30000, REFUSED),
    ("solution = " + "[" * 150 + "]" * 150, REFUSED),
    ("solution = " + "-" * 60000 + "1", REFUSED),
    ("solution = " + "+".join(["1"] * 30000), REFUSED),
    ("".join(" " * i + "if 1:\n" for i in range(250)) + " " * 250 + "solution = 1", REFUSED),
    ("".join(" " * i + f"def f{i}():\n" for i in range(150)) + " " * 150 + "pass", TIMED_OUT),
    ("".join(" " * i + "try:\n" + " " * (i + 1) + "pass\n" + " " * i + "finally:\n" for i in range(40))
     + " " * 40 + "solution = 1", REFUSED),
    ("x = [a " + "for a in [1] " * 300 + "]", REFUSED),
    ("solution = " + "9" * 60000, REFUSED),
    ("a" * 60000, REFUSED),
    ("solution = f'{" * 100 + "1" + "}'" * 100, REFUSED),
    ("\x0c\x0b\x1a solution = 1", REFUSED),
    ("solution = 1\r\nimport socket\r\n", REFUSED),
    ("#" * 60000, RAISED),
    ("solution = 1  # " + "for part " * 7000, OK),
    ("solution = 1  # for " + "part, " * 10000, OK),
    ("solution = 1 + '" + "Literal[" * 7000 + "'", REFUSED),
    ("solution = '<" + "object " * 8000 + "'", OK),
    ("raise AttributeError(\"'\" + 'a' * 10**6)", RAISED),
    ("solution = 𝔣ind_parts", OK),
    ("def f():\n    yield 1\nsolution = list(f())", RAISED),
]  # fmt: skip

CLAIMS = [*ESCAPES, *REACHES, *BOMBS, *FORGERIES, *TEXTS]


@pytest.mark.parametrize(("code", "status"), CLAIMS, ids=[f"{i}-{code[:50]!r}" for i, (code, _) in enumerate(CLAIMS)])
def test_a_hostile_program_ends_as_stated_and_leaves_the_sandbox_well(
    sandbox: Sandbox, code: str, status: RunStatus | set[RunStatus]
) -> None:
    outcome = sandbox.run(code, FakeSegCad(), LIMITS)
    assert outcome.status in (status if isinstance(status, set) else {status}), outcome
    assert len(outcome.message) <= 2000
    assert len(outcome.printed.encode()) <= LIMITS.output_bytes
    if outcome.status is not OK:
        assert outcome.value is None
        assert outcome.message
    good = sandbox.run('solution = [p.id for p in find_parts("hole")]', FakeSegCad(), LIMITS)
    assert (good.status, good.value) == (OK, ["hole-1", "hole-2", "hole-3"])


def test_the_family_is_large() -> None:
    assert len({code for code, _ in CLAIMS}) == len(CLAIMS) >= 150


def test_a_parts_id_cannot_be_changed_for_the_host(sandbox: Sandbox) -> None:
    segcad = FakeSegCad()
    code = "p = find_parts('hole')[0]\np.id = 'boss-1'\np.radius = 9.0\nsolution = [p, p.distance_to(p)]"
    assert sandbox.run(code, segcad).value == [{"part": "hole-1"}, 0.0]
    assert segcad.calls[-1] == ("distance", ("hole-1", "hole-1"))


def test_a_later_run_gets_its_parts_unchanged(sandbox: Sandbox) -> None:
    segcad = FakeSegCad()
    sandbox.run("for p in find_parts('hole'):\n    p.radius = 9.0\n    p.tags.clear()\nsolution = 1", segcad)
    assert sandbox.run("solution = [p.radius for p in find_parts('hole')]", segcad).value == [0.0025, 0.0025, 0.005]


@pytest.mark.parametrize(
    "code",
    [
        "import os\nsolution = os.getcwd()",
        "import sys\nsolution = [sys.version, sys.platform, str(sys.argv)]",
        "solution = [__name__, __file__]",
        hidden("solution = str(locals())"),
        "solution = str([find_parts, shape, print, find_parts('hole')[0].faces[0]])",
    ],
)
def test_what_a_program_can_see_says_nothing_of_the_host(sandbox: Sandbox, code: str) -> None:
    outcome = sandbox.run(code, FakeSegCad(), LIMITS)
    seen = f"{outcome.value} {outcome.message}"
    for host in (str(os.getpid()), str(Path.cwd()), os.uname().nodename, "site-packages", "querycad_"):
        assert host not in seen

"""What every command understands, with examples. Imports nothing that a user of `--help` would wait for."""

from __future__ import annotations

import argparse
import importlib
import importlib.util
from collections.abc import Callable
from importlib.metadata import version

from querycad_contracts import TableFormat, TableKind
from querycad_sandbox.arguments import add_run_arguments

from .bench import add_bench
from .llm_arguments import add_codegen, add_expect, add_grounding, add_llm
from .models_arguments import add_models
from .segment_arguments import add_segment

Commands = argparse._SubParsersAction
EXIT_CODES = "exit code: 0 done; 1 something failed; 2 bad input, or asked for what is not there; 130 interrupted"


def make_parser() -> argparse.ArgumentParser:
    """The parser of the whole command line."""
    parser = argparse.ArgumentParser(
        prog="querycad",
        description="Ask a CAD model a question in plain language and get a precise, grounded answer.",
        formatter_class=argparse.RawDescriptionHelpFormatter,
        epilog='examples:\n  querycad ask part.step "How deep are the counterbores?"\n'
        "  querycad describe part.step\n  querycad table part.step holes --format csv\n\n" + EXIT_CODES,
    )
    parser.add_argument("--version", action=_Version, nargs=0, help="print the version")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    _add_ask(commands)
    _add_describe(commands)
    _add_compare(commands)
    _add_table(commands)
    _add_features(commands)
    _add_explain(commands)
    _add_prompt(commands)
    _add_run(commands)
    add_segment(commands)
    _add_mcp(commands)
    _add_serve(commands)
    _add_keys(commands)
    add_models(commands)
    _add_completion(commands)
    add_bench(commands)
    return parser


def with_examples(parser: argparse.ArgumentParser, *examples: str) -> None:
    """Adds examples, which its help ends with."""
    parser.formatter_class = argparse.RawDescriptionHelpFormatter
    parser.epilog = "\n".join(["examples:", *(f"  querycad {example}" for example in examples), "", EXIT_CODES])


class _Version(argparse.Action):
    """Prints the version of the installed package; looks for it only when asked."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        print(f"querycad {version('querycad')}")
        parser.exit()


def _runs(module: str, name: str) -> Callable[[argparse.Namespace], int]:
    """The function of a command's module, which is loaded when the command is run; '.ask' lies beside this one."""

    def run(options: argparse.Namespace) -> int:
        return int(getattr(importlib.import_module(module, __package__), name)(options))

    return run


def _add_file(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "file", metavar="FILE", help="STEP, IGES, BREP, STL, OBJ or 3MF, or one of these in a .stpz or .zip"
    )


def _add_unit(parser: argparse.ArgumentParser, of: str = "of lengths in text") -> None:
    parser.add_argument("--unit", choices=["mm", "cm", "m", "in"], default="mm", help=f"unit {of} (default: mm)")


def _add_server(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--server", metavar="URL", help="let a running service do it, such as http://127.0.0.1:8000")


def _add_ask(commands: Commands[argparse.ArgumentParser]) -> None:
    ask = commands.add_parser("ask", help="answer a question about a STEP file")
    _add_file(ask)
    ask.add_argument("question", nargs="?", metavar="QUESTION", help="the question, in English")
    ask.add_argument("--questions", metavar="FILE.txt", help="a file with one question per line, instead of QUESTION")
    ask.add_argument("--json", action="store_true", help="print one JSON object per question and nothing else")
    _add_unit(ask)
    ask.add_argument("--picture", metavar="OUT.png", type=_png, help="draw the parts that the answer rests on")
    ask.add_argument("--all", action="store_true", help="print each part of the answer, with its faces and sides")
    ask.add_argument("--symbols", action="store_true", help="write drawing symbols for words: ⌴ ⌵ ↧")
    ask.add_argument(
        "--select",
        action="append",
        default=[],
        metavar="ID",
        help="what 'it' or 'this' is: a part such as hole-4, or a face such as 36; as often as needed",
    )
    ask.add_argument(
        "--context",
        action="append",
        default=[],
        metavar="QUESTION",
        help="a question asked before, which this one may refer to; as often as needed, the oldest first",
    )
    ask.add_argument("--show-code", action="store_true", help="print the program that computed the answer")
    _add_server(ask)
    ask.add_argument(
        "--least-confidence", type=float, metavar="P", help="a less probable answer is unsure (default: 0.45)"
    )
    add_codegen(ask)
    add_expect(ask)
    add_grounding(ask)
    add_llm(ask)
    with_examples(
        ask,
        'ask part.step "What is the diameter of the holes on top?"',
        'ask part.step "distance between hole 4 and hole 6" --unit in',
        'ask part.step "How many ribs are there?" --picture ribs.png',
        'ask part.step "And how deep are they?" --context "How many blind holes are there?"',
        'ask part.step "What is its area?" --select hole-4',
        "ask part.step --questions questions.txt --json",
    )
    ask.set_defaults(run=_runs(".ask", "ask"))


def _add_describe(commands: Commands[argparse.ArgumentParser]) -> None:
    describe = commands.add_parser("describe", help="tell what a STEP file holds, and what can be asked about it")
    _add_file(describe)
    _add_unit(describe)
    _add_server(describe)
    describe.add_argument("--json", action="store_true", help="print one JSON object and nothing else")
    with_examples(describe, "describe part.step", "describe part.step --unit in", "describe part.step --json")
    describe.set_defaults(run=_runs(".describe", "describe"))


def _add_compare(commands: Commands[argparse.ArgumentParser]) -> None:
    compare = commands.add_parser("compare", help="tell what changed between two files, part by part")
    compare.add_argument("before", metavar="A", help="a CAD file")
    compare.add_argument("after", metavar="B", help="a later state of it")
    _add_unit(compare)
    compare.add_argument("--json", action="store_true", help="print one JSON object and nothing else")
    with_examples(compare, "compare part-v1.step part-v2.step", "compare part.step part.igs --json")
    compare.set_defaults(run=_runs(".describe", "compare"))


def _add_table(commands: Commands[argparse.ArgumentParser]) -> None:
    table = commands.add_parser("table", help="print a table of holes, bends, fasteners, bodies …")
    _add_file(table)
    table.add_argument(
        "kind", metavar="KIND", choices=[kind.value for kind in TableKind], help=", ".join(map(str, TableKind))
    )
    table.add_argument(
        "--format", choices=[each.value for each in TableFormat], default="text", help="default: %(default)s"
    )
    _add_unit(table, "of lengths; JSON stays SI")
    _add_server(table)
    rows = table.add_mutually_exclusive_group()
    rows.add_argument("--all", action="store_true", help="a row for each part, however many there are")
    rows.add_argument("--grouped", action="store_true", help="a row for all parts that are alike")
    with_examples(
        table,
        "table part.step holes",
        "table part.step holes --format csv --unit in > holes.csv",
        "table assembly.step bodies --format markdown",
    )
    table.set_defaults(run=_runs(".table", "table"))


def _add_features(commands: Commands[argparse.ArgumentParser]) -> None:
    features = commands.add_parser("features", help="list the features of a STEP file, or what was refused and why")
    _add_file(features)
    features.add_argument("--kind", metavar="KIND", help="of this kind only, such as hole")
    features.add_argument("--all", action="store_true", help="each part by itself, with its faces; surfaces too")
    features.add_argument("--refused", action="store_true", help="what looked like a feature, and why it is not one")
    _add_unit(features)
    features.add_argument("--symbols", action="store_true", help="write drawing symbols for words: ⌴ ⌵ ↧")
    features.add_argument("--json", action="store_true", help="print one JSON list of all parts and nothing else")
    with_examples(
        features, "features part.step", "features part.step --kind hole --all", "features part.step --refused"
    )
    features.set_defaults(run=_runs(".features", "features"))


def _add_explain(commands: Commands[argparse.ArgumentParser]) -> None:
    explain = commands.add_parser("explain", help="print what a question can mean on a model, and what speaks for it")
    _add_file(explain)
    explain.add_argument("question", metavar="QUESTION", help="the question, in English")
    explain.add_argument("--json", action="store_true", help="print one JSON object and nothing else")
    _add_unit(explain)
    with_examples(explain, 'explain part.step "How deep are the counterbores on top?"')
    explain.set_defaults(run=_runs(".explain", "explain"))


def _add_prompt(commands: Commands[argparse.ArgumentParser]) -> None:
    prompt = commands.add_parser("prompt", help="print what a language model would be sent for a question")
    _add_file(prompt)
    prompt.add_argument("question", metavar="QUESTION", help="the question, in English")
    add_codegen(prompt)
    with_examples(prompt, 'prompt part.step "How deep are the counterbores?"')
    prompt.set_defaults(run=_runs(".ask", "prompt"))


def _add_run(commands: Commands[argparse.ArgumentParser]) -> None:
    run = commands.add_parser("run", help="run a program of the guest API against a STEP file")
    add_run_arguments(run)
    run.add_argument("--model", required=True, metavar="FILE.step", help="a STEP file")
    with_examples(run, "run program.py --model part.step", "run - --model part.step --expects length < program.py")
    run.set_defaults(run=_runs(".run", "run"))


def _add_mcp(commands: Commands[argparse.ArgumentParser]) -> None:
    mcp = commands.add_parser("mcp", help="let an agent use QueryCAD: a server of the Model Context Protocol")
    mcp.add_argument("--http", type=_port, metavar="PORT", help="over HTTP on this port of this machine, not stdio")
    mcp.add_argument(
        "--folder", metavar="DIR", help="open only files in DIR (default: any; with --http the current folder)"
    )
    with_examples(mcp, "mcp", "mcp --http 8765 --folder models")
    mcp.set_defaults(run=_runs(".mcp", "mcp"))


def _add_serve(commands: Commands[argparse.ArgumentParser]) -> None:
    serve = commands.add_parser("serve", help="run all services on this machine")
    serve.add_argument(
        "--port", type=_port, default=8000, help="port of the HTTP interface (default: 8000; 0: any free)"
    )
    serve.add_argument(
        "--host", default="127.0.0.1", help="address to listen on (default: %(default)s); any other requires API keys"
    )
    serve.add_argument(
        "--workers", type=_positive, default=1, metavar="N", help="processes that find, and as many that draw (1)"
    )
    with_examples(serve, "serve", "serve --port 8080 --workers 4")
    serve.set_defaults(run=_runs("querycad.serve", "serve"))


def _add_keys(commands: Commands[argparse.ArgumentParser]) -> None:
    keys = commands.add_parser("keys", help="make, list and revoke API keys of the service on this machine")
    if importlib.util.find_spec("querycad_api") is None:  # an extra; running it says so
        keys.add_argument("rest", nargs=argparse.REMAINDER)
    else:
        from querycad_api.accounts.commands import add_arguments

        add_arguments(keys)
    with_examples(keys, "keys create --tenant design --name laptop", "keys list", "keys revoke 0123456789ab")
    keys.set_defaults(run=_runs("querycad_api.accounts.commands", "run"))


def _add_completion(commands: Commands[argparse.ArgumentParser]) -> None:
    completion = commands.add_parser("completion", help="print what makes a shell complete querycad's commands")
    completion.add_argument("shell", choices=["bash", "zsh", "fish", "tcsh", "powershell"])
    with_examples(
        completion,
        'completion bash >> ~/.bashrc    # or, for this shell alone: eval "$(querycad completion bash)"',
        "completion fish > ~/.config/fish/completions/querycad.fish",
    )
    completion.set_defaults(run=_complete)


def _complete(options: argparse.Namespace) -> int:
    from argcomplete.shell_integration import shellcode

    print(shellcode(["querycad"], shell=options.shell))  # nosec B604 - the name of a shell, none is started
    return 0


def _png(text: str) -> str:
    if not text.lower().endswith(".png"):
        raise argparse.ArgumentTypeError(f"{text!r}: pictures are PNG files: end the name in .png")
    return text


def _port(text: str) -> int:
    number = int(text)
    if not 0 <= number <= 65535:
        raise argparse.ArgumentTypeError("must be between 0 and 65535")
    return number


def _positive(text: str) -> int:
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError("at least 1")
    return number

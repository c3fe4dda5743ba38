"""The `querycad` command."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from querycad_contracts import WallsMissing

from .bench import add_bench


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command line and returns its exit code: 0 done, 1 failed, 2 bad input."""
    parser = argparse.ArgumentParser(
        prog="querycad", description="Ask a CAD model a question in plain language and get a precise, grounded answer."
    )
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    _add_ask(commands)
    _add_explain(commands)
    _add_prompt(commands)
    _add_run(commands)
    _add_features(commands)
    _add_segment(commands)
    _add_serve(commands)
    _add_keys(commands)
    _add_models(commands)
    add_bench(commands)
    options = parser.parse_args(arguments)
    try:
        return int(options.run(options))
    except KeyboardInterrupt:
        print("querycad: interrupted", file=sys.stderr)
        return 130
    except WallsMissing as error:
        print(f"querycad: {error}", file=sys.stderr)
        return 1
    except BrokenPipeError:
        sys.stderr.close()
        return 1


def _add_ask(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    from .llm_arguments import add_codegen, add_expect, add_grounding, add_llm

    ask = commands.add_parser("ask", help="answer a question about a STEP file")
    ask.add_argument("file", metavar="FILE", help="a STEP file")
    ask.add_argument("question", nargs="?", metavar="QUESTION", help="the question, in English")
    ask.add_argument("--questions", metavar="FILE.txt", help="a file with one question a line, instead of QUESTION")
    ask.add_argument("--json", action="store_true", help="print one JSON object a question and nothing else")
    ask.add_argument("--unit", choices=["mm", "m", "in"], default="mm", help="unit of lengths in text (default: mm)")
    ask.add_argument("--picture", metavar="OUT.png", help="draw the parts that the answer rests on")
    ask.add_argument("--show-code", action="store_true", help="print the program that computed the answer")
    ask.add_argument("--server", metavar="URL", help="let a running service answer, such as http://127.0.0.1:8000")
    ask.add_argument(
        "--least-confidence", type=float, metavar="P", help="an answer less probable than this is unsure (default: 0.5)"
    )
    add_codegen(ask)
    add_expect(ask)
    add_grounding(ask)
    add_llm(ask)
    ask.set_defaults(run=_ask)


def _ask(options: argparse.Namespace) -> int:
    from .ask import ask  # here, so that `querycad --help` needs no service

    return ask(options)


def _add_explain(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    explain = commands.add_parser("explain", help="print what a question can mean on a model, and what speaks for it")
    explain.add_argument("file", metavar="FILE", help="a STEP file")
    explain.add_argument("question", metavar="QUESTION", help="the question, in English")
    explain.add_argument("--json", action="store_true", help="print one JSON object and nothing else")
    explain.add_argument("--unit", choices=["mm", "m", "in"], default="mm", help="unit of lengths in text")
    explain.set_defaults(run=_explain)


def _explain(options: argparse.Namespace) -> int:
    from .explain import explain

    return explain(options)


def _add_prompt(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    prompt = commands.add_parser("prompt", help="print what a language model would be sent for a question")
    prompt.add_argument("file", metavar="FILE", help="a STEP file")
    prompt.add_argument("question", metavar="QUESTION", help="the question, in English")
    prompt.set_defaults(run=_prompt)


def _prompt(options: argparse.Namespace) -> int:
    from .ask import prompt

    return prompt(options)


def _add_run(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    from querycad_sandbox.arguments import add_run_arguments

    run = commands.add_parser("run", help="run a program of the guest API against a STEP file")
    add_run_arguments(run)
    run.add_argument("--model", required=True, metavar="FILE.step", help="a STEP file")
    run.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from .run import run

    return run(options)


def _add_features(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    features = commands.add_parser("features", help="list the features of a STEP file, or what was refused and why")
    features.add_argument("file", metavar="FILE", help="a STEP file")
    features.add_argument("--refused", action="store_true", help="what looked like a feature, and why it is none")
    features.add_argument("--kind", metavar="KIND", help="of this kind only, such as hole")
    features.add_argument("--json", action="store_true", help="print one JSON list and nothing else")
    features.set_defaults(run=_features)


def _features(options: argparse.Namespace) -> int:
    from .features import features

    return features(options)


def _add_segment(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    from .segment_arguments import add_segment

    add_segment(commands)


def _add_serve(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    serve = commands.add_parser("serve", help="run all services on this machine")
    serve.add_argument(
        "--port", type=_port, default=8000, help="port of the HTTP interface (default: 8000; 0: any free)"
    )
    serve.add_argument(
        "--host", default="127.0.0.1", help="address to listen on (default: %(default)s); any other asks for API keys"
    )
    serve.add_argument(
        "--workers", type=_positive, default=1, metavar="N", help="processes that find, and as many that draw (1)"
    )
    serve.set_defaults(run=_serve)


def _serve(options: argparse.Namespace) -> int:
    from .serve import serve

    return serve(options)


def _add_keys(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    from querycad_api.accounts.commands import add_arguments

    keys = commands.add_parser("keys", help="make, list and revoke API keys of the service on this machine")
    add_arguments(keys)
    keys.set_defaults(run=_keys)


def _keys(options: argparse.Namespace) -> int:
    from querycad_api.accounts.commands import run

    return run(options)


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


def _add_models(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    from .models_arguments import add_models

    add_models(commands)


if __name__ == "__main__":
    sys.exit(main())

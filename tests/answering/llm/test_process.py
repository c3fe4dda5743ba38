"""A command in a language model's place: what it is sent, what it may answer, and how it ends."""

from __future__ import annotations

import json
import os
import shlex
import sys
import time
from contextlib import suppress
from pathlib import Path

import pytest

from querycad_answering.llm.client import open_model
from querycad_answering.llm.messages import LlmBusy, LlmRefused, LlmTooSlow, Message, Reply, Role, TimeLimit
from querycad_answering.llm.process import ProcessChatModel
from querycad_answering.llm.settings import LlmSettings

ASKED = (Message(Role.SYSTEM, "rules"), Message(Role.USER, "How many holes? é"))


def reply(tmp_path: Path, program: str, seconds: float = 20.0, **settings: object) -> Reply:
    """What a Python program says in a language model's place."""
    script = tmp_path / "model.py"
    script.write_text(program, encoding="utf-8")
    command = shlex.join([sys.executable, str(script)])
    model = open_model(LlmSettings.model_validate({"llm_command": command, **settings}))
    assert isinstance(model, ProcessChatModel)
    return model.reply(ASKED, 0.5, 2, TimeLimit(seconds))


def test_a_command_gets_the_messages_as_json_and_its_output_is_the_reply(tmp_path: Path) -> None:
    said = reply(tmp_path, "import sys\nsys.stdout.write(sys.stdin.read())", llm_tokens=77)
    assert not said.cut
    assert json.loads(said.text) == {
        "messages": [{"role": "system", "content": "rules"}, {"role": "user", "content": "How many holes? é"}],
        "temperature": 0.5,
        "max_tokens": 77,
        "sample": 2,
    }


def test_a_command_needs_not_read_what_it_is_sent(tmp_path: Path) -> None:
    assert reply(tmp_path, "print('ok')").text == "ok\n"


def test_a_command_is_not_told_the_key(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("QUERYCAD_LLM_API_KEY", "hunter2")
    monkeypatch.setenv("ITS_OWN_KEY", "its own")
    assert reply(tmp_path, "import os\nprint('hunter2' in str(os.environ), os.environ['ITS_OWN_KEY'])").text == (
        "False its own\n"
    )


def test_a_reply_without_end_is_cut_and_the_process_ended(tmp_path: Path) -> None:
    said = reply(tmp_path, "while True:\n    print('x' * 1000)", llm_tokens=50)
    assert (said.cut, len(said.text)) == (True, 600)


def test_a_failure_is_told_with_the_last_thing_said(tmp_path: Path) -> None:
    with pytest.raises(LlmBusy, match="ended with code 3: no quota left"):
        reply(
            tmp_path, "import sys\nprint('log', file=sys.stderr)\nprint('no quota left', file=sys.stderr)\nsys.exit(3)"
        )
    with pytest.raises(LlmBusy, match="ended by signal 11"):
        reply(tmp_path, "import os\nos.kill(os.getpid(), 11)")


def test_a_command_that_is_not_there_is_refused(tmp_path: Path) -> None:
    with pytest.raises(LlmRefused, match="cannot be started: No such file"):
        ProcessChatModel(LlmSettings(llm_command=str(tmp_path / "nothing"))).reply(ASKED, 0, 1, TimeLimit(5))


def test_when_the_time_is_up_the_process_and_its_children_are_ended(tmp_path: Path) -> None:
    child = tmp_path / "child.pid"
    program = (
        "import subprocess, sys, time, pathlib\n"
        "child = subprocess.Popen([sys.executable, '-c', 'import time; time.sleep(600)'])\n"
        f"pathlib.Path({str(child)!r}).write_text(str(child.pid))\n"
        "time.sleep(600)"
    )
    with pytest.raises(LlmTooSlow):
        reply(tmp_path, program, seconds=2.0)
    pid = int(child.read_text())
    for _ in range(100):
        with suppress(ProcessLookupError):
            os.kill(pid, 0)
            if Path(f"/proc/{pid}/stat").read_text().split()[2] == "Z":
                return  # ended, and waits for whoever inherited it
            time.sleep(0.1)
            continue
        return
    raise AssertionError("the child is still running")


@pytest.mark.parametrize("command", ["'unclosed", "  "])
def test_what_is_no_command_is_refused_at_once(command: str) -> None:
    with pytest.raises(ValueError, match="is no command"):
        LlmSettings(llm_command=command)


def test_a_command_is_a_language_model_that_is_set_up() -> None:
    assert LlmSettings(llm_command="cat").is_configured

"""Settings come from the environment, and say what is wrong with it."""

from __future__ import annotations

from pathlib import Path

import pytest
from pydantic import ValidationError

from querycad_contracts.infrastructure import BrokerSettings, StorageSettings, WorkerSettings


def test_a_setting_is_read_from_the_variable_of_its_name() -> None:
    assert BrokerSettings.read({"QUERYCAD_REDIS_URL": "redis://elsewhere:1/2"}).redis_url == "redis://elsewhere:1/2"
    assert WorkerSettings.read({"QUERYCAD_SOLE_WORKER": "1"}).sole_worker is True


def test_an_empty_variable_is_as_good_as_none() -> None:
    assert BrokerSettings.read({"QUERYCAD_REDIS_URL": ""}) == BrokerSettings.read({})


def test_variables_of_other_programs_are_left_alone() -> None:
    assert BrokerSettings.read({"REDIS_URL": "x", "QUERYCAD_SOMETHING": "y"}) == BrokerSettings()


def test_a_bad_value_is_refused_with_the_setting_s_name() -> None:
    with pytest.raises(ValidationError, match="sole_worker"):
        WorkerSettings.read({"QUERYCAD_SOLE_WORKER": "perhaps"})


def test_an_upload_lies_under_its_hash(tmp_path: Path) -> None:
    settings = StorageSettings.read({"QUERYCAD_HOME": str(tmp_path)})
    assert settings.upload("ab" + "0" * 62) == tmp_path / "files" / "ab" / ("ab" + "0" * 62)

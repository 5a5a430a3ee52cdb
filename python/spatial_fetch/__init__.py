"""Descriptions in ordinary words in, what was understood and what the robot did out.

The seven executables of spatial-fetch do the work; this module runs them, one process a stage, and hands records over
as dictionaries. A record keeps everything it came with, so your own keys (a participant, a condition) stay with it.

    >>> import spatial_fetch
    >>> [record] = spatial_fetch.understand(["the mug is on the table in the bedroom"])
    >>> record["grounding"]["object"]["name"]
    'mug'
"""

from __future__ import annotations

import json
import os
import subprocess
import sysconfig
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Union

if TYPE_CHECKING:
    import pandas

__all__ = ["Description", "Record", "StageError", "executable", "fetch", "plan", "run", "table", "understand"]

Record = dict[str, Any]
"""A record as the stages write it: `text`, and what each stage added under its own key."""

Description = Union[str, Mapping[str, Any]]
"""A sentence, or a record with a `text`."""

STAGES = ("chunk", "ground", "plan", "drive", "hof", "perceive", "evaluate")


class StageError(Exception):
    """A stage refused its call or a record; the message says which record, what was wrong and what mends it."""

    def __init__(self, stage: str, code: int, messages: Sequence[str]):
        super().__init__("\n".join(messages) or f"{stage} ended with {code}")
        self.stage = stage
        self.code = code
        self.messages = list(messages)


def executable(stage: str) -> str:
    """The path of an executable: the one that came with this module, else the one on the PATH."""
    if stage not in STAGES:
        raise ValueError(f"{stage} is no stage; there are {', '.join(STAGES)}")
    own = os.path.join(sysconfig.get_path("scripts"), stage)
    return own if os.path.exists(own) else stage


def run(
    stage: str, records: Iterable[Description], *arguments: str, keep_going: bool = False, cwd: str | None = None
) -> list[Record]:
    """The records after one stage, with its options as on the command line.

    With `keep_going`, records that fail come back as they were instead of raising `StageError`.
    """
    given = "".join(json.dumps(_record(record), ensure_ascii=False) + "\n" for record in records)
    command = [executable(stage), *arguments, *(["--keep-going"] if keep_going else [])]
    ended = subprocess.run(command, input=given, capture_output=True, text=True, encoding="utf-8", cwd=cwd, check=False)
    # 3: finished, but something was lost, which the caller has asked for, or the record itself says.
    if ended.returncode not in (0, 3):
        raise StageError(stage, ended.returncode, ended.stderr.splitlines())
    return [json.loads(line) for line in ended.stdout.splitlines()]


def understand(descriptions: Iterable[Description], *, keep_going: bool = False) -> list[Record]:
    """What is meant: `chunks` and `grounding`, with `score` and a `question` where something is unclear."""
    return run("ground", run("chunk", descriptions, keep_going=keep_going), keep_going=keep_going)


def plan(
    descriptions: Iterable[Description], *, map: str | None = None, keep_going: bool = False  # noqa: A002
) -> list[Record]:
    """What the robot is to do in a home: `map` is a shipped home's name, or the path of a room map."""
    arguments = ("--map", map) if map else ()
    understood = _as_far_as("grounding", descriptions, understand, keep_going)
    return run("plan", understood, *arguments, keep_going=keep_going)


def fetch(
    descriptions: Iterable[Description],
    *arguments: str,
    world: str | None = None,
    seed: int = 0,
    keep_going: bool = False,
) -> list[Record]:
    """What came of it: `trial`, driven in simulation.

    `world` is a shipped home's name, or the path of a scene; further options are those of `drive`, such as
    `"--perception", "camera"`. The same seed gives the same trials.
    """
    home = ("--world", world) if world else ()
    planned = [_record(record) for record in descriptions]
    if not all("plan" in record for record in planned):
        # The map of a scene is that of the home it is made for.
        where = ("--map", world) if world and not os.path.exists(world) else _map_of(world)
        understood = _as_far_as("grounding", planned, understand, keep_going)
        planned = run("plan", understood, *where, keep_going=keep_going)
    return run("drive", planned, *home, "--seed", str(seed), *arguments, keep_going=keep_going)


def table(records: Iterable[Mapping[str, Any]]) -> "pandas.DataFrame":
    """A data frame with a row a record; columns have the names of the keys, those within others parted by dots."""
    import pandas

    return pandas.json_normalize([dict(record) for record in records])


def _record(description: Description) -> Record:
    return {"text": description} if isinstance(description, str) else dict(description)


def _as_far_as(key: str, descriptions: Iterable[Description], stage: Any, keep_going: bool) -> list[Record]:
    records = [_record(description) for description in descriptions]
    return records if all(key in record for record in records) else stage(records, keep_going=keep_going)


def _map_of(world: str | None) -> tuple[str, ...]:
    if world is None:
        return ()
    with open(world, encoding="utf-8") as file:
        named = json.load(file).get("map")
    if not isinstance(named, str):
        raise ValueError(f"{world} holds its map within; write the map to a file of its own and give plan(map=…)")
    beside = os.path.join(os.path.dirname(world), named)
    return ("--map", beside if os.path.exists(beside) else named)

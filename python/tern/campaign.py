"""Many flights of a scenario on virtual time, in parallel processes."""
from __future__ import annotations

import csv
import operator
import os
import pathlib
import sys
import tempfile
from typing import Any, Callable, Sequence

import numpy

from . import _tern
from .log import Table
from .settings import Settings, setting_texts

def find_scenario(scenario: str | os.PathLike[str]) -> str:
    """The path of a scenario: a file, or the name of one in ./scenarios or in the scenarios that Tern brings along.

    Raises FileNotFoundError that lists the names.
    """
    wanted = pathlib.Path(scenario)
    if wanted.is_file():
        return str(wanted)
    folders = [pathlib.Path("scenarios")]
    for parent in pathlib.Path(__file__).resolve().parents:
        folders += [parent / "scenarios", parent / "share" / "tern" / "scenarios"]
    names: set[str] = set()
    for folder in folders:
        for file in (folder / f"{wanted}.yaml", folder / wanted):
            if file.is_file():
                return str(file)
        names.update(file.stem for file in folder.glob("*.yaml"))
    raise FileNotFoundError(f"no scenario {wanted}; there are: {' '.join(sorted(names)) or 'none'}")


def campaign(scenario: str | os.PathLike[str], seeds: Sequence[int] = range(1, 11), *, settings: Settings = {},
             charge: str = "counts", jobs: int | None = None, out: str | os.PathLike[str] | None = None,
             progress: Callable[[int, int, int], None] | None = None) -> Table:
    """Flies a scenario once per seed and returns the columns of FLIGHTS.csv, a row per flight, ascending by seed.

    seeds: consecutive seeds. charge: the virtual time that a plan takes: "counts", 15 ms, so that a flight is a function
    of scenario, seed and program; or "cpu", the CPU time of its thread. jobs: flights at a time; by default one per
    core. out: FLIGHTS.csv, which is kept; seeds that it already holds are not flown again, and failed flights are in
    OUT.failures. progress: called with the numbers of flights that are done, of all flights, and of successes.

    Empty cells are NaN in columns of numbers and "" in columns of text. docs/reference/campaign.md has the columns.
    """
    if len(seeds) == 0:
        raise ValueError("seeds: none are given; 1 or more are flown")
    for seed in seeds:
        if not hasattr(seed, "__index__") or not 0 <= operator.index(seed) < 2**64:
            raise ValueError(f"seeds: {seed!r} is not an integer from 0 to 2^64 - 1")
    first, last = min(seeds), max(seeds)
    if last - first + 1 != len(seeds) or sorted(seeds) != list(range(first, last + 1)):
        raise ValueError(f"seeds: {list(seeds)} are not consecutive")
    if jobs is not None and jobs < 1:
        raise ValueError(f"jobs: {jobs}, not 1 or more")
    file = find_scenario(scenario)
    texts = setting_texts(settings)
    for text in texts:
        if text.startswith(("seed=", "logger.")):
            raise ValueError(f"settings: {text}: seeds are given by seeds=, and no logger runs in virtual time")
    command = [sys.executable, "-m", "tern._fly_one", "--scenario", file, "--charge", charge]
    for text in texts:
        command += ["--set", text]
    with tempfile.TemporaryDirectory(prefix="tern-campaign-") as folder:
        table = os.fspath(out) if out is not None else os.path.join(folder, "FLIGHTS.csv")
        with _module_path():
            _tern.run_campaign(file, texts, charge, (first, last), jobs or os.cpu_count() or 1, table, command, progress)
        return read_flights(table, first, last)


class _module_path:
    """Lets child processes import this package from where it is."""

    def __enter__(self) -> None:
        self._before = os.environ.get("PYTHONPATH")
        own = str(pathlib.Path(__file__).resolve().parents[1])
        os.environ["PYTHONPATH"] = own if not self._before else f"{own}{os.pathsep}{self._before}"

    def __exit__(self, *_: object) -> None:
        if self._before is None:
            del os.environ["PYTHONPATH"]
        else:
            os.environ["PYTHONPATH"] = self._before


def read_flights(file: str | os.PathLike[str], first: int = 0, last: int = 2**63 - 1) -> Table:
    """The columns of a FLIGHTS.csv, of the flights with seeds from first to last."""
    with open(file, newline="", encoding="utf-8") as lines:
        rows = [row for row in csv.DictReader(lines) if first <= int(row["seed"]) <= last]
    names = list(rows[0]) if rows else _tern.flight_columns()
    return Table({name: _column([row[name] for row in rows]) for name in names})


def _column(cells: list[str]) -> Any:
    """Integers, else numbers with NaN for empty cells, else texts."""
    if cells and all(cells):
        try:
            return numpy.array([int(cell) for cell in cells], dtype=numpy.int64)
        except (ValueError, OverflowError):
            pass
    if any(cells):
        try:
            return numpy.array([float(cell) if cell else numpy.nan for cell in cells], dtype=numpy.float64)
        except ValueError:
            pass
    return numpy.array(cells, dtype=object)

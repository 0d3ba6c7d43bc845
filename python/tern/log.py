"""Logs of flights as arrays."""
from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Iterator, Mapping, Sequence

import numpy

from ._tern import read_tables

if TYPE_CHECKING:
    import numpy.typing

    Array = numpy.typing.NDArray[Any]


class Table(Mapping[str, "Array"]):
    """Named columns of one length.

    A column's name has the unit in brackets unless the name says it: table["motion.position.x [m]"].
    """

    def __init__(self, columns: Mapping[str, Array]) -> None:
        self._columns = dict(columns)

    def __getitem__(self, name: str) -> Array:
        try:
            return self._columns[name]
        except KeyError:
            raise KeyError(f"no column {name!r}; there are: {', '.join(self._columns)}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    @property
    def rows(self) -> int:
        """The number of rows."""
        return len(next(iter(self._columns.values()))) if self._columns else 0

    def vector(self, name: str) -> Array:
        """The columns NAME.x, NAME.y and NAME.z as one array (n, 3), for example "motion.position"; "" for x, y, z."""
        prefix = f"{name}." if name else ""
        parts = []
        for axis in "xyz":
            found = [c for c in self._columns if c.split(" [")[0] == prefix + axis]
            if not found:
                raise KeyError(f"no column {prefix + axis!r}; there are: {', '.join(self._columns)}")
            parts.append(self._columns[found[0]])
        return numpy.stack(parts, axis=1)

    def to_pandas(self) -> Any:
        """A pandas.DataFrame of the columns; needs pandas."""
        import pandas

        return pandas.DataFrame(self._columns)

    def __repr__(self) -> str:
        return f"Table({self.rows} rows: {', '.join(self._columns)})"


class Log(Mapping[str, Table]):
    """The tables of a log, by name: "PLAN" has a row per message, "PLAN.control_points" a row per element of a list.

    The column "message" of both joins them: it is the number of the message in "PLAN".
    """

    def __init__(self, tables: Mapping[str, Table], shortfalls: str) -> None:
        self._tables = dict(tables)
        self.shortfalls = shortfalls
        """The messages that could not be read, a line per channel and reason; "" if there are none."""

    def __getitem__(self, name: str) -> Table:
        try:
            return self._tables[name]
        except KeyError:
            raise KeyError(f"the log has no {name}; it has: {', '.join(self._tables)}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._tables)

    def __len__(self) -> int:
        return len(self._tables)


def read_log(path: str | os.PathLike[str], channels: Sequence[str] = (), suffix: str = "") -> Log:
    """Reads a log: a file, the folder of a flight, or a text fixture; further parts (flight.001.lcm …) are found.

    channels: the channels to read, without suffix; empty: all. suffix: of the vehicle's channels. The tables are those
    of tern-export's CSV files. Raises OSError if the log cannot be read, or if it has no such channel.
    """
    tables, shortfalls = read_tables(os.fspath(path), suffix, list(channels))
    return Log({name: Table(columns) for name, columns in tables.items()}, shortfalls)

"""Diode-model parameters from measured photovoltaic I-V curves, and what the model gets wrong.

>>> import lyrefit
>>> result = lyrefit.fit("data/rtc_france")
>>> result.parameters["photocurrent"]        # ampere, pvlib's names
>>> print(result)                            # the whole report

Arrays, pandas frames, files and folders are taken for curves; keywords are the options of the
command of the same name, with '_' for '-'. Mistakes are raised as :class:`lyrefit.Error`.
"""

from collections.abc import Mapping as _Mapping
from typing import TYPE_CHECKING as _TYPE_CHECKING
from typing import NamedTuple as _NamedTuple

from . import _lyrefit
from ._lyrefit import *  # noqa: F401,F403
from ._lyrefit import Result as _Result
from ._lyrefit import __version__

if _TYPE_CHECKING:
    from . import pvlib as pvlib
    from . import searches as searches

_Mapping.register(_Result)
__all__ = ["Progress", "__version__", *(name for name in dir(_lyrefit) if not name.startswith("_"))]


class Progress(_NamedTuple):
    """Where a long computation stands, as a ``progress`` callback hears it.

    A callback that returns ``False`` ends the computation: what was found so far is returned.
    """

    stage: str
    """'search', 'polish', 'intervals', ..."""
    iteration: int
    """Of this stage, from 1."""
    iterations: int
    """Planned for this stage; 0 where that is open."""
    evaluations: int
    """Of the objective so far."""
    best: float
    """The best objective value so far, in the objective's own unit."""
    seconds: float
    """Since the stage began."""
    part: float
    """Of the stage's work that is done, where iterations differ in size; else 0."""
    note: str
    """What else there is to say."""


def __getattr__(name: str) -> object:
    """Import ``lyrefit.pvlib`` and ``lyrefit.searches`` where they are first used."""
    if name not in ("pvlib", "searches"):
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    return import_module(f"{__name__}.{name}")

"""Objects of results, which find a value under the key that version 0.1 gave it too."""

import json as _json
import warnings as _warnings

from ._lyrefit import _former_keys


class Record(dict):
    """A JSON object; a missing key is looked up under its present name."""

    def __missing__(self, key):
        for former, name in _former_keys:
            if former == key and name in self:
                _warnings.warn(f"the key {former!r} is now {name!r}", DeprecationWarning, stacklevel=2)
                return self[name]
        raise KeyError(key)


def loads(text):
    """The value of a JSON text, with a Record for each object."""
    return _json.loads(text, object_hook=Record)

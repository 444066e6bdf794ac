#!/usr/bin/env python3
"""check_schema.py SCHEMA.json FILE.json: whether the file is as the schema says, or each element of an array in it."""

import json
import pathlib
import sys
import warnings

warnings.simplefilter("ignore")  # newer versions would have another class resolve references
from jsonschema import Draft202012Validator, RefResolver

schema_file, file = map(pathlib.Path, sys.argv[1:])
schema = json.loads(schema_file.read_text())
Draft202012Validator.check_schema(schema)
validator = Draft202012Validator(schema, resolver=RefResolver(schema_file.resolve().as_uri(), schema))
document = json.loads(file.read_text())
failed = False
for record in document if isinstance(document, list) else [document]:
    for error in validator.iter_errors(record):
        place = "".join(f"[{key!r}]" for key in error.absolute_path)
        print(f"{file}{place}: {error.message[:200]}")
        failed = True
sys.exit(failed)

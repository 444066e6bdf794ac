#!/usr/bin/env python3
"""The comparison with the last release's record, on small records and small sources (cmake/stable)."""

import json
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "cmake" / "stable"))

import comparison
import declarations
import json_fields
import names
import reported
import stable


def broken(before, now):
    return comparison.compare(comparison.read(before), comparison.read(now))[0]


class Comparison(unittest.TestCase):
    FIT = "fit\toutput\tResult\t\nfit(model)\tinput\tstr | None\toptional\n"

    def test_what_stays_passes(self):
        self.assertEqual(comparison.compare(comparison.read(self.FIT), comparison.read(self.FIT)), ([], []))

    def test_additions_pass_and_are_named(self):
        now = self.FIT + "fit(seed)\tinput\tint\toptional\ntrend\toutput\tResult\t\ntrend(sweeps)\tinput\tstr\targument-1\n"
        lost, new = comparison.compare(comparison.read(self.FIT), comparison.read(now))
        self.assertEqual((lost, new), ([], ["fit(seed)", "trend", "trend(sweeps)"]))

    def test_what_goes_is_broken(self):
        self.assertEqual(broken(self.FIT, "fit\toutput\tResult\t\n"), ["fit(model) is gone"])

    def test_inputs_may_widen_and_not_narrow(self):
        self.assertEqual(broken("f(x)\tinput\tint\t\n", "f(x)\tinput\tint | list[int | str]\toptional\n"), [])
        self.assertEqual(broken("f(x)\tinput\tint | str\t\n", "f(x)\tinput\tint\t\n"), ["f(x) was int | str, is int"])

    def test_outputs_may_narrow_and_not_widen(self):
        self.assertEqual(broken("r.a\toutput\tnull | number\t\n", "r.a\toutput\tnumber\talways\n"), [])
        self.assertEqual(broken("r.a\toutput\tnumber\t\n", "r.a\toutput\tnull | number\t\n"),
                         ["r.a was number, is null | number"])

    def test_notes_may_not_be_lost(self):
        self.assertEqual(broken("r.a\toutput\tnumber\talways\n", "r.a\toutput\tnumber\t\n"), ["r.a is no longer always"])
        self.assertEqual(broken("f(x)\tinput\tint\toptional\n", "f(x)\tinput\tint\t\n"), ["f(x) is no longer optional"])
        self.assertEqual(broken("f(x)\tinput\tint\targument-1\n", "f(x)\tinput\tint\targument-2\n"),
                         ["f(x) is no longer argument-1"])

    def test_exact_types_and_kinds_stay(self):
        self.assertEqual(broken("S::a\texact\tdouble\t\n", "S::a\texact\tfloat\t\n"), ["S::a was double, is float"])
        self.assertEqual(broken("S::a\texact\tdouble\t\n", "S::a\toutput\tdouble\t\n"), ["S::a was exact, is output"])

    def test_a_new_required_input_breaks_old_calls_only(self):
        now = self.FIT + "fit(cells)\tinput\tint\t\nnew\toutput\tint\t\nnew(x)\tinput\tint\t\n"
        self.assertEqual(broken(self.FIT, now), ["fit(cells) is new and not optional"])

    def test_versions(self):
        too_low = comparison.too_low
        self.assertIn("raise the major", too_low("1.2.0", "1.3.0", ["x is gone"], []))
        self.assertEqual(too_low("1.2.0", "2.0.0", ["x is gone"], ["y"]), "")
        self.assertIn("raise the minor", too_low("1.2.0", "1.2.1", [], ["y"]))
        self.assertEqual(too_low("1.2.0", "1.3.0", [], ["y"]), "")
        self.assertEqual(too_low("1.2.0", "1.2.1", [], []), "")
        self.assertIn("below the last record", too_low("1.10.0", "1.9.0", [], []))

    def test_a_record_is_read_as_it_was_written(self):
        entries = {"a": comparison.Entry("exact"), "f(x)": comparison.Entry("input", "int", frozenset(["b", "a"]))}
        self.assertEqual(comparison.read(comparison.written(entries)), entries)


class Sources(unittest.TestCase):
    def test_python(self):
        entries = names.python_names(
            "class Result(Base):\n"
            "    @property\n    def json(self) -> str: ...\n"
            "    def save(self, file: str, wide: bool = True) -> None: ...\n"
            "    def _hidden(self) -> None: ...\n"
            "@overload\ndef fit(curve: str, *, junctions: Literal[2]) -> Two: ...\n"
            "@overload\ndef fit(curve: str, *, junctions: int = 1) -> One: ...\n"
            "def _private() -> None: ...\n")
        self.assertEqual(
            comparison.written(entries),
            "Result\texact\tclass Base\t\nResult.json\toutput\tstr\t\nResult.save\toutput\tNone\t\n"
            "Result.save(file)\tinput\tstr\targument-1\nResult.save(wide)\tinput\tbool\targument-2 optional\n"
            "fit\toutput\tTwo | One\t\nfit(curve)\tinput\tstr\targument-1\nfit(junctions)\tinput\t2 | int\toptional\n")

    def test_json(self):
        with tempfile.TemporaryDirectory() as folder:
            common = {"$defs": {"node": {"type": "object", "required": ["value_A"], "properties": {
                "value_A": {"type": ["number", "null"]}, "next": {"$ref": "#/$defs/node"}}}}}
            fit = {"type": "object", "required": ["nodes"], "properties": {
                "nodes": {"type": "array", "items": {"$ref": "common.json#/$defs/node"}},
                "model": {"enum": ["sd", "dd"]},
                "either": {"anyOf": [{"type": "null"}, {"$ref": "common.json#/$defs/node"}]}}}
            (pathlib.Path(folder) / "common.json").write_text(json.dumps(common))
            (pathlib.Path(folder) / "fit.json").write_text(json.dumps(fit))
            found = json_fields.fields(folder)
        number = comparison.Entry("output", "null | number", frozenset(["always"]))
        self.assertEqual(found["fit.nodes"], comparison.Entry("output", "array", frozenset(["always"])))
        self.assertEqual(found["fit.nodes[].value_A"], number)
        self.assertEqual(found["fit.either.value_A"], number)
        self.assertEqual(found["fit.either"].type, "null | object")
        self.assertIn("fit.model = dd", found)
        self.assertIn("fit.nodes[].next", found)
        self.assertNotIn("common", found)

    def test_flags(self):
        entries = names.flags_of_help(
            "fit", "Usage\n\nPositionals:\n  CURVE TEXT ... REQUIRED     a table\n\nOptions:\n"
                   "  -h,--help                   help\n  --bound P=LOWER:UPPER ...   range\n")
        self.assertEqual(
            comparison.written(entries),
            "fit\texact\tverb\t\nfit(--bound)\tinput\tvalue\toptional several\nfit(--help)\tinput\talone\toptional\n"
            "fit(-h)\tinput\talone\toptional\nfit(CURVE)\tinput\ttext\tseveral\n")
        values = names.flag_values("    'fit --model') words='sd dd' ;;\n    'fit --kernel') words='portable' ;;\n")
        self.assertEqual(set(values), {"fit --model sd", "fit --model dd"})

    def test_parameters_of_reports_and_effects(self):
        report = {"parameters": {"resistance_series": {"symbol": "Rs", "unit": "ohm", "refined": 0.3}}}
        explained = (
            "partial shading (shading)\n  equation      V = 1\n\n  parameter  bounds        meaning (unit in reports)\n"
            "  d          0 to 0.999    shading_depth, part of the light that the shaded cells miss (see\n"
            "                           the page)\n"
            "  Vb         0.1 to 1.2    bypass_voltage, drop of a bypass diode\n                           at Isc (V)\n"
            "  Bounds are of the equation's own units.\n")
        entries = {**reported.of_report("fit", report), **reported.of_explanation("shading", explained)}
        self.assertEqual({name: entry.type for name, entry in entries.items()}, {
            "fit: parameters.resistance_series": "Rs [ohm]", "effect: shading.d": "shading_depth []",
            "effect: shading.Vb": "bypass_voltage [V]"})

    @unittest.skipUnless(stable.shutil.which("doxygen"), "doxygen is not installed")
    def test_headers(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            header = root / "lib" / "lyrefit" / "sample.h"
            header.parent.mkdir(parents=True)
            header.write_text(
                "namespace lyrefit {\nenum class Kind { kOne };\nstruct Options {\n  int seed = 0;\n};\n"
                "double Fit(const Options& options, int times = 1);\nclass Closed {\n public:\n"
                "  virtual int Next() = 0;\n\n private:\n  int hidden_;\n};\n}\n")
            (root / "Doxyfile").write_text("QUIET = YES\nGENERATE_LATEX = NO\n")
            found = declarations.declarations("doxygen", root / "Doxyfile", root, [str(header)])
        self.assertEqual(
            {name: entry.type for name, entry in found.items()},
            {"lyrefit/sample.h": "header", "lyrefit::Kind": "enum", "lyrefit::Kind::kOne": "value",
             "lyrefit::Options": "struct", "lyrefit::Options::seed": "variable int", "lyrefit::Closed": "class",
             "lyrefit::Closed::Next()": "int pure-virtual", "lyrefit::Closed(override Next)": "",
             "lyrefit::Fit(const Options &)": "double", "lyrefit::Fit(const Options &, int)": "double"})


if __name__ == "__main__":
    unittest.main()

"""BibTeX of what a report used."""

import json
import os
import re
import subprocess
import tempfile
import unittest

import lyrefit
from helpers import DATA

SMALL = dict(models="sd", runs=3, population=10, iterations=10)


def keys(bibtex):
    return re.findall(r"^@\w+\{(\w+),$", bibtex, re.M)


class Cite(unittest.TestCase):
    def test_of_a_result_it_is_that_of_the_command(self):
        result = lyrefit.fit(DATA / "rtc_france")
        with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
            file.write(result.json)
            file.flush()
            said = subprocess.run([os.environ["LYREFIT_COMMAND"], "--cite", file.name], capture_output=True, text=True, check=True)
        self.assertEqual(lyrefit.cite(result), said.stdout)
        self.assertEqual(lyrefit.cite(json.loads(result.json)), said.stdout)
        self.assertEqual(lyrefit.cite(result.to_dict()), said.stdout)
        self.assertEqual(lyrefit.cite(), subprocess.run([os.environ["LYREFIT_COMMAND"], "cite"], capture_output=True, text=True,
                                                        check=True).stdout)

    def test_of_each_verb(self):
        """Keys that every report of a verb has beside that of the software."""
        curve = DATA / "rtc_france"
        module = DATA / "diagnosis" / "shaded_module.csv"
        results = {
            "fit": (lyrefit.fit(curve, algorithm="de", model="dd"), {"storn1997", "ceres", "sah1957", "tiesinga2021"}),
            "certify": (lyrefit.certify(curve), {"vanloan1985"}),
            "compare": (lyrefit.compare(curve, algorithms=["lo", lyrefit.searches.grey_wolf], **SMALL),
                        {"dehghani2023", "mirjalili2014", "friedman1937", "dunn1964", "wilcoxon1945", "holm1979"}),
            "diagnose": (lyrefit.diagnose(module, held_out=False), {"quaschning1996", "kass1995"}),
            "translate": (lyrefit.translate(DATA / "formats" / "head_tracer.csv"), {"iec60891", "desoto2006", "jcgm100"}),
            "datasheet": (lyrefit.fit_datasheet("30.9", "8.1", "37.8", "8.6", "0.05%", "-0.32%", cells_in_series=60), {"desoto2006"}),
            "cell": (lyrefit.cell([DATA / "cell" / "pair.csv", DATA / "cell" / "lit_dark.csv"]), {"green1981", "pysch2007"}),
            "audit": (lyrefit.audit(DATA / "paper" / "rows.csv"), {"mlo"}),
        }
        for verb, (result, expected) in results.items():
            found = keys(lyrefit.cite(result))
            self.assertEqual(found[0], "lyrefit", verb)
            self.assertLessEqual(expected, set(found), verb)
            self.assertEqual(len(found), len(set(found)), verb)

    def test_what_is_no_report(self):
        with self.assertRaisesRegex(lyrefit.Error, "expected the JSON of a report"):
            lyrefit.cite({"a": 1})
        with self.assertRaisesRegex(lyrefit.Error, "expected a result or a mapping"):
            lyrefit.cite("report.json")


if __name__ == "__main__":
    unittest.main()

"""Pictures of data/speed: what each release takes, and how often other programs take that."""

import json
import pathlib
import re

import matplotlib
import matplotlib.pyplot as plt

ROOT = pathlib.Path(__file__).resolve().parents[2]
UNITS = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}
OTHERS = re.compile(r"std::exp|scalar|bare|NLopt|pagmo2|/(lo|de|random)$")


def releases():
    """The records, first release first."""
    found = [json.loads(path.read_text(encoding="utf-8")) for path in (ROOT / "data" / "speed").glob("[0-9]*.json")]
    return sorted(found, key=lambda record: [int(part) for part in record["version"].split(".")])


def drawn(file, records, rows, label, line=None):
    """Rows from top to bottom, a mark a release, full for the last one, and a line; `rows` gives those of one record by name."""
    names = list(dict.fromkeys(name for record in records for name in rows(record)))
    with matplotlib.rc_context(fname=pathlib.Path(__file__).parent / "static" / "matplotlibrc"):
        _, axes = plt.subplots(figsize=(8, 1 + 0.19 * len(names)))
        for record in records:
            values = rows(record)
            shared = ", shared with other work" if record["machine"]["shared"] else ""
            axes.plot(list(values.values()), [names.index(name) for name in values], "o",
                      fillstyle="full" if record is records[-1] else "none", markersize=4 if record is records[-1] else 7,
                      label=f"{record['version']}: {record['machine']['processor']}, {record['machine']['instructions']}{shared}")
        axes.set(xscale="log", xlabel=label, ylim=(len(names) - 0.5, -0.5))
        axes.set_yticks(range(len(names)), names, fontsize=8)
        if line:
            axes.axvline(line, color="#777777", linewidth=0.8)
        axes.legend(loc="lower center", bbox_to_anchor=(0.3, 1))
        plt.savefig(file, metadata={"Date": None})
        plt.close()


def page(folder):
    """Draws both pictures into a folder; what the page has below its text."""
    records = releases()
    drawn(folder / "speed_times.svg", records, lambda record: {
        row["name"]: row["cpu_time"] * UNITS[row["unit"]] for row in record["benchmarks"] if not OTHERS.search(row["name"])},
        "processor time (s), median of the repetitions")
    drawn(folder / "speed_ratios.svg", records, lambda record: {
        row["claim"].removesuffix(" / lyrefit"): row["ratio"] for row in record["ratios"] if row["claim"].endswith(" / lyrefit")},
        "processor time in multiples of lyrefit's", line=1)
    return ("## Times of lyrefit\n\n![Processor times by release](_static/speed_times.svg)\n\n"
            "## Other programs on the same problems\n\n![Ratios by release](_static/speed_ratios.svg)\n")

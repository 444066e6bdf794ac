#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/devices/cell_parts.h"
#include "lyrefit/devices/device_documents.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

bool KnowsArea(const CellReport& report) { return std::isfinite(report.area_cm2); }

// The doubts of all sweeps, each once.
std::vector<std::string> DoubtsOf(const CellReport& report) {
  std::vector<std::string> doubts;
  for (const CellSweep& sweep : report.sweeps) {
    const bool known = std::find(doubts.begin(), doubts.end(), sweep.doubt) != doubts.end();
    if (!sweep.doubt.empty() && !known) doubts.push_back(sweep.doubt);
  }
  return doubts;
}

Section CellHead(const CellReport& report) {
  Section head = {fmt::format("lyrefit {}: cell {}", report.version, report.name)};
  AddField("files", report.source, &head);
  AddField("device",
           fmt::format("{}, {:.4g} C, area {}", Plural(report.cells_in_series, "cell"),
                       report.temperature_C,
                       report.per_area     ? std::string("not stated: all is of 1 cm2")
                       : KnowsArea(report) ? fmt::format("{:.6g} cm2", report.area_cm2)
                                           : std::string("not known: give --area-cm2")),
           &head);
  return head;
}

Section SweepSection(const CellReport& report) {
  Section section = {"Sweeps"};
  const bool area = KnowsArea(report);
  const double per = area ? 1000 / report.area_cm2 : 1;
  const double of = area ? report.area_cm2 : 1;
  block::Table table = {
      "lrrrrrrrrr",
      {{"", area ? "Jsc" : "Isc", "Voc", "Vmp", area ? "Jmp" : "Imp", "Pmp", "FF", "eff.", "R(Isc)",
        "R(Voc)"},
       {"", area ? "mA/cm2" : "A", "V", "V", area ? "mA/cm2" : "A", area ? "mW/cm2" : "W", "%", "%",
        area ? "ohm cm2" : "ohm", area ? "ohm cm2" : "ohm"}}};
  for (const CellSweep& sweep : report.sweeps) {
    if (sweep.kind != SweepKind::kLit) {
      table.rows.push_back({sweep.name});
      continue;
    }
    const KeyPoints& key = sweep.key;
    table.rows.push_back(
        {sweep.name, Significant(key.short_circuit_current_A * per, 5),
         Significant(key.open_circuit_voltage_V, 5), Significant(key.max_power_voltage_V, 4),
         Significant(key.max_power_current_A * per, 4), Significant(key.max_power_W * per, 4),
         Significant(100 * key.fill_factor, 4), Significant(100 * sweep.efficiency, 4),
         Significant(sweep.resistance_at_isc_ohm * of, 3),
         Significant(sweep.resistance_at_voc_ohm * of, 3)});
  }
  AddTable(std::move(table), &section);
  section.blocks.emplace_back(
      block::Legend{"eff. = Pmp / (irradiance x area); R(Isc), R(Voc) = -dV/dI at 0 V and at Voc"});
  return section;
}

Section PairSection(const CellReport& report, const DirectionPair& pair) {
  Section section = {
      fmt::format("Hysteresis at {:.4g} W/m2", report.sweeps[pair.reverse].irradiance_W_m2)};
  block::Table table = {"lrw", {{"", "value", "definition"}}};
  const auto add = [&](const char* name, const std::string& value, const char* definition) {
    table.rows.push_back({name, value, definition});
  };
  add("index by power", PercentText(pair.index_power), "(Pmp_rev - Pmp_fwd) / Pmp_rev");
  add("its noise", PercentText(pair.index_noise, 2), "standard error, of the noise of both");
  add("index by area", PercentText(pair.index_area),
      "1 - A_fwd / A_rev, A below J from 0 V to Voc");
  add("index at 0.8 Voc", PercentText(pair.index_at_80), "(J_rev - J_fwd) / J_rev, Voc of reverse");
  add("index at 0.5 Voc", PercentText(pair.index_at_50), "the same");
  add("gap", PercentText(pair.gap_percent / 100),
      "rms of J_rev - J_fwd from 0 V to the larger Voc, of Jsc_rev");
  add("noise in it", PercentText(pair.noise_percent / 100, 2), "rms that the noise of both gives");
  add("Voc", fmt::format("{:+.3g} mV", 1000 * pair.voc_difference_V), "reverse minus forward");
  add("Jsc", fmt::format("{:+.3g} %", 100 * pair.isc_difference),
      "reverse minus forward, of reverse");
  add("FF", fmt::format("{:+.3g} %", 100 * pair.ff_difference), "reverse minus forward, absolute");
  AddTable(std::move(table), &section);
  if (pair.sense == HysteresisSense::kNone) {
    AddSentence(std::isfinite(pair.gap_percent) ? "No hysteresis to speak of."
                                                : "Not decided: one direction does not reach 0 V.",
                &section);
    return section;
  }
  const char* const more = pair.sense == HysteresisSense::kNormal ? "reverse" : "forward";
  const char* const hides = " The curves cross: the index by power hides the gap.";
  AddSentence(pair.sense == HysteresisSense::kNeither
                  ? std::string("Hysteresis: a gap, while the index by power is below its noise.")
                  : fmt::format("Hysteresis, {}: {} gives more power.{}", ToText(pair.sense), more,
                                pair.cross ? hides : ""),
              &section);
  AddSentence(fmt::format("Possible: {}.{} Neither direction gives the steady power: track the "
                          "maximum power point.",
                          fmt::join(pair.causes, ", "),
                          report.over_rate ? "" : " A sweep at a second rate decides."),
              &section);
  return section;
}

// Rate of a pair of directions.
double RateOfPair(const CellReport& report, int pair) {
  return report.sweeps[report.pairs[pair].forward].scan_rate_V_s;
}

Section RateSection(const CellReport& report) {
  Section section = {"Hysteresis over the rate"};
  if (!report.over_rate) return section;
  block::Table table = {"rrrrrl",
                        {{"rate", "index by power", "its noise", "gap", "noise in it", "sense"},
                         {"V/s", "%", "%", "% of Jsc", "%", ""}}};
  for (const int i : report.over_rate->pairs) {
    const DirectionPair& pair = report.pairs[i];
    table.rows.push_back({Significant(RateOfPair(report, i), 3),
                          Significant(100 * pair.index_power, 3),
                          Significant(100 * pair.index_noise, 2), Significant(pair.gap_percent, 3),
                          Significant(pair.noise_percent, 2), ToText(pair.sense)});
  }
  AddTable(std::move(table), &section);
  if (report.over_rate->finding.empty()) {
    AddSentence("No rate has hysteresis to speak of.", &section);
    return section;
  }
  AddSentence("T" + report.over_rate->finding.substr(1) + ".", &section);
  AddField("left", fmt::format("{}", fmt::join(report.over_rate->causes, ", ")), &section);
  return section;
}

// The lit sweeps of a cell over hours, each beside the first of its direction and light.
Section HourSection(const CellReport& report) {
  Section section = {"Over hours"};
  const std::vector<HourRow> rows = RowsOfHours(report);
  if (rows.empty()) return section;
  block::Table table = {
      "rlrrrrr",
      {{"hours", "", "Voc", "Jsc", "FF", "Pmp", "Pmp"},
       {"", "", "% of first", "% of first", "% of first", "% of first", "% per h"}}};
  for (const HourRow& row : rows) {
    table.rows.push_back(
        {Significant(row.hours, 3), ToText(report.sweeps[row.sweep].direction),
         Significant(100 * row.voc, 4), Significant(100 * row.isc, 4), Significant(100 * row.ff, 4),
         Significant(100 * row.power, 4),
         row.since_h > 0 ? fmt::format("{:+.2g}", 100 * (row.power - 1) / row.since_h) : "-"});
  }
  AddTable(std::move(table), &section);
  section.blocks.emplace_back(block::Legend{"per h: mean change of Pmp since the first sweep"});
  return section;
}

void AddLocalIdealities(const IdealityOverLight& over, Section* section) {
  constexpr std::size_t kShown = 8;
  block::Table table = {"rrr", {{"from (A)", "to (A)", "local n"}}};
  const std::size_t step = (over.local.size() + kShown - 1) / kShown;
  for (std::size_t k = 0; k < over.local.size(); k += step) {
    const LocalIdeality& one = over.local[k];
    table.rows.push_back(
        {Significant(one.low_A, 3), Significant(one.high_A, 3), Significant(one.n, 4)});
  }
  if (over.local.size() > 1) AddTable(std::move(table), section);
  if (over.rises_to_low_light) {
    AddSentence(
        "The local n rises towards low light, as a shunt makes it: n / (1 - Voc / (Rsh Isc)). One "
        "line through all points means little.",
        section);
  }
}

Section IdealitySection(const CellReport& report) {
  Section section = {"Ideality n"};
  for (const IdealityOverLight& over : report.over_light) {
    AddField(
        over.source == SweepKind::kSunsVoc ? "Suns-Voc" : "Voc over light",
        over.noise_V > 0
            ? fmt::format("n = {} around Isc, beside a shunt: light = Is exp(Voc / n) + Voc / Rsh "
                          "by least squares; noise of a voltage {} mV",
                          RangedText(over.junction), Significant(1000 * over.noise_V, 2))
            : fmt::format("n = {} around Isc", RangedText(over.junction)),
        &section);
    AddField("one line",
             fmt::format("n = {}: (q / k T) dVoc / dln(Isc) by least squares over {} points",
                         RangedText(over.n), over.points.size()),
             &section);
    AddLocalIdealities(over, &section);
  }
  if (report.dark) {
    const DarkIdeality& dark = *report.dark;
    AddField(
        "dark, local",
        std::isfinite(dark.least_n)
            ? fmt::format("smallest n {:.4g} at {:.3g} V, within 10 % from {:.3g} to {:.3g} V: "
                          "(q / k T) / (dln J / dV)",
                          dark.least_n, dark.at_V, dark.plateau_low_V, dark.plateau_high_V)
            : std::string("no range of rising current above the noise"),
        &section);
    if (std::isfinite(dark.fitted.value)) {
      AddField("dark, fit", "n = " + RangedText(dark.fitted), &section);
    }
  }
  return section;
}

Section FitSection(const CellReport& report) {
  Section section = {"Single-diode fits"};
  block::Table table = {
      "lrrrrl", {{"", "n", "Rs (ohm)", "Rsh (ohm)", "RMSE", ""}, {"", "", "", "", "% of Isc", ""}}};
  for (const CellSweep& sweep : report.sweeps) {
    if (!sweep.fit) continue;
    const auto value = [&](const char* symbol) {
      for (const Estimate& e : sweep.fit->estimates) {
        if (e.info.symbol == symbol) return e.refined;
      }
      return kUnknown;
    };
    table.rows.push_back(
        {sweep.name, Significant(value("n1"), 4), Significant(value("Rs"), 4),
         Significant(value("Rsh"), 4),
         Significant(
             100 * sweep.fit->rmse.refined.solved_current_A / sweep.key.short_circuit_current_A, 2),
         sweep.diode() ? "" : "n and Rs are void"});
  }
  if (table.rows.empty()) return section;
  AddTable(std::move(table), &section);
  section.blocks.emplace_back(block::Legend{
      report.joint
          ? "RMSE: solved-current; intervals: --json"
          : "RMSE: solved-current; intervals: --json. Rsh at one light is a shunt or a collection "
            "that depends on voltage: a second light or the dark curve decides"});
  return section;
}

Section StatedSection(const CellReport& report) {
  Section section = {"What the files state"};
  block::Table table = {"llrrr", {{"sweep", "", "stated", "computed", "difference"}}};
  for (const CellSweep& sweep : report.sweeps) {
    for (const StatedKeyPoint& one : sweep.stated) {
      table.rows.push_back({sweep.name, one.name, Significant(one.stated, 5),
                            Significant(one.found, 5),
                            fmt::format("{:+.3f} %", 100 * (one.found / one.stated - 1))});
    }
  }
  if (!table.rows.empty()) AddTable(std::move(table), &section);
  return section;
}

}  // namespace

std::string PercentText(double fraction, int digits) {
  if (!std::isfinite(fraction)) return "-";
  return Significant(100 * fraction, digits) + " %";
}

std::string RangedText(const Ranged& ranged, int digits) {
  std::string value = Significant(ranged.value, digits);
  if (!std::isfinite(ranged.low_95) || !std::isfinite(ranged.high_95)) return value;
  return value + " (" + Range(ranged.low_95, ranged.high_95) + ")";
}

Document CellDocument(const CellReport& report) {
  Document document = {Banners(report.interrupted, true, {}, DoubtsOf(report)), CellHead(report)};
  document.verdict = CellVerdict(report);
  std::vector<Section> sections = {{"", {block::Conclusion{document.verdict}}},
                                   SweepSection(report)};
  for (const DirectionPair& pair : report.pairs)
    sections.push_back(Further(PairSection(report, pair)));
  sections.push_back(RateSection(report));
  sections.push_back(HourSection(report));
  sections.push_back(Further(IdealitySection(report)));
  sections.push_back(Further(SeriesResistanceSection(report)));
  sections.push_back(Further(FillFactorSection(report)));
  sections.push_back(Further(SuperpositionSection(report)));
  sections.push_back(FitSection(report));
  sections.push_back(Further(JointSection(report)));
  sections.push_back(Further(StatedSection(report)));
  sections.push_back(WarningSection(report.warnings));
  sections.push_back(Further(ListSection("Assumptions", SentencesOf(report.assumptions))));
  AddSections(std::move(sections), &document);
  AddFigure(FigureBlock(report), &document.head);
  return document;
}

std::string CellText(const CellReport& report, Length length) {
  return DrawText(CellDocument(report), length);
}

std::string BriefCell(const CellReport& report) {
  std::string text = report.name + ": " + CellVerdict(report);
  const std::vector<std::string> doubts = DoubtsOf(report);
  const std::string marks = BriefMarks(report.interrupted, true, report.warnings.size());
  if (!doubts.empty()) text += " DOUBTFUL: " + doubts.front() + ".";
  if (!marks.empty() && text.back() == '.') text.pop_back();  // the marks go on with a comma
  return text + marks + "\n";
}

}  // namespace lyrefit

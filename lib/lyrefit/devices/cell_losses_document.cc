#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/devices/cell_parts.h"
#include "lyrefit/report/text_layout.h"

namespace lyrefit {

Section SeriesResistanceSection(const CellReport& report) {
  Section section = {"Series resistance"};
  if (report.series_resistance.empty()) return section;
  const bool area = std::isfinite(report.area_cm2);
  block::Table table = {"lrrw", {{"from", "ohm", "ohm cm2", "95 % (ohm)"}}};
  std::vector<std::string> notes;
  for (const SeriesResistance& one : report.series_resistance) {
    const Ranged& ohm = one.ohm;
    const bool ranged = std::isfinite(ohm.low_95) && std::isfinite(ohm.high_95);
    table.rows.push_back({one.Name(), Significant(ohm.value, 4),
                          area ? Significant(report.PerArea(ohm.value), 4) : "-",
                          ranged ? Range(ohm.low_95, ohm.high_95) : one.missing});
    const std::string note = ToText(one.method) + ": " + one.note;
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
  }
  AddTable(std::move(table), &section);
  AddList(std::move(notes), &section);
  return section;
}

Section FillFactorSection(const CellReport& report) {
  Section section = {"Fill factor"};
  if (report.main == -1) return section;
  if (std::isfinite(report.pseudo.value)) {
    // Collection lowers the curves of the lights, but not their Voc.
    const bool by_fit = report.pseudo.source == PseudoSource::kFit;
    AddField("pseudo-FF",
             fmt::format(
                 "{} from {}; recombination and {} cost {}, series resistance{} {}",
                 PercentText(report.pseudo.value, 4), ToText(report.pseudo.source),
                 by_fit ? "shunt or collection" : "shunt",
                 PercentText(report.pseudo.ideal - report.pseudo.value, 3),
                 by_fit ? "" : " and collection",
                 PercentText(report.pseudo.value - report.sweeps[report.main].key.fill_factor, 3)),
             &section);
  }
  for (const FillFactorLosses& losses : report.losses) {
    const CellSweep& sweep = report.sweeps[losses.sweep];
    if (!losses.missing.empty()) {
      AddField(sweep.name, "no split of the losses: " + losses.missing, &section);
      continue;
    }
    block::Table table = {"lrrr", {{sweep.name, "lost (%)", "95 %", "FF (%)"}}};
    double left = losses.ideal;
    table.rows.push_back(
        {"ideal diode, n = 1, same Isc and Voc", "", "", Significant(100 * left, 4)});
    for (const FillFactorPart& part : losses.parts) {
      left -= part.loss.value;
      const bool ranged = std::isfinite(part.loss.low_95);
      table.rows.push_back({part.name, fmt::format("{:.3f}", 100 * part.loss.value),
                            ranged ? Range(100 * part.loss.low_95, 100 * part.loss.high_95) : "-",
                            Significant(100 * left, 4)});
    }
    AddTable(std::move(table), &section);
    section.blocks.emplace_back(block::Legend{fmt::format(
        "the last FF is the measured one; Green's FF0: {} % with n = 1, {} % with the fitted n{}",
        Significant(100 * losses.green_n1, 4), Significant(100 * losses.green_fitted, 4),
        report.joint
            ? ""
            : ". At one light a shunt and a collection that depends on voltage look alike")});
  }
  return section;
}

Section SuperpositionSection(const CellReport& report) {
  Section section = {"Superposition: J_light against Jsc - J_dark"};
  if (!report.superposition) return section;
  const Superposition& found = *report.superposition;
  if (!std::isfinite(found.rms_percent)) {
    AddSentence("Not tested: the dark curve does not reach the lit one's Voc.", &section);
    return section;
  }
  AddField("departure",
           fmt::format("{} % of Jsc (rms from 0 to {:.3g} V), {:+.2g} % at {:.3g} V at most; noise "
                       "{} %",
                       Significant(found.rms_percent, 2), found.to_V, found.largest_percent,
                       found.largest_at_V, Significant(found.noise_percent, 2)),
           &section);
  AddField("taken off",
           fmt::format("Rs of {} ohm in the light, {} ohm in the dark ({})",
                       Significant(found.lit_rs_ohm, 3), Significant(found.dark_rs_ohm, 3),
                       found.rs_from),
           &section);
  if (std::isfinite(found.voc_shift_V)) {
    AddField("Voc", fmt::format("{:+.3g} mV from that of Jsc - J_dark", 1000 * found.voc_shift_V),
             &section);
  }
  AddField("dark current",
           fmt::format("times {} it would leave {} % (rms)", Significant(found.dark_scale, 3),
                       Significant(found.scaled_rms_percent, 2)),
           &section);
  if (!found.departs) {
    AddSentence("The curves superpose as far as these readings tell.", &section);
    return section;
  }
  AddSentence(fmt::format("They do not superpose. Possible: {}.", fmt::join(found.causes, "; ")),
              &section);
  AddField("would decide", found.decides, &section);
  return section;
}

}  // namespace lyrefit

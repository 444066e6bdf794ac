#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/numbers.h"
#include "lyrefit/devices/cell_parts.h"
#include "lyrefit/report/fit_parts.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

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
  if (!found.not_with.empty()) {
    AddField(
        "not with",
        "Rs of " + found.not_with +
            ": the light drifted during the sweep or is not what the trace says, or the contacts "
            "of the measurements differ",
        &section);
  }
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

namespace {

block::Table JointParameters(const CellReport& report, const JointEstimate& joint) {
  // A perfect shunt is a bound of its conductance.
  const auto value = [](const Estimate& e) {
    const bool perfect = IsConductance(e.info.kind) && e.at_bound == BoundSide::kUpper;
    return perfect ? kInfinity : e.refined;
  };
  const bool area = std::isfinite(report.area_cm2);
  const EstimateColumn per_area = {
      "per area", 'r', [=, &report](const Estimate& e) {
        const bool resistance = e.info.unit == "ohm";
        return area && resistance ? Significant(report.PerArea(value(e)), 4) + " ohm cm2" : "";
      }};
  return EstimateTable(joint.estimates,
                       {{"value", 'r', [=](const Estimate& e) { return Significant(value(e), 5); }},
                        per_area,
                        ErrorColumn(),
                        IntervalColumn()});
}

// Rows of measurements, columns of the shared parameters.
block::Table WhatEachAdds(const CellReport& report, const JointEstimate& joint) {
  block::Table table = {"lr", {{"without", "readings"}}};
  for (int i = 0; i < joint.shared; ++i) {
    if (joint.estimates[i].fixed) continue;
    table.alignment += "r";
    table.heads.front().push_back(joint.estimates[i].info.symbol);
  }
  for (const JointMeasurement& one : joint.measurements) {
    std::vector<std::string> row = {report.sweeps[one.sweep].name, std::to_string(one.readings)};
    for (int i = 0; i < joint.shared; ++i) {
      if (joint.estimates[i].fixed) continue;
      const double times = one.without[i];
      row.push_back(std::isfinite(times) ? Significant(times, 3) : "not known");
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

block::Table JointMisfits(const CellReport& report, const JointEstimate& joint) {
  block::Table table = {"lrrrl", {{"measurement", "together", "alone", "noise", ""}}};
  for (const JointMeasurement& one : joint.measurements) {
    const CellSweep& sweep = report.sweeps[one.sweep];
    table.rows.push_back({sweep.name, Scientific(one.rms, 3),
                          std::isfinite(one.own_rms) ? Scientific(one.own_rms, 3) : "-",
                          Scientific(one.noise, 2),
                          sweep.kind == SweepKind::kSunsVoc && !sweep.pseudo_current ? "V" : "A"});
  }
  return table;
}

// What is known of a part of the area behind a series resistance of its own. Sheet and fingers of
// sound cells are uneven too: only a large loss speaks of age.
std::string ContactsText(const JointEstimate& joint) {
  constexpr double kMostOfSound = 0.1;  // of the power, that series resistance costs new modules
  const std::string p = fmt::format("p = {}", Significant(joint.contacts_p, 2));
  if (!joint.contacts) return fmt::format("one series resistance is enough ({})", p);
  const auto value = [&](const char* symbol) {
    const auto at = std::find_if(joint.estimates.begin(), joint.estimates.end(),
                                 [&](const Estimate& e) { return e.info.symbol == symbol; });
    return at->refined;
  };
  std::string text = fmt::format(
      "{:.0f} % of the area is behind {} ohm, the rest behind {} ohm, each as if the whole device "
      "were ({} of one resistance)",
      100 * value("s"), Significant(value("Rc"), 3), Significant(value("Rs"), 3), p);
  if (!joint.void_because.empty() || !std::isfinite(joint.series_loss)) return text;
  text += fmt::format(
      "; that part alone costs {} W, all series resistance {:.0f} % of the power without it",
      RangedText(joint.contact_loss_W, 3), 100 * joint.series_loss);
  if (joint.series_loss < kMostOfSound) return text + ", as in a new module";
  return text +
         ": corroded fingers or ribbons are like this; look for dark ones in an "
         "electroluminescence image";
}

// What is known of the temperature of the lit sweeps beside the dark one's.
std::string WarmerText(const JointEstimate& joint) {
  const std::string p = fmt::format("p = {}", Significant(joint.warmer_p, 2));
  const std::string either =
      joint.either
          ? "; a second diode and a difference of temperature explain these readings alike: "
            "a second dark curve right after the lit one decides"
          : "";
  if (!joint.warmer) return fmt::format("one for all sweeps ({} of one against two){}", p, either);
  const auto at = std::find_if(joint.estimates.begin(), joint.estimates.end(),
                               [](const Estimate& e) { return e.info.symbol == "dT"; });
  return fmt::format(
      "the lit sweeps are about {:+.2g} K from the dark one: they miss Voc of its diode by {:+.2g} "
      "mV, "
      "and {:.2g} mV/K are usual ({} of one temperature){}",
      at->refined, 1e3 * joint.voc_per_K * at->refined, 1e3 * joint.voc_per_K, p, either);
}

}  // namespace

std::string WarmthText(const CellReport& report) {
  if (!report.joint || !report.joint->warmer) return "";
  const auto& all = report.joint->estimates;
  const auto at =
      std::find_if(all.begin(), all.end(), [](const Estimate& e) { return e.info.symbol == "dT"; });
  return fmt::format(", as a lit cell about {:.2g} K {} than the dark one makes it",
                     std::fabs(at->refined), at->refined > 0 ? "warmer" : "colder");
}

Section JointSection(const CellReport& report) {
  Section section = {"All measurements in one model"};
  if (!report.joint) return section;
  const JointEstimate& joint = *report.joint;
  if (!joint.missing.empty()) {
    AddSentence("No joint estimate: " + joint.missing + ".", &section);
    return section;
  }
  const std::string reasons = fmt::format("{}", fmt::join(joint.void_because, "; "));
  if (!reasons.empty()) {
    AddSentence("One diode model is not behind all of them: " + reasons +
                    ". The parameters below describe no device.",
                &section);
  }
  AddField("diodes",
           fmt::format("{} (one against two, the second of n = 2: p = {})",
                       joint.second_diode ? "two" : "one", Significant(joint.second_diode_p, 2)),
           &section);
  if (std::isfinite(joint.warmer_p)) AddField("temperature", WarmerText(joint), &section);
  if (std::isfinite(joint.contacts_p)) AddField("contacts", ContactsText(joint), &section);
  AddTable(JointParameters(report, joint), &section);
  AddUnidentifiable(joint.estimates, &section);
  AddField("shunt", joint.shunt, &section);
  AddTable(JointMisfits(report, joint), &section);
  section.blocks.emplace_back(
      block::Legend{"rms of the residuals, solved-current; alone: the sweep's own fit"});
  AddTable(WhatEachAdds(report, joint), &section);
  section.blocks.emplace_back(block::Legend{
      "what each adds: the standard error without it in multiples of that with all; not known: the "
      "others do not decide the parameter"});
  if (joint.refine.termination != "converged")
    AddSentence("The joint fit did not converge.", &section);
  return section;
}

}  // namespace lyrefit

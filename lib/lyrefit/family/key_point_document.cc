#include <fmt/format.h>

#include <cmath>

#include "lyrefit/family/family_parts.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

// A relative error in percent.
std::string ErrorPercent(double model, double measured) {
  const double percent = 100 * (model / measured - 1);
  return std::isfinite(percent) ? fmt::format("{:+.2f}", percent) : "-";
}

std::string PartPercent(double part) {
  return std::isfinite(part) ? fmt::format("{:.2f} %", 100 * part) : "-";
}

std::string Signed2(double percent) {
  return std::isfinite(percent) ? fmt::format("{:+.2f}", percent) : "-";
}

// "isc=0.25%,...; common to a set temperature 0.31 K, to a light 0.2 %"
std::string ErrorsFoundText(const KeyPointErrors& found) {
  KeyPointErrors own = found;
  own.temperature_K = own.irradiance = kUnknown;
  std::string text = KeyPointErrorsText(own);
  if (std::isfinite(found.temperature_K)) {
    text += fmt::format("; common to a set temperature {:.2g} K", found.temperature_K);
  }
  if (std::isfinite(found.irradiance)) {
    text += fmt::format("; common to a light {:.2g} %", 100 * found.irradiance);
  }
  return text;
}

Section KeyPointSection(const FamilyReport& report) {
  Section section = {"Key points, model less measured (%)"};
  if (!report.key_points) return section;
  const KeyPointSummary& summary = *report.key_points;
  block::Table table = {
      "rrrrrrrrrl",
      {{"G", "T", "", "", "", "", "", "Pmp of", "held out", ""},
       {"W/m2", "C", "Isc", "Voc", "Imp", "Vmp", "Pmp", "nominal", "of nominal", ""}}};
  bool any_outside = false;
  for (const FamilyCurve& curve : report.curves) {
    if (!curve.key_points) continue;
    const KeyPoints& is = curve.key_points->model;
    const KeyPoints& was = curve.key_points->measured;
    const Interval& held_out = curve.key_points->held_out_power_W;
    const auto of_nominal = [&](double power_W) {
      return Signed2(100 * (power_W - was.max_power_W) / summary.reference_power_W);
    };
    const bool outside = was.max_power_W < held_out.low_95 || was.max_power_W > held_out.high_95;
    any_outside = any_outside || outside;
    table.rows.push_back({fmt::format("{:.5g}", curve.irradiance_W_m2),
                          fmt::format("{:.4g}", curve.temperature_C),
                          ErrorPercent(is.short_circuit_current_A, was.short_circuit_current_A),
                          ErrorPercent(is.open_circuit_voltage_V, was.open_circuit_voltage_V),
                          ErrorPercent(is.max_power_current_A, was.max_power_current_A),
                          ErrorPercent(is.max_power_voltage_V, was.max_power_voltage_V),
                          ErrorPercent(is.max_power_W, was.max_power_W), of_nominal(is.max_power_W),
                          of_nominal(held_out.value), outside ? "outside" : ""});
  }
  AddTable(std::move(table), &section);
  AddField(
      "rms error",
      fmt::format("Isc {}, Voc {}, Imp {}, Vmp {}, Pmp {}; Pmp of nominal {}",
                  PartPercent(summary.short_circuit_current),
                  PartPercent(summary.open_circuit_voltage), PartPercent(summary.max_power_current),
                  PartPercent(summary.max_power_voltage), PartPercent(summary.max_power),
                  PartPercent(summary.max_power_of_reference)),
      &section);
  AddField(
      "nominal",
      fmt::format("Pmp of {} W at 1000 W/m2 and 25 C", Significant(summary.reference_power_W, 5)),
      &section);
  if (summary.held_out > 0) {
    AddField("held out",
             fmt::format("{}; Pmp of nominal {}; {} of {} inside the 95 % interval of the forecast",
                         report.held_out ? report.held_out->how : "",
                         PartPercent(summary.held_out_max_power_of_reference), summary.covered,
                         summary.held_out),
             &section);
  }
  AddField(
      "fit",
      fmt::format("rms of the residuals in units of the errors {}: searched {}, refined {}",
                  KeyPointErrorsText(summary.errors), Significant(report.searched_key_points, 4),
                  Significant(report.refined_key_points, 4)),
      &section);
  if (summary.found) AddField("errors found", ErrorsFoundText(*summary.found), &section);
  if (any_outside) {
    AddSentence(
        "outside: the measured Pmp lies outside the interval in which a fit without this condition "
        "expects it.",
        &section);
  }
  AddSentence(
      "Intervals take the errors from the residuals: those of each kind of key point, and those "
      "that "
      "conditions of one set temperature or of one light share (--key-point-errors "
      "temperature=0.3K,light=0.3% states these). What all conditions have in common (the lamp's "
      "calibration, the area) shows in no residual: it scales Iph, alpha and Pmp, and comes on "
      "top.",
      &section);
  return section;
}

Section EqualDeviceSection(const FamilyReport& report) {
  Section section = {"Other devices that fit as well"};
  if (!report.equal_devices) return section;
  const EqualDevices& equal = *report.equal_devices;
  AddSentence(
      fmt::format("These conditions do not decide {}: every row is a device of the law that misses "
                  "them by no more than their errors allow. More irradiances decide Rs and the "
                  "shunts, more temperatures Eg or mu, both together n.",
                  equal.along),
      &section);
  if (equal.devices.size() < 2) return section;
  block::Table table = {"", {{}}};
  for (std::size_t i = 0; i < report.estimates.size(); ++i) {
    if (report.estimates[i].fixed) continue;
    table.heads[0].push_back(LabelWithUnit(report.estimates[i].info));
    table.alignment += 'r';
  }
  for (const char* const power : {"Pmp (W)", "at 200 W/m2", "at 75 C"}) {
    table.heads[0].emplace_back(power);
    table.alignment += 'r';
  }
  for (const EqualDevice& device : equal.devices) {
    block::Table::Row row;
    for (std::size_t i = 0; i < report.estimates.size(); ++i) {
      if (!report.estimates[i].fixed) row.push_back(Significant(device.shared[i], 4));
    }
    for (const double power_W :
         {device.reference_power_W, device.low_light_power_W, device.hot_power_W}) {
      row.push_back(Significant(power_W, 4));
    }
    table.rows.push_back(std::move(row));
  }
  AddTable(std::move(table), &section);
  return section;
}

}  // namespace

std::vector<Section> KeyPointSections(const FamilyReport& report) {
  return {KeyPointSection(report), EqualDeviceSection(report)};
}

}  // namespace lyrefit

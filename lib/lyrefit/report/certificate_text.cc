#include "lyrefit/report/certificate_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

constexpr int kProvedDigits = 10;
constexpr int kRangeDigits = 6;

// Whether larger Rs than those gone through were asked for.
bool OpenRange(const Certificate& certificate) {
  return certificate.options.rs_upper_ohm > certificate.rs_upper_ohm;
}

std::string Ranges(const Certificate& certificate) {
  const CertifyOptions& options = certificate.options;
  const std::string rs =
      OpenRange(certificate)
          ? fmt::format("any Rs from {:g} ohm up", options.rs_lower_ohm)
          : fmt::format("Rs in [{:g}, {:.4g}] ohm", options.rs_lower_ohm, options.rs_upper_ohm);
  return fmt::format("n in [{:g}, {:g}] and {}", options.n_lower, options.n_upper, rs);
}

std::string Header(const Certificate& certificate) {
  std::string text = DoubtLines(certificate.doubts);
  if (certificate.interrupted) {
    text +=
        Wrap("", "INTERRUPTED: the bounds hold, but with more time they would be closer.") + "\n";
  }
  text += fmt::format("lyrefit {}: how low the RMSE of {} can go\n", certificate.version,
                      certificate.curve.name);
  text += CurveFields(certificate.curve);
  text += Field("objective", "measured-current, unweighted");
  text += Field("range", "diodes in parallel with " + Ranges(certificate) +
                             "; Iph, Is and 1/Rsh from 0 up; constants " +
                             ToText(certificate.options.constants));
  return text;
}

std::string GapText(double gap) { return fmt::format("{:.1e}", gap); }

// A mixture goes through all points.
bool Exact(const Floor& floor) { return floor.gap == 0 && floor.lower_bound_A == 0; }

std::string FloorSection(const Certificate& certificate) {
  const Floor& floor = certificate.floor;
  std::string text = "Floor: the lowest RMSE of any number of diodes\n";
  text += Field("reached", Scientific(floor.rmse_A, kProvedDigits) + " A");
  text += Field("proved", Exact(floor)
                              ? "nothing can be lower: this is rounding"
                              : fmt::format("nothing lies below {} A: a relative gap of {}",
                                            BoundText(floor.lower_bound_A), GapText(floor.gap)));
  const double shunt = floor.conductance_shunt_S;
  text +=
      Field("reached by", fmt::format("Iph {} A, Rs {} ohm, Rsh {} ohm, and{}",
                                      Significant(floor.photocurrent_A, kRangeDigits),
                                      Significant(floor.resistance_series_ohm, kRangeDigits),
                                      shunt > 0 ? Significant(1 / shunt, kRangeDigits) : "infinite",
                                      floor.diodes.empty() ? " no diode" : ""));
  if (floor.diodes.empty()) return text;
  TextTable table("rrrr");
  table.Add({"diode", "n", "Is (A)",
             fmt::format("current at {:.5g} V (A)", certificate.reference_voltage_V)});
  for (std::size_t d = 0; d < floor.diodes.size(); ++d) {
    const FloorDiode& diode = floor.diodes[d];
    table.Add({std::to_string(d + 1), Significant(diode.n, 8),
               Significant(diode.saturation_current_A, kRangeDigits),
               Significant(diode.current_A, kRangeDigits)});
  }
  return text + table.Text();
}

std::string ProofSection(const Certificate& certificate) {
  const Floor& floor = certificate.floor;
  if (Exact(floor)) return "";
  const std::string correlation =
      floor.largest_correlation > 0 ? fmt::format("exceeds {:.0e} of its length, which is rounding",
                                                  floor.largest_correlation)
                                    : std::string("is positive");
  std::string text = "Proof\n";
  text += Wrap("  ", fmt::format("At that Rs the residuals are a dual vector: of all diodes with n "
                                 "in the range, none has a column whose product with it {}, so "
                                 "none can lower the sum of squares. Duality gap {} (relative).",
                                 correlation, GapText(floor.duality_gap)));
  text += Wrap("  ", fmt::format("Between the Rs visited the dual vectors of both neighbours, "
                                 "interpolated, bound the RMSE from below: {} convex problems "
                                 "settled Rs up to {:.4g} ohm.{}",
                                 floor.solved, certificate.rs_upper_ohm,
                                 OpenRange(certificate)
                                     ? " Beyond that the points come in the wrong order of "
                                       "junction voltage for any model."
                                     : ""));
  return text;
}

std::string ModelSection(const Certificate& certificate) {
  if (certificate.models.empty()) return "";
  TextTable table("lrrrrlr");
  table.Add({"model", "best RMSE (A)", "proved bound (A)", "gap", "above floor", "certified",
             "problems"});
  for (const ModelCertificate& model : certificate.models) {
    const bool attains = model.above_floor <= kCertifiedGap;
    table.Add({ToText(model.model), Scientific(model.rmse_A, kProvedDigits),
               BoundText(model.lower_bound_A), GapText(model.gap),
               attains ? "attains it" : Significant(100 * model.above_floor, 3) + " %",
               model.certified ? "yes" : "NO",
               model.solved > 0 ? std::to_string(model.solved) : "the floor's"});
  }
  std::string text = "Models with one, two and three diodes\n" + table.Text();
  for (const ModelCertificate& model : certificate.models) {
    const Device device = MakeDevice(model.model, certificate.curve.conditions);
    std::string values;
    for (int i = 0; i < device.size(); ++i) {
      const ParameterInfo& info = device.parameters[i];
      values += fmt::format("{}{} {}{}", i == 0 ? "" : ", ", info.symbol,
                            Significant(model.parameters[i], kRangeDigits),
                            info.unit.empty() ? "" : " " + info.unit);
    }
    text += Field(ToText(model.model), values);
  }
  return text;
}

// What all that comes to.
std::string Conclusion(const Certificate& certificate) {
  const std::size_t diodes = certificate.floor.diodes.size();
  const double gap = certificate.floor.gap;
  if (!certificate.floor.certified) {
    return fmt::format(
        "The floor lies between the proved bound and what was reached, {:.2g} % "
        "apart.",
        100 * gap);
  }
  std::string text =
      Exact(certificate.floor)
          ? "The floor is zero: diodes in parallel go through all points, to rounding."
          : fmt::format("{} attain{} the floor: with {} no further diode can lower the RMSE.",
                        diodes == 0 ? "No diode is needed to" : Plural(diodes, "diode"),
                        diodes == 1 ? "s" : "", Ranges(certificate));
  for (const ModelCertificate& model : certificate.models) {
    if (model.certified) continue;
    text += fmt::format(" {}: not certified, a lower RMSE by up to {:.2g} % is not excluded.",
                        ToText(model.model), 100 * model.gap);
  }
  return text;
}

}  // namespace

std::string CertificateText(const Certificate& certificate) {
  std::string text = Header(certificate);
  for (const std::string& section :
       {FloorSection(certificate), ProofSection(certificate), ModelSection(certificate),
        Wrap("", Conclusion(certificate)), Field("time", Duration(certificate.seconds)),
        List("Assumptions", SentencesOf(certificate.curve.assumptions))}) {
    if (!section.empty()) text += "\n" + section;
  }
  return text;
}

std::string BriefCertificate(const Certificate& certificate) {
  std::string text =
      fmt::format("{}: floor {} A measured-current (gap {}, {}, n in [{:g}, {:g}])",
                  certificate.curve.name, Scientific(certificate.floor.rmse_A, kProvedDigits),
                  GapText(certificate.floor.gap), Plural(certificate.floor.diodes.size(), "diode"),
                  certificate.options.n_lower, certificate.options.n_upper);
  for (const ModelCertificate& model : certificate.models) {
    text += fmt::format(", {} {} A (gap {}{})", ToText(model.model),
                        Scientific(model.rmse_A, kProvedDigits), GapText(model.gap),
                        model.certified ? "" : ", NOT CERTIFIED");
  }
  if (certificate.interrupted) text += ", INTERRUPTED";
  if (!certificate.doubts.empty()) text += ", " + Plural(certificate.doubts.size(), "warning");
  return text + "\n";
}

}  // namespace lyrefit

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/certify/certificate_documents.h"
#include "lyrefit/certify/certify.h"
#include "lyrefit/estimate/fit/usable.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

constexpr int kProvedDigits = 10;
constexpr int kRangeDigits = 6;

// Whether the requested range of Rs exceeds the searched one.
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

// "from 1 A up" or "in [1, 2] A".
std::string Within(double lower, double upper, const std::string& unit) {
  if (upper == kInfinity) return fmt::format("from {:g}{} up", lower, unit);
  return fmt::format("in [{:g}, {:g}]{}", lower, upper, unit);
}

bool Alike(const DiodeRanges& a, const DiodeRanges& b) {
  return a.n_lower == b.n_lower && a.n_upper == b.n_upper && a.is_lower_A == b.is_lower_A &&
         a.is_upper_A == b.is_upper_A;
}

// Ranges of Iph and Rsh, and those of each diode of a model.
std::string OtherRanges(const CertifyOptions& options) {
  const bool linear = options.iph_lower_A > 0 || options.iph_upper_A < kInfinity ||
                      options.rsh_lower_ohm > 0 || options.rsh_upper_ohm < kInfinity;
  std::string text = linear ? "Iph " + Within(options.iph_lower_A, options.iph_upper_A, " A") +
                                  " and Rsh " +
                                  Within(options.rsh_lower_ohm, options.rsh_upper_ohm, " ohm")
                            : "Iph and 1/Rsh from 0 up";
  if (options.diodes.empty()) return text;
  const DiodeRanges& first = options.diodes.front();
  bool alike = true;
  for (const DiodeRanges& diode : options.diodes) alike = alike && Alike(diode, first);
  if (alike) {
    const bool open = first.is_lower_A == 0 && first.is_upper_A == kInfinity;
    if (open) return linear ? text + ", Is from 0 up" : "Iph, Is and 1/Rsh from 0 up";
    return text + "; each diode of a model has Is " +
           Within(first.is_lower_A, first.is_upper_A, " A") +
           "; the Is of the floor's diodes may add up to any value";
  }
  text += "; the floor's Is from 0 up, of the models";
  for (std::size_t d = 0; d < options.diodes.size(); ++d) {
    const DiodeRanges& diode = options.diodes[d];
    text += fmt::format("{} n{} {}, Is{} {}", d == 0 ? "" : ",", d + 1,
                        Within(diode.n_lower, diode.n_upper, ""), d + 1,
                        Within(diode.is_lower_A, diode.is_upper_A, " A"));
  }
  return text;
}

std::vector<std::string> CertificateBanners(const Certificate& certificate) {
  std::vector<std::string> banners = Banners(false, true, {}, certificate.doubts);
  if (certificate.interrupted) {
    banners.push_back("INTERRUPTED: the bounds hold, but with more time they would be closer.");
  }
  return banners;
}

Section CertificateHead(const Certificate& certificate) {
  Section head = {fmt::format("lyrefit {}: how low the RMSE of {} can go", certificate.version,
                              certificate.curve.name)};
  AddCurve(certificate.curve, &head);
  AddField("objective", std::string(ToText(certificate.options.objective)) + ", unweighted", &head);
  AddField("range",
           "diodes in parallel with " + Ranges(certificate) + "; " +
               OtherRanges(certificate.options) + "; constants " +
               ToText(certificate.options.constants),
           &head);
  if (!certificate.options.bounds.empty()) AddField("bounds", certificate.options.bounds, &head);
  return head;
}

std::string GapText(double gap) { return fmt::format("{:.1e}", gap); }

// Whether a mixture passes through all points.
bool Exact(const Floor& floor) { return floor.gap == 0 && floor.lower_bound_A == 0; }

Section FloorSection(const Certificate& certificate) {
  const Floor& floor = certificate.floor;
  Section section = {"Floor: the lowest RMSE of any number of diodes"};
  AddField("reached", Scientific(floor.rmse_A, kProvedDigits) + " A", &section);
  AddField("proved",
           Exact(floor) ? "nothing can be lower: this is rounding"
                        : fmt::format("nothing lies below {} A: a relative gap of {}",
                                      BoundText(floor.lower_bound_A), GapText(floor.gap)),
           &section);
  const double shunt = floor.conductance_shunt_S;
  AddField("reached by",
           fmt::format("Iph {} A, Rs {} ohm, Rsh {} ohm, and{}",
                       Significant(floor.photocurrent_A, kRangeDigits),
                       Significant(floor.resistance_series_ohm, kRangeDigits),
                       shunt > 0 ? Significant(1 / shunt, kRangeDigits) : "infinite",
                       floor.diodes.empty() ? " no diode" : ""),
           &section);
  if (floor.diodes.empty()) return section;
  block::Table table = {
      "rrrr",
      {{"diode", "n", "Is (A)",
        fmt::format("current at {:.5g} V (A)", certificate.reference_voltage_V)}}};
  for (std::size_t d = 0; d < floor.diodes.size(); ++d) {
    const FloorDiode& diode = floor.diodes[d];
    table.rows.push_back({std::to_string(d + 1), Significant(diode.n, 8),
                          Significant(diode.saturation_current_A, kRangeDigits),
                          Significant(diode.current_A, kRangeDigits)});
  }
  AddTable(std::move(table), &section);
  return section;
}

Section ProofSection(const Certificate& certificate) {
  const Floor& floor = certificate.floor;
  Section section = {"Proof"};
  if (Exact(floor)) return section;
  const std::string correlation =
      floor.largest_correlation > 0 ? fmt::format("exceeds {:.0e} of its length, which is rounding",
                                                  floor.largest_correlation)
                                    : std::string("is positive");
  const bool solved = certificate.options.objective == Objective::kSolvedCurrent;
  AddSentence(
      fmt::format("At that Rs the residuals{} are a dual vector: of all diodes with n in the "
                  "range, none has a column whose product with it {}, so none can lower "
                  "the sum of squares{}. Duality gap {} (relative).",
                  solved ? ", each over 1 + Rs x slope," : "", correlation,
                  solved ? " to first order" : "", GapText(floor.duality_gap)),
      &section);
  if (solved) {
    AddSentence(
        "A model as good as this one has known currents, hence known slopes: what these can differ "
        "from the slopes around which the problem is linear is taken off every bound.",
        &section);
  }
  AddSentence(
      fmt::format("{} the dual vectors of both {}, interpolated, bound the RMSE from below: "
                  "{} convex problems settled Rs up to {:.4g} ohm.{}",
                  solved ? "Over each range of Rs" : "Between the Rs visited",
                  solved ? "ends" : "neighbours", floor.solved, certificate.rs_upper_ohm,
                  !OpenRange(certificate) ? ""
                  : solved                ? " Beyond that any model's current falls too "
                                            "slowly with the voltage."
                                          : " Beyond that the points come in the wrong "
                                            "order of junction voltage for any model."),
      &section);
  if (certificate.options.rigorous) {
    AddSentence(
        "Rigorous: every bound of the measured-current RMSE was evaluated in intervals and "
        "no rounding can have raised it, nor lowered an RMSE that is reached (JSON has all "
        "digits); for the readings as read into doubles and the exact quotient k / q.",
        &section);
  }
  return section;
}

// Symbols, values and units of a model's parameters: "Iph 0.760788 A, Is1 3.10685e-07 A, ..."
std::string ModelValues(const ModelCertificate& model, const Conditions& conditions) {
  const Device device = MakeDevice(model.model, conditions);
  std::string values;
  for (int i = 0; i < device.size(); ++i) {
    const ParameterInfo& info = device.parameters[i];
    values += fmt::format("{}{} {}{}", i == 0 ? "" : ", ", info.symbol,
                          Significant(model.parameters[i], kRangeDigits),
                          info.unit.empty() ? "" : " " + info.unit);
  }
  return values;
}

// A sentence on diodes that are proved here and that no search has; empty: there are none.
std::string BeyondSearches(const Certificate& certificate) {
  const CertifyOptions& options = certificate.options;
  const Device device =
      MakeDevice(Model::kSingleDiode, certificate.curve.conditions, options.constants);
  const double steepest =
      SteepestIdeality(certificate.curve, device, {options.rs_lower_ohm, options.rs_upper_ohm});
  if (!(options.n_lower < steepest && steepest < options.n_upper)) return "";
  return fmt::format(
      "fit and compare begin n at {:.4g}, because below that the exponential of a diode would "
      "overflow. Their best may lie above what is proved here.",
      steepest);
}

Section ModelSection(const Certificate& certificate) {
  Section section = {"Models with one, two and three diodes"};
  if (certificate.models.empty()) return section;
  block::Table table = {"lrrrrlr",
                        {{"model", "best RMSE (A)", "proved bound (A)", "gap", "above floor",
                          "certified", "problems"}}};
  for (const ModelCertificate& model : certificate.models) {
    const bool attains = model.above_floor <= kCertifiedGap;
    table.rows.push_back({ToText(model.model), Scientific(model.rmse_A, kProvedDigits),
                          BoundText(model.lower_bound_A), GapText(model.gap),
                          attains ? "attains it" : Significant(100 * model.above_floor, 3) + " %",
                          model.certified ? "yes" : "NO",
                          model.solved > 0 ? std::to_string(model.solved) : "the floor's"});
  }
  AddTable(std::move(table), &section);
  for (const ModelCertificate& model : certificate.models) {
    AddField(ToText(model.model), ModelValues(model, certificate.curve.conditions), &section);
  }
  const std::string beyond = BeyondSearches(certificate);
  if (!beyond.empty()) AddSentence(beyond, &section);
  return section;
}

// One sentence on the floor and the models.
std::string Conclusion(const Certificate& certificate) {
  const std::size_t diodes = certificate.floor.diodes.size();
  const double gap = certificate.floor.gap;
  if (!certificate.floor.certified) {
    return fmt::format(
        "The floor lies between the proved bound and what was reached, {:.2g} % apart.", 100 * gap);
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

// Ideality factors evenly spaced in 1/n, as the exponents are, and those of the floor's diodes.
std::vector<double> Idealities(const Certificate& certificate) {
  constexpr int kSteps = 600;
  const double low = 1 / certificate.options.n_upper;
  const double high = 1 / certificate.options.n_lower;
  std::vector<double> n;
  for (int i = 0; i <= kSteps; ++i) n.push_back(1 / (low + (high - low) * i / kSteps));
  for (const FloorDiode& diode : certificate.floor.diodes) n.push_back(diode.n);
  std::sort(n.begin(), n.end());
  return n;
}

// Cosines over n, in multiples of `unit`.
Series Cosines(const Certificate& certificate, const std::vector<double>& n, double unit,
               Series series) {
  const std::vector<double> cosines = DualCosines(certificate, n);
  for (std::size_t i = 0; i < n.size(); ++i) series.Add(n[i], cosines[i] / unit);
  return series;
}

// The picture of the proof for pages, with a caption and a table of its numbers. A figure without
// panels if there is nothing to draw.
block::Figure FigureBlock(const Certificate& certificate) {
  block::Figure shown;
  if (certificate.floor.dual_A.empty()) return shown;
  shown.caption =
      "The proof of the floor: what a diode of each ideality could still gain. Nothing lies above "
      "zero, and zero is reached only at the diodes of the floor.";
  shown.figure = CertificateFigure(certificate);
  block::Table table = {"rrr", {{"diode", "n", "cosine of dual vector and column"}}};
  table.caption = "The diodes of the floor.";
  std::vector<double> n;
  for (const FloorDiode& diode : certificate.floor.diodes) n.push_back(diode.n);
  const std::vector<double> cosines = DualCosines(certificate, n);
  for (std::size_t i = 0; i < n.size(); ++i) {
    table.rows.push_back({std::to_string(i + 1), Significant(n[i], 8), Significant(cosines[i], 2)});
  }
  shown.readings = std::move(table);
  return shown;
}

}  // namespace

Document CertificateDocument(const Certificate& certificate) {
  Document document = {CertificateBanners(certificate), CertificateHead(certificate)};
  Section time;
  AddField("time", Duration(certificate.seconds), &time);
  AddSections({FloorSection(certificate),
               ProofSection(certificate),
               ModelSection(certificate),
               {"", {block::Conclusion{Conclusion(certificate)}}},
               time,
               ListSection("Assumptions", SentencesOf(certificate.curve.assumptions))},
              &document);
  document.verdict = Conclusion(certificate);
  AddFigure(FigureBlock(certificate), &document.head);
  return document;
}

std::string CertificateText(const Certificate& certificate) {
  return DrawText(CertificateDocument(certificate));
}

std::string BriefCertificate(const Certificate& certificate) {
  std::string text = fmt::format(
      "{}: floor {} A {} (gap {}, {}, n in [{:g}, {:g}])", certificate.curve.name,
      Scientific(certificate.floor.rmse_A, kProvedDigits), ToText(certificate.options.objective),
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

Figure CertificateFigure(const Certificate& certificate) {
  std::vector<double> diodes;
  for (const FloorDiode& diode : certificate.floor.diodes) diodes.push_back(diode.n);
  const std::vector<double> n = Idealities(certificate);
  const std::vector<double> cosines = DualCosines(certificate, n);
  const double lowest = -*std::min_element(cosines.begin(), cosines.end());
  const double unit = lowest > 0 ? std::pow(10, std::floor(std::log10(lowest))) : 1;
  Panel panel{"What a diode of ideality n could still gain: nothing above zero",
              {"Ideality factor n", certificate.options.n_lower, certificate.options.n_upper},
              {fmt::format("Cosine of dual vector and column ({:.0e})", unit)}};
  panel.rules = {{0, kGrey}};
  panel.series = {Cosines(certificate, n, unit, {SeriesKind::kLine, LookOf(0), 2}),
                  Cosines(certificate, diodes, unit, {SeriesKind::kPoints, LookOf(1), 1, 2})};
  return {fmt::format("{}: floor {} A", certificate.curve.name,
                      Scientific(certificate.floor.rmse_A, 10)),
          LegendOf({"any diode", "diodes of the floor"}, LegendMark::kLineAndPoint),
          {std::move(panel)}};
}

Expected<void> PlotCertificate(const Certificate& certificate, const std::string& path) {
  return DrawFigure(CertificateFigure(certificate), path);
}

}  // namespace lyrefit

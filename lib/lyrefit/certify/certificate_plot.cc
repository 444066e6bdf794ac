#include "lyrefit/certify/certificate_documents.h"
#include "lyrefit/certify/certificate_parts.h"
#include "lyrefit/report/plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/certify/certify.h"
#include "lyrefit/report/text_layout.h"

namespace lyrefit {
namespace {

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

}  // namespace

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

}  // namespace lyrefit

#include "lyrefit/report/certificate_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/report/text_layout.h"

namespace lyrefit {
namespace {

// Evenly spaced in 1/n, as the exponents are, and the diodes themselves.
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

Series CosinesOf(const std::vector<double>& n, const std::vector<double>& cosines, double unit) {
  Series series;
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
  Series any = CosinesOf(n, cosines, unit);
  any.look = LookOf(0);
  any.width = 2;
  Series floor = CosinesOf(diodes, DualCosines(certificate, diodes), unit);
  floor.kind = SeriesKind::kPoints;
  floor.look = LookOf(1);
  floor.size = 2;

  Panel panel{"What a diode of ideality n could still gain: nothing above zero"};
  panel.x.label = "Ideality factor n";
  panel.x.low = certificate.options.n_lower;
  panel.x.high = certificate.options.n_upper;
  panel.y.label = fmt::format("Cosine of dual vector and column ({:.0e})", unit);
  panel.rules = {{0, kGrey}};
  panel.series = {std::move(any), std::move(floor)};
  Figure figure{fmt::format("{}: floor {} A", certificate.curve.name,
                            Scientific(certificate.floor.rmse_A, 10)),
                LegendOf({"any diode", "diodes of the floor"}, LegendMark::kLineAndPoint)};
  figure.panels.push_back(std::move(panel));
  return figure;
}

Expected<void> PlotCertificate(const Certificate& certificate, const std::string& path) {
  return DrawFigure(CertificateFigure(certificate), path);
}

}  // namespace lyrefit

#include "lyrefit/report/certificate_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/report/panels.h"
#include "lyrefit/report/plot.h"
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

std::string Data(const std::string& name, const std::vector<double>& n,
                 const std::vector<double>& cosines, double unit) {
  std::string text = "$" + name + " << EOD\n";
  for (std::size_t i = 0; i < n.size(); ++i) {
    text += fmt::format("{:.9g} {:.6g}\n", n[i], cosines[i] / unit);
  }
  return text + "EOD\n";
}

std::string Script(const Certificate& certificate, const std::string& terminal) {
  std::vector<double> diodes;
  for (const FloorDiode& diode : certificate.floor.diodes) diodes.push_back(diode.n);
  const std::vector<double> n = Idealities(certificate);
  const std::vector<double> cosines = DualCosines(certificate, n);
  const double lowest = -*std::min_element(cosines.begin(), cosines.end());
  const double unit = lowest > 0 ? std::pow(10, std::floor(std::log10(lowest))) : 1;
  const PanelPage page(1, 1,
                       fmt::format("{}: floor {} A", certificate.curve.name,
                                   Scientific(certificate.floor.rmse_A, 10)),
                       LegendMark::kLineAndPoint, {"any diode", "diodes of the floor"}, 0);
  std::string script = Data("any", n, cosines, unit) +
                       Data("diodes", diodes, DualCosines(certificate, diodes), unit) +
                       page.Begin(terminal);
  script += page.Place(
      0, {"What a diode of ideality n could still gain: nothing above zero", "Ideality factor n",
          fmt::format("Cosine of dual vector and column ({:.0e})", unit)});
  script += fmt::format("set xrange [{:g}:{:g}]\nset autoscale y\n", certificate.options.n_lower,
                        certificate.options.n_upper);
  script += fmt::format(
      "plot 0 with lines lc rgb '#888888' notitle, $any with lines {} lw 2 notitle, "
      "$diodes with points {} pt {} ps {} notitle\n",
      LineLook(0), LineLook(1), PointLook(1), 2 * PointSize(terminal));
  return script + PanelPage::End();
}

}  // namespace

Expected<void> PlotCertificate(const Certificate& certificate, const std::string& path) {
  return DrawScript([&](const std::string& terminal) { return Script(certificate, terminal); },
                    path);
}

}  // namespace lyrefit

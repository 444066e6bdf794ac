#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "lyrefit/base/constants.h"
#include "lyrefit/curve/examined_readings.h"
#include "lyrefit/curve/technology.h"

namespace lyrefit {
namespace {

constexpr double kNarrowGap_eV = 0.9;  // cells below it may have less than kLowestCell_V
constexpr double kUsualCell_V = 0.62;
constexpr double kDim_W_m2 = 50;  // a cell may have a low voltage below this

// Whether a voltage may belong to one cell of several junctions as well as to a short string.
bool MayBeStack(double open_circuit_voltage_V, int cells) {
  return cells == 1 && open_circuit_voltage_V > kHighestCell_V &&
         open_circuit_voltage_V < kHighestStack_V;
}

constexpr int kCellsOfAModule = 150;  // most of one module; more are modules in series

constexpr char kStack[] =
    "or is this one cell of several junctions (a tandem: count them, --cells 2) or of a wide band "
    "gap";

// The highest voltage of a cell of the technology under the light and at the temperature of the
// curve. A temperature that nobody stated may be that of a cold morning.
double MostOfCell_V(const IvCurve& curve, const Technology& technology) {
  constexpr double kCold_K = kZeroCelsius_K - 25;
  const Conditions& at = curve.conditions;
  const double suns = curve.irradiance_known ? std::max(1.0, at.irradiance_W_m2 / 1000) : 1;
  return HighestVoc_V(technology, curve.temperature_known ? at.cell_temperature_K : kCold_K, suns);
}

// A voltage that fits a cell, but none of silicon, of which a module and a cell of some ampere are
// where nobody states another technology; or none of the stated technology.
void LookAtMaterial(const Examined& look, double cell_V, Findings* out) {
  constexpr double kLarge_A = 1, kConcentrated = 2;
  const IvCurve& curve = look.curve;
  const Technology* const known = FindTechnology(curve.notes.technology);
  const bool concentrated =
      curve.irradiance_known && curve.conditions.irradiance_W_m2 > 1000 * kConcentrated;
  const bool usually_silicon =
      (curve.conditions.cells_in_series > 1 || look.delivered_A > kLarge_A) && !concentrated &&
      curve.notes.technology.empty();
  if (known == nullptr && !usually_silicon) return;
  const Technology& of = known != nullptr ? *known : Silicon();
  const double most_V = MostOfCell_V(curve, of);
  if (!(cell_V > most_V)) return;
  const std::string cells =
      fmt::format("number of cells ({}; --cells)", curve.conditions.cells_in_series);
  out->push_back(
      {"technology",
       fmt::format("Voc is {:.3g} V a cell, and {} gives {:.2f} V at most{}", cell_V,
                   known != nullptr ? "a cell of " + std::string(of.name) : "one of silicon",
                   most_V,
                   known != nullptr
                       ? fmt::format(": is the {} or the technology (--technology) another?", cells)
                       : fmt::format(", which is taken where no technology is stated: give it "
                                     "(--technology CdTe, GaAs, perovskite, ...) or the right {}",
                                     cells)),
       false,
       {}});
}

}  // namespace

void LookAtCells(const Examined& look, Findings* out) {
  const IvCurve& curve = look.curve;
  const bool reached = look.key.open_circuit_voltage_V > 0;
  // If the sweep ends before open circuit, Voc is above its highest voltage.
  const double voc = reached ? look.key.open_circuit_voltage_V
                             : *std::max_element(curve.voltage_V.begin(), curve.voltage_V.end());
  if (!look.lit || !(voc > 0)) return;
  const int cells = curve.conditions.cells_in_series;
  const double per_cell = voc / cells;
  const bool dim = curve.irradiance_known && curve.conditions.irradiance_W_m2 < kDim_W_m2;
  const int likely = LikelyCells(voc);
  const Technology* const known = FindTechnology(curve.notes.technology);
  const double highest_V =
      std::max(kHighestCell_V, known != nullptr ? MostOfCell_V(curve, *known) : 0);
  const bool narrow = known != nullptr && known->bandgap_eV < kNarrowGap_eV;
  constexpr int kMillivoltFirst = 100;  // cells: more than a module has in series
  if (per_cell > highest_V && !curve.cells_known && !curve.voltage_unit_known &&
      likely >= kMillivoltFirst) {
    out->push_back({"cells",
                    fmt::format("{} {:.4g} V and the file names no unit: millivolt "
                                "(--voltage-unit mV)? or some {} cells in series (--cells)?",
                                reached ? "Voc is" : "the curve goes to", voc, likely),
                    false,
                    {}});
  } else if (per_cell > highest_V && !curve.cells_known) {
    out->push_back(
        {"cells",
         fmt::format("{} {:.4g} V: some {} cells in series{}? give their number (--cells)",
                     reached ? "Voc is" : "the curve goes to", voc, likely,
                     MayBeStack(voc, cells) ? fmt::format(", {}", kStack) : ""),
         false,
         {}});
  } else if (per_cell > highest_V || (reached && per_cell < kLowestCell_V && !dim && !narrow)) {
    const std::string stated =
        curve.cells_known ? fmt::format("each of {} stated cells", cells) : "one cell";
    const std::string each =
        per_cell < 1 ? fmt::format("{:.3g} mV", 1e3 * per_cell) : fmt::format("{:.4g} V", per_cell);
    const std::string instead =
        MayBeStack(voc, cells)
            ? fmt::format(": were cells in series forgotten (--cells {}), {}?", likely, kStack)
        : likely > kCellsOfAModule && likely != cells
            ? fmt::format(": give the cells of all modules in series (--cells, near {})?", likely)
        : likely != cells ? fmt::format(": give --cells {}?", likely)
                          : ": is the unit right?";
    out->push_back({"cells",
                    fmt::format("{} {:.4g} V: {} for {}, and a cell at light has {:g} to {:g} V{}",
                                reached ? "Voc is" : "the curve goes to", voc, each, stated,
                                kLowestCell_V, highest_V, instead),
                    curve.cells_known,
                    {}});
  } else {
    LookAtMaterial(look, per_cell, out);
  }
}

int LikelyCells(double open_circuit_voltage_V) {
  const double cells = open_circuit_voltage_V / kUsualCell_V;
  constexpr double kTolerance = 0.1;
  int likely = std::max(1, static_cast<int>(std::lround(std::min(cells, 1e6))));
  double nearest = kTolerance;
  for (const int usual : {36, 54, 60, 72, 96}) {
    const double distance = std::fabs(usual / cells - 1);
    if (distance < nearest) likely = usual;
    nearest = std::min(nearest, distance);
  }
  return likely;
}

}  // namespace lyrefit

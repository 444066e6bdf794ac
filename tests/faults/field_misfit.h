#pragma once

#include <vector>

namespace faults::field {

// Single-diode curve of a whole module: A, S, ohm. `scale_V` is n Ns kT/q in V.
struct OneDiode {
  double photocurrent = 0;
  double saturation_A = 0;
  double scale_V = 1;
  double series_ohm = 0;
  double shunt_S = 0;
};

double CurrentOf(const OneDiode& diode, double voltage, double guess);

struct OneDiodeFit {
  OneDiode diode;
  double rms = 0;                 // of the current, A
  std::vector<double> residuals;  // model - given, A
};

// Approximately the best single diode in rms current. Three of the five parameters are linear once
// the measured currents are used in the exponent. A Nelder-Mead simplex searches the other two.
OneDiodeFit BestOneDiode(const std::vector<double>& voltage, const std::vector<double>& current);

}  // namespace faults::field

#pragma once

#include <vector>

namespace hidden::field {

// A curve of one diode: A, S, ohm and, for the exponent's scale, V of the whole module.
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
  std::vector<double> residuals;  // model - given
};

// The best one near enough: of the five parameters three are linear once the currents in the
// exponent are taken as given; the other two are searched by a simplex.
OneDiodeFit BestOneDiode(const std::vector<double>& voltage, const std::vector<double>& current);

}  // namespace hidden::field

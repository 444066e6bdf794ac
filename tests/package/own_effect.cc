#include <lyrefit/lyrefit.h>
#include <iostream>

// A user-defined effect: a shunt that grows with the square of the voltage. Each stage of an effect
// is one template over the number type. Each parameter has bounds, and 0 means no effect unless
// stated otherwise.
lyrefit::Effect SquareShunt() {
  lyrefit::Effect e;
  e.id = "square_shunt";
  e.parameters = {
      lyrefit::Parameter("s", "strength", "current at 1 V, in parts of Isc").Between(0, 1)};
  e.junction = [](const auto* p, const auto&, const auto&, const auto& voltage) {
    return -(abs(voltage) * voltage) * p[0];
  };
  e.probes = [](const lyrefit::DataTraits&) { return std::vector<lyrefit::Probe>{{0.02}}; };
  return e;
}

int main() {
  const lyrefit::Effect own = SquareShunt();
  const auto curve = lyrefit::ReadCurve("data/rtc_france");
  if (!curve) return std::cerr << curve.error().ToString() << '\n', 1;
  lyrefit::FitOptions options;
  options.with = {{&own, {}}, {lyrefit::FindEffect("second_diode"), {}}};
  const auto report = lyrefit::Fit(*curve, options);
  if (!report) return std::cerr << report.error().ToString() << '\n', 1;
  std::cout << lyrefit::FullReport(*report);
}

#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "plant/scale_judge.h"

namespace lyrefit {

// Strings of diodes without a shunt, whose voltage is an explicit function of the current.

// A module of 60 cells and three bypass diodes.
struct ExplicitModule {
  double photocurrent = 8;
  double voc_V = 37;  // at 8 A and 45 C
  double series_ohm = 0.3;
  double celsius = 45;

  double VoltageAt(double current) const {
    const double kelvin = celsius + 273.15;
    const double a = 1.1 * 60 * 8.617333e-5 * kelvin;
    // Voc falls by (1.21 V - Voc / 60) / T a cell and kelvin.
    const double voc = voc_V - (celsius - 45) * (60 * 1.21 - voc_V) / 318.15;
    return voc + a * std::log((photocurrent - current) / 8) - current * series_ohm;
  }
};

// Key figures of a string whose voltage falls with the current.
inline StringFigures FiguresOfLaw(const std::function<double(double)>& voltage,
                                  double photocurrent) {
  StringFigures figures;
  figures.isc_A = photocurrent * (1 - 1e-9);
  figures.voc_V = voltage(0);
  figures.slope_ohm = (voltage(-1e-4) - voltage(1e-4)) / 2e-4;
  double most = 0;
  for (int i = 1; i < 5000; ++i) {
    const double current = photocurrent * (0.5 + 0.5 * i / 5000);
    if (current * voltage(current) <= most) continue;
    most = current * voltage(current);
    figures.imp_A = current;
    figures.vmp_V = voltage(current);
  }
  return figures;
}

// `modules` of one type, `parallel` such strings.
inline StringFigures FiguresOfModules(const ExplicitModule& module, double modules, double ohm = 0,
                                      int parallel = 1) {
  StringFigures f = FiguresOfLaw(
      [&](double current) { return modules * module.VoltageAt(current) - current * ohm; },
      module.photocurrent);
  f.isc_A *= parallel;
  f.imp_A *= parallel;
  f.slope_ohm /= parallel;
  return f;
}

// A combiner of ten strings of 20 modules in like light. They differ from their plan by at most half
// of the usual errors, in a fixed pattern.
inline std::vector<ScaleMember> TenStrings(bool planned, int parallel = 1) {
  std::vector<ScaleMember> group;
  for (int i = 0; i < 10; ++i) {
    ScaleMember member;
    member.id = "site/comb/str" + std::to_string(i);
    member.irradiance_W_m2 = 800;
    member.temperature_C = 45;
    member.cells = 1200;
    member.measured = FiguresOfModules({}, 20, 0.2, parallel);
    member.measured.isc_A *= 1 + 0.003 * std::sin(2.0 * i);
    member.measured.imp_A *= 1 + 0.003 * std::sin(2.0 * i);
    const double voltage = 1 + 0.0015 * std::sin(3.0 * i + 1);
    member.measured.voc_V *= voltage;
    member.measured.vmp_V *= voltage;
    if (planned) {
      member.planned = FiguresOfModules({}, 20, 0, parallel);
      member.modules = 20;
      member.strings = parallel;
      member.module = "Elm";
    }
    group.push_back(member);
  }
  return group;
}

}  // namespace lyrefit

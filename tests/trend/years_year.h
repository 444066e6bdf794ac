#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "trend/years_effects.h"
#include "trend/years_instruments.h"
#include "trend/years_split.h"

namespace years {

struct Request {
  std::uint64_t seed = 1;
  int days = 365;
  double minutes = 30;
  int points = 60;
  bool random = false;        // draw the effects
  Effects effects;            // unless they are drawn
  bool perfect = false;       // no errors of instruments, no gaps, no bad sweeps
  bool clock_change = false;  // the clock is set forward from April to October
};

struct Row {
  std::string date;
  Shown shown;
  Sweep sweep;  // empty: the logger wrote none
  Held held;
};

// A gap of the record, days since the start, both included.
struct Gap {
  int first, last;
};

struct Daily {
  Split energy;        // Wh
  State state;         // at noon
  Operating standard;  // maximum power at 1000 W/m2 and 25 C
};

struct ModuleYear {
  Design design;
  Effects effects;
  Instruments instruments;
  Inverter inverter;
  std::vector<Row> rows;  // in order of time
  std::vector<Gap> gaps;
  std::vector<Day> weather;
  std::vector<Daily> daily;
  Split recorded, whole;        // energies in Wh of the rows, and with the gaps
  int bad = 0, missing = 0;     // spoilt and empty sweeps
  int modes[4] = {0, 0, 0, 0};  // rows by Mode
};

ModuleYear Simulate(const Request& request, const Measured& measured);

// "2025-03-05", of days since the first of January 2025.
std::string DateOf(int day);
std::string SweepsCsv(const ModuleYear& year);
std::string OperatingCsv(const ModuleYear& year);
std::string TruthJson(const Request& request, const ModuleYear& year);

}  // namespace years

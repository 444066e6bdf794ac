#include "lyrefit/effects/odd_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace lyrefit {
namespace {

constexpr int kCurrents = 48;
constexpr double kBlocking_V = 60;  // soft voltage of cells that hardly conduct in reverse

// Currents at equal steps, and the voltage of the measured module at each.
struct MeasuredStairs {
  double full = 0;  // current of the first plateau
  double current[kCurrents];
  double voltage[kCurrents];
};

MeasuredStairs MeasureStairs(const CurveShape& shape, double cells) {
  constexpr double kFirst = 0.03, kLast = 0.97;  // of the full current
  MeasuredStairs stairs;
  stairs.full = shape.At(0.02);
  const int steps = static_cast<int>(shape.current.size()) - 1;
  int at = steps;
  for (int i = 0; i < kCurrents; ++i) {
    stairs.current[i] = stairs.full * (kFirst + (kLast - kFirst) * i / (kCurrents - 1));
    while (at > 0 && shape.current[at] < stairs.current[i]) --at;
    stairs.voltage[i] = cells * shape.open_circuit * at / std::max(steps, 1);
  }
  return stairs;
}

// Rough voltages of the cells at the currents.
class RoughCells {
 public:
  RoughCells(const MeasuredStairs& stairs, double open_circuit)
      : stairs_(stairs), open_circuit_(open_circuit) {
    for (int i = 0; i < kCurrents; ++i) bright_[i] = Forward(stairs.full - stairs.current[i], i);
  }
  void SetDim(const std::vector<double>& deficits, const DimPlaces& guess) {
    dim_.resize(deficits.size());
    for (std::size_t k = 0; k < deficits.size(); ++k) {
      for (int i = 0; i < kCurrents; ++i) {
        const double room = (1 - deficits[k]) * stairs_.full - stairs_.current[i];
        const double beyond = guess.chains * std::max(-room, 0.0) / stairs_.full;
        dim_[k][i] = room > 0 ? Forward(room, i)
                              : -guess.soft_voltage * std::pow(beyond, 1 / guess.exponent);
      }
    }
  }
  // Area between the curves, over volts and parts of the full current.
  double AreaOf(const DimPlaces& guess, double cells, int in_module, int counted) const {
    constexpr double kBypassDrop = 0.5;
    double area = 0;
    for (int i = 0; i < kCurrents; ++i) {
      double sum = 0;
      for (int s = 0; s < in_module; ++s) {
        double voltage = cells / in_module * bright_[i];
        bool dim = false;
        for (std::size_t k = 0; s < counted && k < dim_.size(); ++k) {
          if (guess.places[k] != s) continue;
          voltage += dim_[k][i] - bright_[i];
          dim = true;
        }
        sum += dim && in_module > 1 ? std::max(voltage, -kBypassDrop) : voltage;
      }
      area += std::fabs(sum - stairs_.voltage[i]) / kCurrents;
    }
    return area;
  }

 private:
  double Forward(double room, int i) const {
    constexpr double kThermal = 0.03, kLeast = 1e-3, kOhm = 0.015;  // V, scales, V at full current
    return open_circuit_ + kThermal * std::log(std::max(room / stairs_.full, kLeast)) -
           kOhm * stairs_.current[i] / stairs_.full;
  }

  const MeasuredStairs& stairs_;
  double open_circuit_;
  double bright_[kCurrents];
  std::vector<std::array<double, kCurrents>> dim_;
};

// Calls `add` for every way to distribute cells over like substrings.
void ForPlaces(std::size_t cells, int substrings, std::vector<int>* places,
               const std::function<void(const std::vector<int>&)>& add) {
  if (places->size() == cells) return add(*places);
  const int next = places->empty() ? 0 : *std::max_element(places->begin(), places->end()) + 1;
  for (int place = 0; place <= std::min(next, substrings - 1); ++place) {
    places->push_back(place);
    ForPlaces(cells, substrings, places, add);
    places->pop_back();
  }
}

}  // namespace

std::vector<double> PlateauDeficits(const CurveShape& shape, int most) {
  constexpr double kLeast = 0.02, kMost = 0.97;
  const double full = shape.At(0.02);
  std::vector<double> deficits;
  if (!(full > 0)) return deficits;
  const auto add = [&](double current) {
    const double deficit = 1 - current / full;
    if (deficit > kLeast) deficits.push_back(std::min(deficit, kMost));
  };
  for (const Plateau& plateau : StairsOf(shape).plateaus) add(plateau.current);
  if (deficits.empty()) {
    for (const double place : {0.93, 0.7, 0.45}) add(shape.At(place));
  }
  if (deficits.size() == 1) deficits.push_back(0.5 * deficits.front());
  std::sort(deficits.begin(), deficits.end(), std::greater<>());
  if (deficits.size() > static_cast<std::size_t>(most)) deficits.resize(most);
  return deficits;
}

std::vector<DimPlaces> GuessDimPlaces(const CurveShape& shape, const DataTraits& traits,
                                      const std::vector<double>& deficits, int substrings,
                                      std::size_t most) {
  std::vector<DimPlaces> guesses;
  if (deficits.empty() || !(shape.At(0.02) > 0)) return guesses;
  const double cells = traits.cells;
  const int in_module = SubstringsOf(traits);
  const MeasuredStairs stairs = MeasureStairs(shape, cells);
  RoughCells rough(stairs, shape.open_circuit);
  const auto add = [&](DimPlaces guess) {
    rough.SetDim(deficits, guess);
    std::vector<int> places;
    ForPlaces(deficits.size(), std::min(in_module, substrings), &places, [&](const auto& chosen) {
      guess.places = chosen;
      guess.area = rough.AreaOf(guess, cells, in_module, substrings);
      guesses.push_back(guess);
    });
  };
  for (const int chains : {1, 2}) {
    if (deficits.front() * chains > 0.98) continue;
    for (const double exponent : {3.4, 7.0}) {
      for (const double voltage : {2.5, 4.0, 6.0, 9.0, 14.0, 22.0}) {
        add({{}, chains, voltage, exponent, 0});
      }
    }
    add({{}, chains, kBlocking_V, 8, 0});
  }
  std::stable_sort(guesses.begin(), guesses.end(),
                   [](const DimPlaces& a, const DimPlaces& b) { return a.area < b.area; });
  // At most two guesses of the same places: they differ in the reverse law only. The nearest one
  // of cells that block comes last.
  std::vector<DimPlaces> best;
  const DimPlaces* blocking = nullptr;
  for (const DimPlaces& guess : guesses) {
    if (guess.soft_voltage == kBlocking_V) {
      if (blocking == nullptr) blocking = &guess;
      continue;
    }
    const auto same = std::count_if(best.begin(), best.end(), [&](const DimPlaces& other) {
      return other.places == guess.places && other.chains == guess.chains;
    });
    if (same < 2 && best.size() + 1 < most) best.push_back(guess);
  }
  if (blocking != nullptr) best.push_back(*blocking);
  return best;
}

namespace {

// Sum of the distances of the steps from the ends of the substrings, in parts of the voltage. A
// step is found a little below such an end: bypass diodes take some voltage, and so does the knee.
double Distance(const std::vector<double>& steps, const ThreeShares& shares) {
  constexpr double kBelow = 0.05;
  double sum = 0;
  for (std::size_t k = 0; k + 1 < steps.size(); ++k) {  // the last one is open circuit
    const double place = steps[k] + kBelow;
    sum += std::min(std::fabs(place - shares[0]), std::fabs(place - shares[0] - shares[1]));
  }
  return sum;
}

}  // namespace

std::vector<ThreeShares> UnlikeShares(const CurveShape& shape, const DataTraits& traits,
                                      double nearly) {
  const bool three =
      traits.substrings == 3 || (traits.substrings == 0 && SubstringsOf(traits) == 3);
  std::vector<ThreeShares> unlike;
  if (!three || traits.cells % 4 != 0) return unlike;
  const std::vector<double> steps = StairsOf(shape).steps;
  const double alike = Distance(steps, {1.0 / 3, 1.0 / 3, 1.0 / 3}) + nearly;
  for (const ThreeShares& shares :
       {ThreeShares{0.5, 0.25, 0.25}, {0.25, 0.5, 0.25}, {0.25, 0.25, 0.5}}) {
    if (Distance(steps, shares) < alike) unlike.push_back(shares);
  }
  return unlike;
}

}  // namespace lyrefit

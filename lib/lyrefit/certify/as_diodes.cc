#include "lyrefit/certify/as_diodes.h"

#include <algorithm>
#include <cmath>

namespace lyrefit {
namespace {

constexpr double kSlack = 1e-12;        // relative tolerance of Is and of u
constexpr double kSmallestIs = 1e-305;  // ampere; smaller doubles lose digits

bool Inside(double u, const Window& window) {
  return u >= window.lower * (1 - kSlack) && u <= window.upper * (1 + kSlack);
}

// Divides the Is of one atom among its diodes: first the lower end of each range, then the rest in
// order up to the upper ends. False if that is impossible.
bool Share(const std::vector<int>& atom_of, int atom, double u, double saturation_A,
           const std::vector<Window>& windows, std::vector<DiodeValues>* diodes) {
  double rest = saturation_A;
  int last = -1;
  for (std::size_t d = 0; d < windows.size(); ++d) {
    if (atom_of[d] != atom) continue;
    if (!Inside(u, windows[d])) return false;
    (*diodes)[d] = {u, windows[d].saturation_lower_A};
    rest -= windows[d].saturation_lower_A;
    last = static_cast<int>(d);
  }
  if (last < 0 || rest < -kSlack * saturation_A) return false;
  for (std::size_t d = 0; d < windows.size(); ++d) {
    if (atom_of[d] != atom) continue;
    const Window& window = windows[d];
    const double room = window.saturation_upper_A - window.saturation_lower_A;
    const double more = std::min(std::max(rest, 0.0), room);
    (*diodes)[d].saturation_A += more;
    rest -= more;
  }
  return rest <= kSlack * saturation_A;
}

}  // namespace

std::optional<std::vector<DiodeValues>> AsDiodes(const Mixture& mixture,
                                                 const std::vector<Window>& windows) {
  const int atoms = static_cast<int>(mixture.atoms.size());
  std::vector<double> saturation_A;
  for (const Atom& atom : mixture.atoms) {
    saturation_A.push_back(atom.current_A / std::expm1(atom.u * mixture.reference_voltage_V));
    if (!(saturation_A.back() >= kSmallestIs)) return std::nullopt;
  }
  if (atoms > static_cast<int>(windows.size())) return std::nullopt;
  std::vector<int> atom_of(windows.size(), -1);  // -1: the diode carries no current
  while (true) {
    std::vector<DiodeValues> diodes(windows.size());
    bool fits = true;
    for (std::size_t d = 0; d < windows.size(); ++d) {
      diodes[d].u = windows[d].lower;
      fits = fits && (atom_of[d] >= 0 || windows[d].saturation_lower_A <= 0);
    }
    for (int j = 0; j < atoms && fits; ++j) {
      fits = Share(atom_of, j, mixture.atoms[j].u, saturation_A[j], windows, &diodes);
    }
    if (fits) return diodes;
    std::size_t d = 0;
    while (d < atom_of.size() && ++atom_of[d] == atoms) atom_of[d++] = -1;
    if (d == atom_of.size()) return std::nullopt;
  }
}

}  // namespace lyrefit

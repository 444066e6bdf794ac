#include "lyrefit/curve/technology.h"

#include <cctype>
#include <cmath>
#include <string_view>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/number_text.h"
#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {
namespace {

// Gaps and slopes of silicon, CdTe and CIGS: De Soto et al. 2006, doi:10.1016/j.solener.2005.06.010,
// and pvlib's calcparams_desoto. III-V, Ge: Vurgaftman et al. 2001, doi:10.1063/1.1368156.
// Perovskite: Green et al. 2014, doi:10.1038/nphoton.2014.134. PVsyst's gaps: its help, "PV module,
// standard one-diode model"; the sum of the gaps of several junctions reproduces the Pmp and
// muPmpReq of published files.
// Highest voltages. Silicon: limit by Auger recombination, Richter et al. 2013,
// doi:10.1109/JPHOTOV.2013.2270351; the best cells have 0.75 V. Others: the limit by radiation for
// the gap, Ruehle 2016, doi:10.1016/j.solener.2016.02.015, of alloys that for the widest gap in use;
// a-Si, organic and dye cells, which stay far below it, a tenth above the best of the efficiency
// tables, Green et al. 2024, doi:10.1002/pip.3831.
// Largest idealities. Silicon: edges, doi:10.2478/s11772-013-0095-5. Thin films, organic and
// perovskite: doi:10.1103/PhysRevApplied.14.024031. III-V: recombination in the junction, n = 2.
constexpr double kSiliconGap_eV = 1.121, kSiliconSlope = -0.0002677, kSiliconVoc_V = 0.761;
constexpr double kSiliconN = 1.6, kFilmN = 2.2, kThreeFiveN = 2;
constexpr double kStated_K = 298.15;  // of gaps and voltages

// clang-format off
// The first row is taken of which a word is in the text: the narrower names come first.
constexpr Technology kTechnologies[] = {
    {"HJT", "hit|hjt|shj|si+heterojunc|silicon+heterojunc|a-si+mono", true, 1, kSiliconGap_eV, kSiliconSlope, kSiliconN, kSiliconVoc_V,
     "mtHIT", 1.12, {0.04, 0.015, -0.25, 0.02, -0.26}},
    {"micromorph", "ucsi_asi|micromorph|uc-si+a-si|nc-si+a-si", false, 2, 1.42, -0.0003, kFilmN, 1.6,
     "mtuCSi_aSiH", 1.7},
    {"a-Si triple", "asih_trip|asi+trip|a-si+trip|amorph+trip|3-a-si", false, 3, 1.5, -0.0003, kFilmN, 2.6, "mtaSiH_Triple", 1.7},
    {"a-Si tandem", "asih_tandem|asi+tandem|a-si+tandem|amorph+tandem|2-a-si", false, 2, 1.7, -0.0003, kFilmN, 2.1, "mtaSiH_Tandem", 1.7},
    {"perovskite/Si", "perovsk+tandem|perovsk+silicon|perovsk+si", false, 2, 1.4, 0, kFilmN, 2.2, nullptr, 1.4},
    {"triple junction", "trip|3j|three-junction|multi-junction|multijunction|cpv|ingap+ge|gainp+ge", false, 3, 1.32, -0.0004,
     kThreeFiveN, 3.5, nullptr, 1.32},
    {"tandem", "tandem|2j|two-junction|two junction|dual-junction|dual junction|ingap+gaas|gainp+gaas", false, 2, 1.5, -0.0003, kFilmN, 2.8,
     nullptr, 1.7},
    {"CdTe", "cdte|cadmium", false, 1, 1.475, -0.0003, kFilmN, 1.22, "mtCdTe", 1.5,
     {0.04, 0.02, -0.28, 0.03, -0.29}},
    {"CIGS", "cigs|cis|copper indium|chalcopyrit", false, 1, 1.15, -0.00011, kFilmN, 1.0, "mtCIS", 1.03,
     {0.01, 0.02, -0.30, 0.04, -0.36}, 1.0, 1.7},
    {"a-Si", "a-si|asi|asih|asih_single|amorph", false, 1, 1.75, -0.0003, kFilmN, 1.1, "mtaSiH_Single", 1.7,
     {0.09, 0.03, -0.31, 0.03, -0.22}},
    {"perovskite", "perovsk", false, 1, 1.6, 0.0003, kFilmN, 1.65, nullptr, 1.6, {0.0, 0.05, -0.15, 0.08, -0.2}, 1.2, 2.3},
    {"organic", "organic|opv|polymer", false, 1, 1.4, 0, kFilmN, 1.3, nullptr, 1.4, {}, 1.2, 2.0},
    {"dye", "dye|dssc", false, 1, 1.6, 0, kFilmN, 1.3, nullptr, 1.6},
    {"InGaAs", "ingaas|gainas", false, 1, 0.74, -0.0005, kThreeFiveN, 0.53, nullptr, 0.74, {}, 0.5, 0.75},
    {"GaSb", "gasb|tpv|thermophotovolt", false, 1, 0.726, -0.0005, kThreeFiveN, 0.51, nullptr, 0.726},
    {"GaAs", "gaas|gallium arsenide|iii-v", false, 1, 1.424, -0.00032, kThreeFiveN, 1.17, nullptr, 1.424},
    {"Ge", "ge|germanium", false, 1, 0.66, -0.00056, kThreeFiveN, 0.45, nullptr, 0.66},
    {"PERC", "perc|ibc", true, 1, kSiliconGap_eV, kSiliconSlope, kSiliconN, kSiliconVoc_V, "mtSiMono", 1.12,
     {0.05, 0.015, -0.28, 0.02, -0.36}},
    {"TOPCon", "topcon", true, 1, kSiliconGap_eV, kSiliconSlope, kSiliconN, kSiliconVoc_V, "mtSiMono", 1.12,
     {0.045, 0.015, -0.25, 0.015, -0.31}},
    {"poly-Si", "poly|multi", true, 1, kSiliconGap_eV, kSiliconSlope, kSiliconN, kSiliconVoc_V, "mtSiPoly", 1.12,
     {0.05, 0.02, -0.31, 0.03, -0.41}},
    {"c-Si", "mono|crystal|silicon|al-bsf|simono|heterojunc|si", true, 1, kSiliconGap_eV, kSiliconSlope, kSiliconN, kSiliconVoc_V,
     "mtSiMono", 1.12, {0.05, 0.02, -0.31, 0.03, -0.41}},
};
// clang-format on

bool IsLetter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

// Whether `word` is in `text`; one of three letters and fewer only as a word of its own.
bool Holds(std::string_view text, std::string_view word) {
  constexpr std::size_t kShort = 3;
  for (std::size_t at = text.find(word); at != std::string_view::npos;
       at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    const bool own =
        (at == 0 || !IsLetter(text[at - 1])) && (end == text.size() || !IsLetter(text[end]));
    if (word.size() > kShort || own) return true;
  }
  return false;
}

// Calls `f` with each part of `text` between `mark`s until it gives true; whether one did.
template <class F>
bool AnyPart(std::string_view text, char mark, const F& f) {
  while (true) {
    const std::size_t end = text.find(mark);
    if (f(text.substr(0, end))) return true;
    if (end == std::string_view::npos) return false;
    text.remove_prefix(end + 1);
  }
}

}  // namespace

const Technology* FindTechnology(const std::string& text) {
  std::string name = LowerCase(text);
  if (name.rfind("mt", 0) == 0) name.erase(0, 2);  // PVsyst's: "mtSiMono"
  for (const Technology& one : kTechnologies) {
    const bool named = AnyPart(one.words, '|', [&](std::string_view words) {
      return !AnyPart(words, '+', [&](std::string_view word) { return !Holds(name, word); });
    });
    if (named) return &one;
  }
  return nullptr;
}

const Technology& Silicon() { return *(std::end(kTechnologies) - 1); }

double HighestVoc_V(const Technology& technology, double temperature_K, double suns) {
  const double thermal_V = technology.junctions * ThermalVoltage(temperature_K);
  const double gap_V = technology.junctions * technology.bandgap_eV *
                       (1 - kStated_K * technology.bandgap_slope_per_K);
  const double cold = temperature_K / kStated_K;
  return gap_V - (gap_V - technology.most_Voc_V) * cold + thermal_V * std::log(suns);
}

std::string TechnologyNames() {
  std::string names;
  for (const Technology& one : kTechnologies) {
    names += (names.empty() ? "" : ", ") + std::string(one.name);
  }
  return names;
}

bool IsThinFilm(const std::string& technology) {
  const Technology* const known = FindTechnology(technology);
  return known != nullptr ? !known->silicon
                          : LowerCase(technology).find("thin") != std::string::npos;
}

int JunctionsPerCell(const std::string& technology) {
  const Technology* const known = FindTechnology(technology);
  return known != nullptr ? known->junctions : 1;
}

}  // namespace lyrefit

#pragma once

#include <optional>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/error.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

struct DataSheet;

// Where the members end towards larger n: beyond it this would be negative.
enum class FamilyBound { kSeriesResistance, kShuntConductance };

template <>
struct EnumTable<FamilyBound> {
  static constexpr EnumText<FamilyBound> kRows[] = {
      {FamilyBound::kSeriesResistance, "series_resistance"},
      {FamilyBound::kShuntConductance, "shunt_conductance"}};
};

// Light and cell temperature that members are carried to by De Soto's law.
struct MemberConditions {
  double irradiance_W_m2 = 0;
  double temperature_C = 0;
};

// A single diode whose curve passes through a sheet's three points, with its largest power at the
// third. Parameters at 1000 W/m2 and 25 C.
struct DataSheetMember {
  double n = 0;                          // ideality, per cell
  double photocurrent_A = 0;             // Iph
  double saturation_current_A = 0;       // Is
  double resistance_series_ohm = 0;      // Rs
  double resistance_shunt_ohm = 0;       // Rsh, infinite at the bound of the shunt
  double beta_oc_V_K = 0;                // of Voc from 25 to 27 C, by De Soto's law
  double gamma_pmp_percent_K = 0;        // of Pmp at 25 C, by the same
  std::vector<double> max_power_W = {};  // under each of the family's conditions
  // Largest distance of its curve, from 0 V to Voc, from that of the member that beta_oc picks; NaN
  // where none is picked.
  double difference_A = kUnknown;
};

// How far members are apart that share three points.
struct MemberSpread {
  double difference_A = 0;                  // largest distance of two curves between 0 V and Voc
  double difference_percent = 0;            // of Isc
  double at_V = 0;                          // where that is
  std::vector<double> lowest_power_W = {};  // of the members, under each of the conditions
  std::vector<double> highest_power_W = {};
};

// What members come to as n goes to 0: a broken line through the three points, of a diode that
// conducts nothing below Voc and everything above.
struct SharpKnee {
  double photocurrent_A = 0;         // Iph
  double resistance_series_ohm = 0;  // Rs = (Voc - Vmp) / Imp
  double resistance_shunt_ohm = 0;   // Rsh
};

// All single diodes through the three points of a sheet: one for every n above 0 and up to that of
// the last member, where `bound` ends them.
struct DataSheetFamily {
  FamilyBound bound = FamilyBound::kSeriesResistance;
  SharpKnee sharp_knee;
  std::vector<MemberConditions> conditions;
  std::vector<DataSheetMember> members;  // by rising n in even steps; of the last Rs or 1/Rsh is 0
  MemberSpread spread;                   // curves: sharp knee and members; powers: members
  // What beta_oc makes of them, in a DataSheetFit: the member that it picks, and those at the ends
  // of the n that the rounding of the sheet allows, where a rounding is stated.
  std::optional<DataSheetMember> picked;
  std::optional<DataSheetMember> rounding_low;
  std::optional<DataSheetMember> rounding_high;
  std::optional<MemberSpread> rounding_spread;  // of these two and the picked one
};

// The family of a sheet, by its three points, cells and alpha_sc; beta_oc is not needed. Three
// points with a flat power at the third are four equations for five parameters: for given n and
// Rs three of them are linear in Iph, Is and 1/Rsh, the fourth gives Rs, and n is left over
// (Cardenas-Bravo, Dutykh and Lespinats 2024, arXiv:2407.07108, whose inequalities Voc < 2 Vmp and
// Isc < 2 Imp are those of CheckDataSheetPoints). Errors: values that no illuminated diode has; a
// knee so sharp that n would have to be below that of Voc = 200 n Ns k T / q.
Expected<DataSheetFamily> FindDataSheetFamily(const DataSheet& sheet,
                                              ConstantSet constants = ConstantSet::kCodata);

// The member with this n. Errors: those of the family; an n that no member has, with the largest.
Expected<DataSheetMember> FindDataSheetMember(const DataSheet& sheet, double n,
                                              ConstantSet constants = ConstantSet::kCodata);

}  // namespace lyrefit

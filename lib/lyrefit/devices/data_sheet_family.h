// Experimental: may change in a minor version (data/stable).
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

// The quantity that bounds the family towards larger n: it would be negative beyond the last
// member.
enum class FamilyBound { kSeriesResistance, kShuntConductance };

template <>
struct EnumTable<FamilyBound> {
  static constexpr EnumText<FamilyBound> kRows[] = {
      {FamilyBound::kSeriesResistance, "series_resistance"},
      {FamilyBound::kShuntConductance, "shunt_conductance"}};
};

// Irradiance and cell temperature for which the power of each member is computed by De Soto's law.
struct MemberConditions {
  double irradiance_W_m2 = 0;
  double temperature_C = 0;
};

// A single diode whose curve passes through a sheet's three points, with its maximum power at the
// third. Parameters are at 1000 W/m2 and 25 C.
struct DataSheetMember {
  double n = 0;                          // ideality, per cell
  double photocurrent_A = 0;             // Iph
  double saturation_current_A = 0;       // Is
  double resistance_series_ohm = 0;      // Rs
  double resistance_shunt_ohm = 0;       // Rsh, infinite at the bound of the shunt
  double beta_oc_V_K = 0;                // secant of Voc from 25 to 27 C, by De Soto's law
  double gamma_pmp_percent_K = 0;        // of Pmp at 25 C, by De Soto's law
  std::vector<double> max_power_W = {};  // under each of the family's conditions
  // Largest current difference, between 0 V and Voc, from the member that beta_oc selects; NaN if
  // none is selected.
  double difference_A = kUnknown;
};

// Largest differences among members that share three points.
struct MemberSpread {
  double difference_A = 0;                  // largest current difference between 0 V and Voc
  double difference_percent = 0;            // `difference_A` in percent of Isc
  double at_V = 0;                          // voltage of `difference_A`
  std::vector<double> lowest_power_W = {};  // over the members, under each condition
  std::vector<double> highest_power_W = {};
};

// Limit of the members as n goes to 0: a broken line through the three points. Its diode conducts
// no current below Voc and any current above.
struct SharpKnee {
  double photocurrent_A = 0;         // Iph
  double resistance_series_ohm = 0;  // Rs = (Voc - Vmp) / Imp
  double resistance_shunt_ohm = 0;   // Rsh
};

// All single diodes through the three points of a sheet. There is one for every n above 0 up to the
// last member, where `bound` ends the family.
struct DataSheetFamily {
  FamilyBound bound = FamilyBound::kSeriesResistance;
  SharpKnee sharp_knee;
  std::vector<MemberConditions> conditions;
  std::vector<DataSheetMember> members;  // by rising n in even steps; the last has Rs or 1/Rsh = 0
  MemberSpread spread;                   // difference: sharp knee and members; powers: members
  // Filled in a DataSheetFit only: the member that beta_oc selects. If the sheet states its
  // rounding, also the members at both ends of the range of n that the rounding allows.
  std::optional<DataSheetMember> picked;
  std::optional<DataSheetMember> rounding_low;
  std::optional<DataSheetMember> rounding_high;
  std::optional<MemberSpread> rounding_spread;  // of these two and the selected member
};

// Finds the family of a sheet from its three points, number of cells and alpha_sc; beta_oc is not
// needed. Three points and zero slope of the power at the third are four equations for five
// parameters. For given n and Rs three of them are linear in Iph, Is and 1/Rsh; the fourth gives
// Rs, and n remains free (Cardenas-Bravo, Dutykh and Lespinats 2024, arXiv:2407.07108).
// CheckDataSheetPoints uses that paper's inequalities Voc < 2 Vmp and Isc < 2 Imp. Errors: values
// that no illuminated diode has; a knee so sharp that n would have to be below the n of Voc = 200 n
// Ns k T / q.
Expected<DataSheetFamily> FindDataSheetFamily(const DataSheet& sheet,
                                              ConstantSet constants = ConstantSet::kCodata);

// Finds the member with the given n. Errors: those of FindDataSheetFamily; an n that no member has;
// the message states the largest n.
Expected<DataSheetMember> FindDataSheetMember(const DataSheet& sheet, double n,
                                              ConstantSet constants = ConstantSet::kCodata);

}  // namespace lyrefit

#include "lyrefit/read/write_pan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

#include "lyrefit/base/try.h"
#include "lyrefit/base/version.h"
#include "lyrefit/curve/technology.h"
#include "lyrefit/model/default_values.h"
#include "lyrefit/model/model_points.h"
#include "lyrefit/model/pvlib_parameters.h"

namespace lyrefit {
namespace {

constexpr int kDigits = 12;  // of Voc: I_o follows from exp(Voc / a), which is sharp
constexpr double kSameValue = 1e-9;

bool SameValue(double a, double b) { return std::fabs(a / b - 1) <= kSameValue; }

// A number without an exponent, which not every reader takes.
std::string Plain(double value) {
  if (value == 0) return "0";
  const int whole = static_cast<int>(std::floor(std::log10(std::fabs(value)))) + 1;
  std::string text = fmt::format("{:.{}f}", value, std::clamp(kDigits - whole, 0, 30));
  if (text.find('.') == std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

// On one line, without the characters that structure the file.
std::string OnOneLine(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  }
  return text;
}

// The technology that the file names: the stated one, or a usual one with this band gap.
Expected<Technology> TechnologyOf(const PanNotes& notes, double gap_eV) {
  const Technology* named = FindTechnology(notes.technology);
  for (const char* word : {"si", "cis", "cdte", "ucsi_asi"}) {
    const Technology* usual = FindTechnology(word);
    if (named == nullptr && SameValue(usual->pvsyst_bandgap_eV(), gap_eV)) named = usual;
  }
  if (named == nullptr) {
    return Fail(fmt::format(
        "a PAN file implies EgRef = 1.12 eV (silicon), 1.03 (CIS) or 1.5 (CdTe), found {:g}: fit "
        "with EgRef fixed there",
        gap_eV));
  }
  if (named->pvsyst_name == nullptr) {
    return Fail("PVsyst's name of the technology " + notes.technology + " is not known");
  }
  if (SameValue(named->pvsyst_bandgap_eV(), gap_eV)) return *named;
  return Fail(fmt::format(
      "a PAN file implies EgRef = {:g} eV by its technology {}, found {:g}: fit with EgRef fixed "
      "there",
      named->pvsyst_bandgap_eV(), named->pvsyst_name, gap_eV));
}

struct PanLines {
  std::string text;
  void Add(const std::string& line) { text += line + "\r\n"; }
  void Number(const char* key, double value) { Add(fmt::format("  {}={}", key, Plain(value))); }
};

// Whether PVsyst may name the technology otherwise: no file of it was seen.
bool IsNameUnsure(const Technology& technology) {
  return std::string_view(technology.pvsyst_name).rfind("mtaSiH", 0) == 0;
}

void AddCommercial(const PanNotes& notes, const Technology& technology, PanLines* lines) {
  lines->Add("PVObject_=pvModule");
  lines->Add("  Version=6.80");
  lines->Add("  Flags=$0043");
  lines->Add("");
  lines->Add("  PVObject_Commercial=pvCommercial");
  lines->Add("    Comment=Electrical model only, by lyrefit " + std::string(Version()));
  lines->Add("    Flags=$0041");
  lines->Add("    Manufacturer=" + OnOneLine(notes.manufacturer));
  lines->Add("    Model=" + OnOneLine(notes.name));
  lines->Add("    DataSource=lyrefit " + std::string(Version()) + ", fitted to measured curves");
  const bool unsure = IsNameUnsure(technology);
  lines->Add(fmt::format("    Remarks, Count={}", unsure ? 4 : 3));
  lines->Add("      Str_1=Only the electrical model is filled: RShunt, Rp_0, Rp_Exp, RSerie,");
  lines->Add("      Str_2=Gamma, muGamma and the values of its curve at 1000 W/m2 and 25 C.");
  lines->Add("      Str_3=Sizes, incidence angles, limits and prices are absent.");
  if (unsure) {
    lines->Add(fmt::format("      Str_4=If PVsyst refuses Technol={}, choose {} there.",
                           technology.pvsyst_name, technology.name));
  }
  lines->Add("    End of Remarks");
  lines->Add("  End of PVObject pvCommercial");
  lines->Add("");
}

}  // namespace

double PanBandgap_eV(const std::string& technology) {
  const Technology* known = FindTechnology(technology);
  return (known != nullptr ? *known : Silicon()).pvsyst_bandgap_eV();
}

PanNotes NotesOf(const std::string& name, const DeviceNotes& device) {
  PanNotes notes;
  notes.name = name;
  notes.technology = device.technology;
  notes.bypass_diodes = device.bypass_diodes;
  return notes;
}

Expected<std::string> PanText(const Translation& translation, const std::vector<double>& shared,
                              const PanNotes& notes) {
  const Translation& at = translation;
  if (at.spec.law != TranslationLaw::kPvsyst) {
    return Fail("a PAN file takes the law pvsyst, not desoto");
  }
  TRY(const auto named, PvlibParameters(at, shared));
  std::map<std::string, double> values;
  for (const NamedValue& value : named) values[value.name] = value.value;
  TRY(const Technology technology, TechnologyOf(notes, values["EgRef"]));
  const double built_in_V = at.spec.cells_in_series * technology.junctions * kDefaultBuiltIn_V;
  if (at.recombination >= 0 && !SameValue(values["NsVbi"], built_in_V)) {
    return Fail(fmt::format(
        "a PAN file implies NsVbi = {:g} V by its technology {}, found {:g}: fit with NsVbi fixed "
        "there",
        built_in_V, technology.pvsyst_name, values["NsVbi"]));
  }
  const TranslatedDevice reference =
      TranslateTo(at, shared, kReferenceIrradiance_W_m2, kReferenceTemperature_K);
  const KeyPoints points = ModelKeyPoints(reference.device, reference.parameters.data());
  if (std::isnan(points.max_power_W)) return Fail("the device gives no power at the reference");
  const TemperatureCoefficients slopes = CoefficientsAtReference(at, shared);
  PanLines lines;
  AddCommercial(notes, technology, &lines);
  lines.Add("  Technol=" + std::string(technology.pvsyst_name));
  lines.Number("NCelS", at.spec.cells_in_series);
  lines.Number("NCelP", 1);
  if (notes.bypass_diodes) lines.Number("NDiode", *notes.bypass_diodes);
  lines.Number("GRef", kReferenceIrradiance_W_m2);
  lines.Number("TRef", kReferenceTemperature_C);
  lines.Number("PNom", points.max_power_W);
  lines.Number("Isc", points.short_circuit_current_A);
  lines.Number("Voc", points.open_circuit_voltage_V);
  lines.Number("Imp", points.max_power_current_A);
  lines.Number("Vmp", points.max_power_voltage_V);
  lines.Number("muISC", 1e3 * values["alpha_sc"]);
  lines.Number("muVocSpec", 1e3 * slopes.beta_oc_V_K);
  lines.Number("muPmpReq", slopes.gamma_pmp_percent_K);
  lines.Number("RShunt", values["R_sh_ref"]);
  lines.Number("Rp_0", values["R_sh_0"]);
  lines.Number("Rp_Exp", values["R_sh_exp"]);
  lines.Number("RSerie", values["R_s"]);
  lines.Number("Gamma", values["gamma_ref"]);
  lines.Number("muGamma", values["mu_gamma"]);
  if (at.recombination >= 0) lines.Number("D2MuTau", values["d2mutau"]);
  lines.Add("End of PVObject pvModule");
  return lines.text;
}

}  // namespace lyrefit

#include "lyrefit/read/read_pvlib.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "lyrefit/base/file.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/try.h"
#include "lyrefit/read/json_text.h"

namespace lyrefit {
namespace {

using nlohmann::json;

constexpr std::uintmax_t kLargestFile = 1U << 20;
constexpr int kMostCells = 100000;

// One keyword of pvlib: its allowed values and its default.
struct Keyword {
  const char* name;
  double least;
  bool above_least = false;  // `least` itself is not allowed
  double usual = kUnknown;   // default; NaN: the keyword is required
};

// Reads keywords from the dictionary and stores the first error.
class Reader {
 public:
  Reader(const json& dictionary, const std::string& text, const std::string& path)
      : dictionary_(dictionary), fields_(dictionary, text, path), path_(path) {}

  double Take(const Keyword& keyword) {
    if (error_) return kUnknown;
    const Expected<std::optional<double>> found = fields_.Number({keyword.name});
    if (!found) return Remember(found.error());
    if (!*found && std::isnan(keyword.usual)) return Missing(keyword.name);
    const double value = found->value_or(keyword.usual);
    const double least = keyword.least;
    if (std::isfinite(value) && (keyword.above_least ? value > least : value >= least)) {
      return value;
    }
    const std::string range = keyword.above_least ? "above" : "of at least";
    return Remember(
        fields_.Refuse(keyword.name, fmt::format("a number {} {:g}", range, least)).value());
  }

  // Infinite if the value is null, as PvlibJson writes it.
  double TakeShunt() {
    const auto found = dictionary_.find("R_sh_ref");
    if (found != dictionary_.end() && found->is_null()) return kInfinity;
    return Take({"R_sh_ref", 0, true});
  }

  // Returns 0 if the keyword is missing.
  int TakeCells() {
    if (error_) return 0;
    const Expected<std::optional<int>> cells = fields_.WholeNumber({"cells_in_series", "N_s"});
    if (!cells) {
      Remember(cells.error());
      return 0;
    }
    if (!*cells) return 0;
    if (**cells >= 1 && **cells <= kMostCells) return **cells;
    const char* key = dictionary_.contains("cells_in_series") ? "cells_in_series" : "N_s";
    Remember(fields_.Refuse(key, fmt::format("1 to {} cells", kMostCells)).value());
    return 0;
  }

  // Parameters at other reference conditions are not supported.
  void CheckReference(const char* name, double ours) {
    const double value = Take({name, -kInfinity, true, ours});
    if (error_ || std::fabs(value - ours) <= 1e-9 * std::fabs(ours)) return;
    Remember(fields_.Refuse(name, fmt::format("the reference {:g}", ours)).value());
  }

  double Missing(const char* name) {
    return Remember({fmt::format("expected a number for the key \"{}\"", name), path_});
  }

  double Remember(const Error& error) {
    if (!error_) error_ = error;
    return kUnknown;
  }

  const std::optional<Error>& error() const { return error_; }

 private:
  const json& dictionary_;
  JsonFields fields_;
  const std::string& path_;
  std::optional<Error> error_;
};

// Collects the keywords of all functions. PvlibJson writes some beside "parameters"; its older
// files, and pvlib's own dictionaries, have all in one object.
Expected<json> KeywordsIn(const json& document, const std::string& text, const std::string& path) {
  if (!document.contains("parameters")) return document;
  const JsonFields fields(document, text, path);
  json keywords = document.at("parameters");
  if (!keywords.is_object()) return fields.Refuse("parameters", "an object");
  if (document.contains("cells_in_series") && !keywords.contains("cells_in_series")) {
    keywords["cells_in_series"] = document.at("cells_in_series");
  }
  if (!document.contains("bishop88")) return keywords;
  if (!document.at("bishop88").is_object()) return fields.Refuse("bishop88", "an object");
  keywords.update(document.at("bishop88"));
  return keywords;
}

bool IsCec(const json& document) {
  return document.contains("function") && document["function"] == "calcparams_cec";
}

Expected<TranslationLaw> LawOf(const json& document, const json& dictionary,
                               const std::string& text, const std::string& path) {
  const bool desoto = dictionary.contains("a_ref");
  const bool pvsyst = dictionary.contains("gamma_ref");
  if (document.contains("function")) {
    const json& function = document["function"];
    if (function == "calcparams_desoto" || IsCec(document)) return TranslationLaw::kDeSoto;
    if (function == "calcparams_pvsyst") return TranslationLaw::kPvsyst;
    return JsonFields(document, text, path)
        .Refuse("function", "calcparams_desoto, calcparams_cec or calcparams_pvsyst");
  }
  if (desoto != pvsyst) return pvsyst ? TranslationLaw::kPvsyst : TranslationLaw::kDeSoto;
  return Fail(desoto ? "expected one law, found the keys of two: a_ref and gamma_ref"
                     : "expected pvlib's parameters by De Soto (with the key \"a_ref\") or PVsyst "
                       "(with \"gamma_ref\")",
              path);
}

// Reads the translation and the parameters that both laws have, in the translation's order. The
// caller reads further keywords after it.
Expected<void> TakeShared(const TranslationSpec& spec, const char* ideality, Reader* reader,
                          NamedParameters* module) {
  TRY(module->translation, MakeTranslation(spec));
  const Translation& at = module->translation;
  std::vector<double>& p = module->shared;
  p.resize(at.size());
  p[at.photocurrent] = reader->Take({"I_L_ref", 0, true});
  p[at.saturation_current] = reader->Take({"I_o_ref", 0, true});
  p[at.n] = reader->Take({ideality, 0, true});
  p[at.resistance_series] = reader->Take({"R_s", 0});
  const bool may_be_perfect = spec.law != TranslationLaw::kPvsyst;
  p[at.resistance_shunt] =
      may_be_perfect ? reader->TakeShunt() : reader->Take({"R_sh_ref", 0, true});
  p[at.alpha_sc] = reader->Take({"alpha_sc", -kInfinity, true});
  p[at.bandgap] = reader->Take({"EgRef", 0, true, kPvlibBandgap_eV});
  return {};
}

// `usual_adjust` is the Adjust of a dictionary without one; NaN: it must have one.
Expected<void> TakeDeSoto(double usual_adjust, Reader* reader, NamedParameters* module) {
  const int cells = reader->TakeCells();
  module->cells_stated = cells > 0;
  TranslationSpec spec;
  spec.cells_in_series = std::max(cells, 1);
  TRY(TakeShared(spec, "a_ref", reader, module));
  const Translation& at = module->translation;
  std::vector<double>& p = module->shared;
  p[at.n] /= at.device.module_thermal_voltage_V;
  p[at.bandgap_slope] = reader->Take({"dEgdT", -kInfinity, true, kPvlibBandgapSlope_1_K});
  p[at.alpha_sc] *= 1 - reader->Take({"Adjust", -100, false, usual_adjust}) / 100;
  return {};
}

Expected<void> TakePvsyst(Reader* reader, NamedParameters* module) {
  const double loss = reader->Take({"d2mutau", 0, false, 0});
  TranslationSpec spec;
  spec.law = TranslationLaw::kPvsyst;
  spec.shunt = ShuntLaw::kExponential;
  spec.recombination = loss > 0;
  spec.cells_in_series = reader->TakeCells();
  if (spec.cells_in_series == 0) reader->Missing("cells_in_series");
  TRY(TakeShared(spec, "gamma_ref", reader, module));
  const Translation& at = module->translation;
  std::vector<double>& p = module->shared;
  p[at.n_slope] = reader->Take({"mu_gamma", -kInfinity, true});
  p[at.resistance_shunt_dark] = reader->Take({"R_sh_0", 0, true});
  p[at.shunt_exponent] = reader->Take({"R_sh_exp", 0, true, kPvlibShuntExponent});
  if (!spec.recombination) return {};
  p[at.recombination] = loss;
  p[at.built_in_voltage] = reader->Take({"NsVbi", 0, true});
  return {};
}

}  // namespace

Expected<NamedParameters> ReadPvlibParameters(const std::string& path) {
  TRY(const std::string text, ReadTextFile(path, kLargestFile));
  TRY(const json document, ParseJson(text, path));
  if (!document.is_object()) return Fail("expected an object of pvlib's parameters", path, 1, 1);
  TRY(const json dictionary, KeywordsIn(document, text, path));
  TRY(const TranslationLaw law, LawOf(document, dictionary, text, path));
  NamedParameters module;
  module.name = std::filesystem::path(path).filename().string();
  Reader reader(dictionary, text, path);
  reader.CheckReference("irrad_ref", kReferenceIrradiance_W_m2);
  reader.CheckReference("temp_ref", kReferenceTemperature_C);
  const double usual_adjust = IsCec(document) ? kUnknown : 0;
  const Expected<void> taken = law == TranslationLaw::kPvsyst
                                   ? TakePvsyst(&reader, &module)
                                   : TakeDeSoto(usual_adjust, &reader, &module);
  if (!taken) return Fail(taken.error().message, path);
  if (reader.error()) return tl::unexpected(*reader.error());
  // Rejects parameters that pvlib would compute differently, such as a shunt clipped at 0 ohm.
  if (const auto same = PvlibParameters(module.translation, module.shared); !same) {
    return Fail(same.error().message, path);
  }
  return module;
}

}  // namespace lyrefit

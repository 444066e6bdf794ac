#include "lyrefit/read/read_module.h"

#include <filesystem>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/try.h"
#include "lyrefit/read/cec_library.h"
#include "lyrefit/read/json_text.h"
#include "lyrefit/read/read_pan.h"
#include "lyrefit/read/text_encoding.h"

namespace lyrefit {
namespace {

using nlohmann::json;

constexpr std::uintmax_t kLargestLibrary = 64U << 20;

enum class ModuleFormat { kPan, kLibrary, kJson };

// A module file that was read.
struct ModuleText {
  std::string path;
  std::string row;  // NAME of FILE#NAME
  std::string text;
  ModuleFormat format = ModuleFormat::kJson;
};

bool IsFile(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

Expected<ModuleText> ReadModuleText(const std::string& file) {
  ModuleText module;
  module.path = FileOfModule(file);
  if (module.path.size() < file.size()) module.row = file.substr(module.path.size() + 1);
  TRY(DecodedText decoded, ReadDecodedFile(module.path, kLargestLibrary));
  module.text = std::move(decoded.text);
  module.format = IsPan(module.text)          ? ModuleFormat::kPan
                  : IsCecLibrary(module.text) ? ModuleFormat::kLibrary
                                              : ModuleFormat::kJson;
  if (module.row.empty() || module.format == ModuleFormat::kLibrary) return module;
  return Fail("FILE#NAME chooses a module of SAM's library: this file is none", module.path);
}

// Error for a text that is no module file of any kind.
Expected<void> CheckJson(const ModuleText& module) {
  const std::size_t first = module.text.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && module.text[first] == '{') return {};
  return Fail(
      "expected a module: pvlib's parameters as JSON, a PVsyst .PAN file (PVObject_=pvModule) or "
      "SAM's library of modules (CSV with the columns Name, a_ref, ...)",
      module.path, 1, 1);
}

// A row of SAM's library as JSON.
Expected<ModuleSheet> ReadJsonSheet(const ModuleText& module) {
  TRY(const json document, ParseJson(module.text, module.path));
  const json row = document.contains("cec") ? document["cec"] : document;
  if (!row.is_object() || !row.contains("I_sc_ref")) {
    return Fail(
        "expected the data sheet of a module: a PVsyst .PAN file, a row of SAM's library of "
        "modules, or JSON with such a row under \"cec\"",
        module.path);
  }
  const JsonFields fields(row, module.text, module.path);
  ModuleSheet found;
  TRY(const auto cells, fields.WholeNumber({"N_s", "cells_in_series"}));
  if (!cells) return Fail("expected a number of cells for the key \"N_s\"", module.path);
  found.sheet.cells_in_series = *cells;
  TRY(const auto isc, fields.Number({"I_sc_ref"}));
  TRY(const auto voc, fields.Number({"V_oc_ref"}));
  TRY(const auto imp, fields.Number({"I_mp_ref"}));
  TRY(const auto vmp, fields.Number({"V_mp_ref"}));
  TRY(const auto alpha, fields.Number({"alpha_sc"}));
  TRY(const auto beta, fields.Number({"beta_oc"}));
  TRY(found.sheet.gamma_pmp_percent_K, fields.Number({"gamma_r"}));
  TRY(const auto name, fields.Text("Name"));
  TRY(const auto technology, fields.Text("Technology"));
  const auto known = [](const std::optional<double>& value) { return value.value_or(kUnknown); };
  found.sheet.values = {known(isc), known(voc), known(imp), known(vmp), known(alpha), known(beta)};
  found.name = name.value_or("");
  found.sheet.technology = technology.value_or("");
  return found;
}

}  // namespace

std::string FileOfModule(const std::string& file) {
  if (IsFile(file)) return file;
  for (std::size_t at = file.find('#'); at != std::string::npos; at = file.find('#', at + 1)) {
    if (at > 0 && IsFile(file.substr(0, at))) return file.substr(0, at);
  }
  return file;
}

Expected<NamedParameters> ReadModuleParameters(const std::string& file) {
  TRY(const ModuleText module, ReadModuleText(file));
  switch (module.format) {
    case ModuleFormat::kPan:
      return ReadPanParameters(module.text, module.path);
    case ModuleFormat::kLibrary:
      return ReadCecParameters(module.text, module.path, module.row);
    case ModuleFormat::kJson:
      break;
  }
  TRY(CheckJson(module));
  return ReadPvlibParameters(module.path);
}

Expected<ModuleSheet> ReadModuleSheet(const std::string& file) {
  TRY(const ModuleText module, ReadModuleText(file));
  switch (module.format) {
    case ModuleFormat::kPan:
      return ReadPanSheet(module.text, module.path);
    case ModuleFormat::kLibrary:
      return ReadCecSheet(module.text, module.path, module.row);
    case ModuleFormat::kJson:
      break;
  }
  TRY(CheckJson(module));
  return ReadJsonSheet(module);
}

Expected<bool> HoldsModule(const std::string& file) {
  TRY(const ModuleText module, ReadModuleText(file));
  if (module.format != ModuleFormat::kJson) return true;
  const auto document = ParseJson(module.text, module.path);
  if (!document || !document->is_object()) return false;
  for (const char* key : {"function", "a_ref", "gamma_ref"}) {
    if (document->contains(key)) return true;
  }
  return false;
}

}  // namespace lyrefit

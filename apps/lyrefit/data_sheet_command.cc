#include "data_sheet_command.h"

#include <fmt/format.h>

#include <cmath>

#include "flags.h"
#include "interrupt.h"
#include "lyrefit/curve/number_text.h"
#include "lyrefit/family/pvlib_parameters.h"
#include "lyrefit/report/data_sheet_text.h"
#include "lyrefit/report/json.h"
#include "output.h"

namespace lyrefit {
namespace {

constexpr char kDataSheetFooter[] =
    "Examples:\n"
    "  lyrefit datasheet --isc 4.75 --voc 21.6 --imp 4.26 --vmp 17.6 --alpha 0.002 --beta -0.076\n"
    "      --cells 36\n"
    "  lyrefit datasheet --isc 9.05 --voc 37.8 --imp 8.58 --vmp 30.3 --alpha 0.06% --beta -0.31%\n"
    "      --gamma -0.41 --cells 60 --pvlib module.json\n"
    "\n"
    "Exit codes: 0 fine, 1 bad input or options, 2 no device gives all that the sheet prints.";

// From here on an equation is not solved: beyond the digits of any sheet.
constexpr double kNotSolved = 1e-6;

// A value as printed, and half a unit of its last digit.
struct Printed {
  double value = 0;
  double half_unit = 0;
};

double HalfUnit(const std::string& text) {
  const std::size_t exponent_at = text.find_first_of("eE");
  const std::string digits = text.substr(0, exponent_at);
  const std::size_t point = digits.find('.');
  const double decimals =
      point == std::string::npos ? 0 : static_cast<double>(digits.size() - point - 1);
  const double exponent =
      exponent_at == std::string::npos ? 0 : ParseNumber(text.substr(exponent_at + 1)).value_or(0);
  return 0.5 * std::pow(10, exponent - decimals);
}

// `text` given to `flag`; in percent of `whole` where a sign says so and `whole` is given.
Expected<Printed> ParsePrinted(const char* flag, const std::string& text, double whole = 0) {
  const bool percent = whole != 0 && !text.empty() && text.back() == '%';
  const std::string number = percent ? text.substr(0, text.size() - 1) : text;
  const std::optional<double> value = ParseNumber(number);
  if (!value || !std::isfinite(*value)) {
    return Fail(fmt::format("{}: expected a number{}, found '{}'", flag,
                            whole != 0 ? " per kelvin, or in percent such as 0.05%" : "", text));
  }
  const double unit = percent ? whole / 100 : 1;
  return Printed{*value * unit, HalfUnit(number) * std::fabs(unit)};
}

}  // namespace

DataSheetCommand::DataSheetCommand(CommandLine* line)
    : verb_(line->AddVerb("datasheet",
                          "Find a module's parameters from what its data "
                          "sheet prints, without any curve")) {
  const auto add = [this](const char* flag, std::string* target, const char* doc) {
    return verb_->AddOption(flag, target, doc).Type("NUMBER").Group("Data sheet");
  };
  add("--isc", &isc_, "short-circuit current in A").Required();
  add("--voc", &voc_, "open-circuit voltage in V").Required();
  add("--imp", &imp_, "current at the maximum power in A").Required();
  add("--vmp", &vmp_, "voltage at the maximum power in V").Required();
  add("--alpha", &alpha_, "temperature coefficient of Isc in A/K, or in percent: 0.05%").Required();
  add("--beta", &beta_, "temperature coefficient of Voc in V/K, or in percent: -0.3%").Required();
  add("--gamma", &gamma_, "temperature coefficient of Pmp in percent per kelvin, only compared");
  verb_->AddOption("--cells", &cells_, "cells in series")
      .Required()
      .Between(1, 100000)
      .Type("N")
      .Group("Data sheet");
  verb_->AddSwitch("--exact", &exact_, "the values are not rounded to the digits given")
      .Group("Data sheet");
  AddEnumFlag(verb_, "--constants", "values of k and q", &constants_).Group("Data sheet");
  const auto add_text = [this](const char* flag, std::string* target, const char* doc,
                               const char* type) {
    verb_->AddOption(flag, target, doc).Type(type).Group("Output");
  };
  add_text("--name", &name_, "of the module, for pvlib (default module)", "TEXT");
  add_text("--technology", &technology_, "of the module, for pvlib: Mono-c-Si", "TEXT");
  verb_->AddOption("--json", &json_file_, "the answer as JSON; - for standard output, alone")
      .Writes();
  verb_
      ->AddOption("--pvlib", &pvlib_file_,
                  "the parameters as pvlib takes them, JSON; - for standard output, alone")
      .Writes();
  verb_->AddQuietSwitch();
  verb_->Footer(kDataSheetFooter);
}

Expected<DataSheet> DataSheetCommand::Sheet() const {
  DataSheet sheet;
  sheet.cells_in_series = cells_;
  DataSheetValues& values = sheet.values;
  DataSheetValues& half = sheet.half_unit;
  const struct {
    const char* flag;
    const std::string& text;
    double DataSheetValues::*field;
    double DataSheetValues::*whole;  // of what it may be a part
  } rows[] = {
      {"--isc", isc_, &DataSheetValues::short_circuit_current_A, nullptr},
      {"--voc", voc_, &DataSheetValues::open_circuit_voltage_V, nullptr},
      {"--imp", imp_, &DataSheetValues::max_power_current_A, nullptr},
      {"--vmp", vmp_, &DataSheetValues::max_power_voltage_V, nullptr},
      {"--alpha", alpha_, &DataSheetValues::alpha_sc_A_K,
       &DataSheetValues::short_circuit_current_A},
      {"--beta", beta_, &DataSheetValues::beta_oc_V_K, &DataSheetValues::open_circuit_voltage_V}};
  for (const auto& row : rows) {
    const double whole = row.whole == nullptr ? 0 : values.*row.whole;
    const Expected<Printed> printed = ParsePrinted(row.flag, row.text, whole);
    if (!printed) return tl::unexpected(printed.error());
    values.*row.field = printed->value;
    half.*row.field = exact_ ? 0 : printed->half_unit;
  }
  if (gamma_.empty()) return sheet;
  const Expected<Printed> gamma = ParsePrinted("--gamma", gamma_);
  if (!gamma) return tl::unexpected(gamma.error());
  sheet.gamma_pmp_percent_K = gamma->value;
  return sheet;
}

Expected<void> DataSheetCommand::Write(const DataSheetFit& fit) const {
  if (!json_file_.empty()) {
    if (auto written = WriteOutput(json_file_, DataSheetJson(fit)); !written) return written;
  }
  if (!pvlib_file_.empty()) {
    const auto keywords = PvlibParameters(fit.translation, fit.shared);
    if (!keywords) return tl::unexpected(keywords.error());
    const auto row = CecRow(fit.translation, fit.shared, name_, technology_);
    const std::string json = PvlibJson(name_, fit.translation.spec.law, *keywords, row);
    if (auto written = WriteOutput(pvlib_file_, json); !written) return written;
  }
  if (!verb_->TextWanted()) return {};
  return WriteOutput("-", DataSheetText(fit));
}

int DataSheetCommand::Run() {
  EndOnSignals();
  if (auto checked = verb_->CheckFiles(); !checked) return Refuse(checked.error());
  const Expected<DataSheet> sheet = Sheet();
  if (!sheet) return Refuse(sheet.error());
  const Expected<DataSheetFit> fit = FitDataSheet(*sheet, constants_);
  if (!fit) return Refuse(fit.error());
  if (auto written = Write(*fit); !written) return Refuse(written.error());
  return fit->largest_relative_error < kNotSolved ? kExitFine : kExitNotUsable;
}

}  // namespace lyrefit

#include <memory>

#include "bindings.h"
#include "docs.h"
#include "errors.h"
#include "frames.h"
#include "keywords.h"
#include "lyrefit/base/number_text.h"
#include "lyrefit/devices/data_sheet.h"
#include "lyrefit/devices/device_documents.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/plots.h"
#include "pvlib_dict.h"
#include "result.h"

namespace lyrefit::python {
namespace {

using SolvedSheet = std::shared_ptr<const DataSheetFit>;

std::string BriefSheet(const DataSheetFit& fit) {
  std::string brief = "data sheet:";
  for (std::size_t k = 0; k < fit.shared.size(); ++k) {
    brief += (k == 0 ? " " : ", ") + std::string(fit.translation.parameters[k].name) + " " +
             NumberText(fit.shared[k]);
  }
  return brief + (fit.Solved() ? "" : "; NOT ALL that the sheet prints");
}

Record RecordOf(const SolvedSheet& found) {
  Record record;
  record.json = [found](JsonPoints) { return DataSheetJson(*found); };
  record.text = [found](Length) { return DataSheetText(*found); };
  record.brief = [found] { return BriefSheet(*found); };
  record.document = [found] { return DataSheetDocument(*found); };
  record.csv = [found] { return DataSheetCsv(*found); };
  record.plot = [found](const std::string& file) { return PlotDataSheet(*found, file); };
  return record;
}

struct SheetOptions {
  std::string name = "module";
  std::string technology;
  std::optional<double> EgRef_eV;
  std::optional<double> dEgdT_1_K;
  ConstantSet constants = ConstantSet::kCodata;
};
constexpr OptionRow<SheetOptions> kSheetTable[] = {
    {"constants", "NAME", "values of k and q", EnumOption<&SheetOptions::constants>()},
    {"name", "TEXT", "of the module, for pvlib", &SheetOptions::name},
    {"technology", "NAME",
     "of the cells, which sets the band gap: Mono-c-Si, CdTe, CIGS, GaAs, ...",
     &SheetOptions::technology},
    {"EgRef", "eV", "band gap at 25 C of De Soto's law; else that of the technology",
     &SheetOptions::EgRef_eV, 0.3, 3.0, OptionTrait::kNoDefault},
    {"dEgdT", "1/K", "its slope with temperature, relative to it", &SheetOptions::dEgdT_1_K, -0.01,
     0.01, OptionTrait::kNoDefault},
};

class DataSheetResult : public Result {
 public:
  DataSheetResult(SolvedSheet found, SheetOptions options)
      : Result(RecordOf(found)), found_(std::move(found)), options_(std::move(options)) {}
  const DataSheetFit& found() const { return *found_; }
  const SheetOptions& options() const { return options_; }

 private:
  SolvedSheet found_;
  SheetOptions options_;
};

// A number is exact; a text is rounded to its digits.
PrintedValue Printed(const char* keyword, py::handle value, double whole = 0) {
  if (!py::isinstance<py::str>(value)) return {NumberOf(keyword, value), 0};
  const auto printed = ReadPrintedValue(value.cast<std::string>(), whole);
  if (!printed) Raise({std::string(keyword) + ": " + printed.error().message, {}});
  return *printed;
}

DataSheetResult FitSheet(py::handle v_mp, py::handle i_mp, py::handle v_oc, py::handle i_sc,
                         py::handle alpha_sc, py::handle beta_voc, py::handle cells_in_series,
                         const py::kwargs& given) {
  Keywords keywords("fit_datasheet", given);
  DataSheet sheet;
  const auto take = [&](const char* keyword, py::handle value, double DataSheetValues::*field,
                        double whole = 0) {
    const PrintedValue printed = Printed(keyword, value, whole);
    sheet.values.*field = printed.value;
    sheet.half_unit.*field = printed.half_unit;
    return printed.value;
  };
  take("v_mp", v_mp, &DataSheetValues::max_power_voltage_V);
  take("i_mp", i_mp, &DataSheetValues::max_power_current_A);
  const double voc = take("v_oc", v_oc, &DataSheetValues::open_circuit_voltage_V);
  const double isc = take("i_sc", i_sc, &DataSheetValues::short_circuit_current_A);
  take("alpha_sc", alpha_sc, &DataSheetValues::alpha_sc_A_K, isc);
  take("beta_voc", beta_voc, &DataSheetValues::beta_oc_V_K, voc);
  const std::int64_t cells = WholeOf("cells_in_series", cells_in_series);
  CheckRange("cells_in_series", static_cast<double>(cells), 1, 100000);
  sheet.cells_in_series = static_cast<int>(cells);
  if (const auto gamma = keywords.Take("gamma_pmp")) {
    sheet.gamma_pmp_percent_K = Printed("gamma_pmp", *gamma).value;
  }
  SheetOptions options;
  keywords.Read(kSheetTable, &options);
  keywords.Finish();
  sheet.technology = options.technology;
  sheet.EgRef_eV = options.EgRef_eV;
  sheet.dEgdT_1_K = options.dEgdT_1_K;
  DataSheetFit fit = Must(FitDataSheet(sheet, options.constants));
  WarnUnlessUsable(fit.Solved(), {});
  return {std::make_shared<const DataSheetFit>(std::move(fit)), std::move(options)};
}

py::dict SheetParameters(const DataSheetResult& result) {
  py::dict parameters;
  const DataSheetFit& fit = result.found();
  for (std::size_t k = 0; k < fit.shared.size(); ++k) {
    parameters[py::str(fit.translation.parameters[k].name)] = fit.shared[k];
  }
  return parameters;
}

py::object SheetPvlib(const DataSheetResult& result) {
  const DataSheetFit& fit = result.found();
  return PvlibDict(result.options().name, fit.translation, fit.shared, result.options().technology);
}

constexpr char kDataSheetDoc[] =
    "Find a module's parameters from what its data sheet prints, without any curve.\n\n"
    "The arguments are those of pvlib.ivtools.sdm.fit_desoto. A number is taken as exact; a text,\n"
    "'4.70', as rounded to its digits, and the answer then says how far each parameter may be off\n"
    "for that.\n\n"
    "Parameters\n----------\n"
    "v_mp, i_mp : float or str\n"
    "    Voltage in V and current in A at the maximum power, at 1000 W/m2 and 25 C.\n"
    "v_oc, i_sc : float or str\n"
    "    Open-circuit voltage in V and short-circuit current in A.\n"
    "alpha_sc, beta_voc : float or str\n"
    "    Their temperature coefficients in A/K and V/K, or in percent as text: '0.05%', '-0.31%'.\n"
    "cells_in_series : int\n"
    "gamma_pmp : float or str, optional\n"
    "    Temperature coefficient of the power in percent per kelvin, only compared.\n";

constexpr char kDataSheetEnd[] =
    "Returns\n-------\n"
    "DataSheetResult\n"
    "    `parameters` are those of De Soto's law at 1000 W/m2 and 25 C, under pvlib's names.\n\n"
    "Raises\n------\n"
    "lyrefit.Error\n"
    "    Values that no illuminated diode has, percent where A/K and V/K are expected.\n\n"
    "Examples\n--------\n"
    ">>> module = lyrefit.fit_datasheet(v_mp='30.3', i_mp='8.58', v_oc='37.8', i_sc='9.05',\n"
    "...                                alpha_sc='0.06%', beta_voc='-0.31%', cells_in_series=60)\n"
    ">>> module.pvlib['parameters']\n";

}  // namespace

void BindDataSheet(py::module_* module) {
  py::class_<DataSheetResult, Result>(
      *module, "DataSheetResult",
      "What fit_datasheet() found. Experimental: may change in a minor version.")
      .def_property_readonly("parameters", &SheetParameters,
                             "dict of str to float: at 1000 W/m2 and 25 C, pvlib's names.")
      .def_property_readonly(
          "pvlib", &SheetPvlib,
          "dict: which function of pvlib takes the device, its keywords under 'parameters', and\n"
          "its row of SAM's library (--pvlib).")
      .def_property_readonly(
          "usable", [](const DataSheetResult& r) { return r.found().Solved(); },
          "bool: the device gives all that the sheet prints.")
      .def(
          "frame", [](const DataSheetResult& r) { return FrameOfCsv(r.record().csv()); },
          "frame($self)\n--\n\nA pandas.DataFrame with a row a parameter (--csv).");
  std::vector<KeywordNote> notes;
  notes.push_back({"gamma_pmp", "float | str", "None", "Data sheet", ""});
  AppendNotes(kSheetTable, SheetOptions(), &notes);
  DefineVerb(module,
             {"fit_datasheet", "v_mp, i_mp, v_oc, i_sc, alpha_sc, beta_voc, cells_in_series",
              kDataSheetDoc, kDataSheetEnd, notes},
             &FitSheet, py::arg("v_mp"), py::arg("i_mp"), py::arg("v_oc"), py::arg("i_sc"),
             py::arg("alpha_sc"), py::arg("beta_voc"), py::arg("cells_in_series"));
}

}  // namespace lyrefit::python

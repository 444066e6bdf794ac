#include "lyrefit/read/cec_library.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/data_sheet_values.h"
#include "lyrefit/model/pvlib_parameters.h"
#include "lyrefit/read/table_lines.h"

namespace lyrefit {
namespace {

constexpr char kDelimiter = ',';
constexpr double kMostLibraryCells = 100000;

std::vector<std::string> LibraryFields(const LineSplitter& splitter) {
  std::vector<std::string> fields;
  for (std::size_t k = 0; k < splitter.size(); ++k) {
    fields.emplace_back(TrimBlanks(splitter[k]));
  }
  return fields;
}

// pvlib's key of a module.
std::string PvlibKey(std::string name) {
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return name;
}

// One row of a library, under the names of its columns.
struct LibraryRow {
  std::string path;
  std::vector<std::string> columns;
  std::vector<std::string> fields;
  std::string line;
  int number = 0;  // of the line

  std::optional<std::size_t> Place(const std::string& column) const {
    const auto found = std::find(columns.begin(), columns.end(), column);
    const auto place = static_cast<std::size_t>(found - columns.begin());
    return place < fields.size() ? std::optional<std::size_t>(place) : std::nullopt;
  }

  std::string Text(const std::string& column) const {
    const auto place = Place(column);
    return place ? fields[*place] : std::string();
  }

  // A number from `least`, or above it, to `most`.
  Expected<double> Number(const std::string& column, double least = -kInfinity,
                          bool above_least = true, double most = kInfinity) const {
    const auto place = Place(column);
    if (!place) {
      return Fail(fmt::format("expected a column {}, as in SAM's library of modules", column), path,
                  number, 1);
    }
    const std::optional<double> value = ParseNumber(fields[*place]);
    const bool high = value && (above_least ? *value > least : *value >= least);
    if (high && std::isfinite(*value) && *value <= most) return *value;
    std::string range;
    if (std::isfinite(least))
      range = fmt::format(" {} {:g}", above_least ? "above" : "from", least);
    if (std::isfinite(most)) range += fmt::format(" to {:g}", most);
    return Fail(fmt::format("expected a number{} in column {}, found {}", range, column,
                            Quoted(fields[*place])),
                path, number, FieldColumn(line, kDelimiter, *place));
  }
};

// Error that names the first modules of a library.
tl::unexpected<Error> WhichModule(const std::string& complaint,
                                  const std::vector<std::string>& names, const std::string& path) {
  constexpr std::size_t kNamed = 5;
  std::string list;
  for (std::size_t k = 0; k < std::min(kNamed, names.size()); ++k) {
    list += (list.empty() ? "" : ", ") + Quoted(names[k]);
  }
  if (names.size() > kNamed) list += ", ...";
  return Fail(fmt::format("{}: choose one as FILE#NAME, of {}", complaint, list), path);
}

Expected<LibraryRow> FindRow(const std::string& text, const std::string& path,
                             const std::string& wanted) {
  LibraryRow found;
  LineReader reader(text);
  LineSplitter splitter(kDelimiter);
  std::vector<std::string> columns, names;
  for (std::string_view line; reader.Next(&line);) {
    if (TrimBlanks(line).empty()) continue;
    if (!splitter.Split(line)) return Fail("quotes do not close", path, reader.number(), 1);
    std::vector<std::string> fields = LibraryFields(splitter);
    if (fields.empty()) continue;
    const bool units = fields[0] == "Units" || (!fields[0].empty() && fields[0][0] == '[');
    if (columns.empty()) {
      columns = std::move(fields);
    } else if (!units) {
      LibraryRow row = {path, columns, std::move(fields), std::string(line), reader.number()};
      names.push_back(row.Text("Name"));
      const bool meant =
          wanted.empty() || wanted == names.back() || wanted == PvlibKey(names.back());
      if (!meant) continue;
      if (!found.fields.empty() && !wanted.empty() && found.Text("Name") == names.back()) {
        return Fail(fmt::format("the module {} is there twice: here and in line {}", Quoted(wanted),
                                found.number),
                    path, row.number, 1);
      }
      found = std::move(row);
    }
  }
  if (names.empty()) return Fail("the library of modules holds none", path);
  if (wanted.empty() && names.size() > 1) {
    return WhichModule(fmt::format("a library of {} modules", names.size()), names, path);
  }
  if (found.fields.empty()) {
    return WhichModule("there is no module " + Quoted(wanted), names, path);
  }
  return found;
}

Expected<int> LibraryCells(const LibraryRow& row) {
  TRY(const double cells, row.Number("N_s", 1, false, kMostLibraryCells));
  if (cells == std::floor(cells)) return static_cast<int>(cells);
  return Fail(fmt::format("expected a whole number of cells in column N_s, found {:g}", cells),
              row.path, row.number, FieldColumn(row.line, kDelimiter, *row.Place("N_s")));
}

}  // namespace

bool IsCecLibrary(const std::string& text) {
  LineReader reader(text);
  LineSplitter splitter(kDelimiter);
  std::string_view line;
  while (reader.Next(&line) && TrimBlanks(line).empty()) continue;
  if (!splitter.Split(line)) return false;
  const std::vector<std::string> names = LibraryFields(splitter);
  return std::find(names.begin(), names.end(), "a_ref") != names.end();
}

Expected<NamedParameters> ReadCecParameters(const std::string& text, const std::string& path,
                                            const std::string& row_name) {
  TRY(const LibraryRow row, FindRow(text, path, row_name));
  NamedParameters module;
  module.name = std::filesystem::path(path).filename().string();
  if (!row_name.empty()) module.name += "#" + row_name;
  TranslationSpec spec;
  TRY(spec.cells_in_series, LibraryCells(row));
  TRY(module.translation, MakeTranslation(spec));
  const Translation& at = module.translation;
  std::vector<double>& p = module.shared;
  p.resize(at.size());
  TRY(p[at.photocurrent], row.Number("I_L_ref", 0));
  TRY(p[at.saturation_current], row.Number("I_o_ref", 0));
  TRY(const double a_ref, row.Number("a_ref", 0));
  p[at.n] = a_ref / at.device.module_thermal_voltage_V;
  TRY(p[at.resistance_series], row.Number("R_s", 0, false));
  TRY(p[at.resistance_shunt], row.Number("R_sh_ref", 0));
  TRY(const double alpha, row.Number("alpha_sc"));
  TRY(const double adjust, row.Number("Adjust", -100, false, 100));
  p[at.alpha_sc] = alpha * (1 - adjust / 100);
  p[at.bandgap] = kPvlibBandgap_eV;
  p[at.bandgap_slope] = kPvlibBandgapSlope_1_K;
  return module;
}

Expected<ModuleSheet> ReadCecSheet(const std::string& text, const std::string& path,
                                   const std::string& row_name) {
  TRY(const LibraryRow row, FindRow(text, path, row_name));
  ModuleSheet module;
  module.name = row.Text("Name");
  module.has_model = true;
  DataSheet& sheet = module.sheet;
  sheet.technology = row.Text("Technology");
  TRY(sheet.cells_in_series, LibraryCells(row));
  const struct {
    const char* column;
    double DataSheetValues::*field;
    double least;
  } columns[] = {{"I_sc_ref", &DataSheetValues::short_circuit_current_A, 0},
                 {"V_oc_ref", &DataSheetValues::open_circuit_voltage_V, 0},
                 {"I_mp_ref", &DataSheetValues::max_power_current_A, 0},
                 {"V_mp_ref", &DataSheetValues::max_power_voltage_V, 0},
                 {"alpha_sc", &DataSheetValues::alpha_sc_A_K, -kInfinity},
                 {"beta_oc", &DataSheetValues::beta_oc_V_K, -kInfinity}};
  for (const auto& [column, field, least] : columns) {
    TRY(sheet.values.*field, row.Number(column, least));
    sheet.half_unit.*field = HalfUnit(row.Text(column));
  }
  if (row.Place("gamma_r")) {
    TRY(sheet.gamma_pmp_percent_K, row.Number("gamma_r"));
  }
  if (row.Place("STC")) {
    TRY(module.rated_power_W, row.Number("STC", 0));
  }
  if (const auto fits = CheckDataSheet(sheet); !fits) {
    return Fail(fits.error().message, path, row.number, 1);
  }
  return module;
}

}  // namespace lyrefit

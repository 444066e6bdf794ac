#include <fmt/format.h>

#include <filesystem>

#include "lyrefit/base/number_text.h"
#include "lyrefit/inspect/inspect_parts.h"
#include "lyrefit/read/cec_library.h"
#include "lyrefit/read/json_text.h"
#include "lyrefit/read/read_curve_set.h"
#include "lyrefit/read/read_module.h"
#include "lyrefit/read/table_curve.h"
#include "lyrefit/read/table_lines.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/stream/batch_source.h"
#include "lyrefit/stream/csv_head.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

void TakeSheet(const ModuleSheet& sheet, Inspection* found) {
  const DataSheetValues& v = sheet.sheet.values;
  const auto add = [found](const char* name, const std::string& text) {
    if (!text.empty() && text != "-") found->values.emplace_back(name, text);
  };
  add("name", sheet.name);
  add("technology", sheet.sheet.technology);
  add("cells in series", std::to_string(sheet.sheet.cells_in_series));
  add("Isc (A)", Significant(v.short_circuit_current_A, 5));
  add("Voc (V)", Significant(v.open_circuit_voltage_V, 5));
  add("Imp (A)", Significant(v.max_power_current_A, 5));
  add("Vmp (V)", Significant(v.max_power_voltage_V, 5));
  add("alpha (A/K)", Significant(v.alpha_sc_A_K, 3));
  add("beta (V/K)", Significant(v.beta_oc_V_K, 3));
}

// The modules of SAM's library: the rows below the names, the units and the identifiers.
std::size_t CountModules(const std::string& text) {
  std::size_t lines = 0;
  std::string_view line;
  for (LineReader reader(text); reader.NextContent(&line);) {
    const bool of_the_head = lines == 0 || line.substr(0, 5) == "Units" || line[0] == '[';
    if (lines == 0 || !of_the_head) ++lines;
  }
  return lines - 1;
}

// Reads the curves of an input of many one by one.
void TakeBatch(const Inspected& file, const std::string& form) {
  Inspection* const found = file.found;
  BatchReadOptions options;
  options.reading = file.options;
  auto source = OpenBatch({file.path}, options);
  if (!source) {
    found->refusal = source.error().ToString();
    return;
  }
  CurveSet set;
  std::size_t count = 0;
  while (true) {
    auto item = (*source)->Next();
    if (!item || !*item) break;
    if (count++ >= kMostCurveNotes) continue;
    BatchCurve curve = (*source)->Read(**item);
    if (curve.curve) {
      set.curves.push_back(std::move(*curve.curve));
      set.curves.back().name = curve.id;
    } else {
      set.rejected.push_back({curve.id, curve.curve.error()});
    }
  }
  found->form = form;
  if (set.curves.empty() && !set.rejected.empty()) {
    found->refusal = set.rejected.front().error.ToString();
  }
  if (!set.curves.empty()) DescribeCurves(set, found);
  found->curve_count = count;
  found->next = {"lyrefit batch " + file.path + " --out DIR", "lyrefit pack " + file.path};
}

}  // namespace

bool TakeModule(const Inspected& file) {
  Inspection* const found = file.found;
  const std::string& text = file.text.text;
  if (IsCecLibrary(text)) {
    const std::size_t count = CountModules(text);
    found->form = fmt::format("SAM's library of CEC modules, {} of them", count);
    if (count == 1) {
      if (const auto sheet = ReadModuleSheet(file.path)) TakeSheet(*sheet, found);
    }
    const std::string name = count == 1 ? file.path : fmt::format("'{}#NAME'", file.path);
    found->next = {"lyrefit datasheet " + name, "lyrefit simulate --from " + name};
    return true;
  }
  if (text.find("PVObject_") == std::string::npos || file.path == "-") return false;
  found->form = "module of PVsyst (.PAN)";
  const auto sheet = ReadModuleSheet(file.path);
  if (sheet) TakeSheet(*sheet, found);
  if (!sheet) found->refusal = sheet.error().ToString();
  found->next = {"lyrefit datasheet " + file.path, "lyrefit simulate --from " + file.path};
  return true;
}

bool TakeManyCurves(const Inspected& file) {
  constexpr std::size_t kBeginning = 1 << 20;
  if (file.path == "-") return false;
  const std::string_view text(file.text.text);
  const std::size_t at = text.find_first_not_of(" \t\r\n");
  if (at == std::string_view::npos) return false;
  if (text[at] == '{' || text[at] == '[') {
    const auto document = DocumentIn(file.text.text, "");
    if (document && *document) return false;
    const std::string ending = LowerCase(fs::path(file.path).extension().string());
    if (ending != ".jsonl" && ending != ".ndjson") return false;
    TakeBatch(file, "JSON Lines, a curve a row");
    return true;
  }
  const CsvHead head = FindCsvHead(text.substr(0, kBeginning), file.options);
  if (head.shape != CsvShape::kRows && head.shape != CsvShape::kLong) return false;
  const bool rows = head.shape == CsvShape::kRows;
  const auto set = rows ? Expected<CurveSet>(Fail("")) : CurvesIn(file, file.options);
  if (set && set->curves.size() > 1) return false;
  TakeBatch(file, rows ? "table of one curve a row" : "long table, a reading a row");
  return true;
}

void TakeFolder(const std::string& path, const ReadOptions& options, Inspection* found) {
  found->form = "folder";
  found->next = {"lyrefit batch " + path + " --out DIR"};
  std::error_code error;
  std::size_t tables = 0, folders = 0;
  for (fs::recursive_directory_iterator entry(path, error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry->is_directory(error)) ++folders;
    if (IsTable(entry->path())) ++tables;
  }
  found->form = fmt::format("folder with {} tables in {} folders", tables, folders + 1);
  if (!HoldsCurveSet(path, options)) {
    if (tables == 0) found->refusal = "no table (.csv, .txt, ...) in this folder";
    return;
  }
  const auto set = ReadCurveSet(path, options);
  if (!set) {
    found->doubts.push_back("as one set of curves: " + set.error().ToString());
    return;
  }
  DescribeCurves(*set, found);
  found->next = {"lyrefit batch " + path + " --out DIR",
                 "lyrefit fit " + path + " --family auto  (if all are of one device)"};
}

}  // namespace lyrefit

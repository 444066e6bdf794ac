#include "lyrefit/inspect/inspect.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "lyrefit/base/file.h"
#include "lyrefit/base/reasons.h"
#include "lyrefit/base/try.h"
#include "lyrefit/inspect/inspect_parts.h"
#include "lyrefit/read/curve_text.h"
#include "lyrefit/read/json_text.h"
#include "lyrefit/read/key_point_table.h"
#include "lyrefit/read/multi_flash.h"
#include "lyrefit/read/sidecar.h"
#include "lyrefit/read/table_curve.h"
#include "lyrefit/read/table_view.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

std::string EncodingOf(const DecodedText& text) {
  if (text.remark.empty()) return "UTF-8";
  return text.remark.find("UTF-16") != std::string::npos ? "UTF-16" : "Windows-1252";
}

Expected<DecodedText> ReadText(const std::string& path, std::uintmax_t largest_bytes) {
  const bool input = path == "-";
  TRY(std::string bytes, ReadFileBytes(input ? "/dev/stdin" : path, largest_bytes));
  return DecodeText(std::move(bytes), input ? "standard input" : path);
}

// Describes a JSON document. False: the text is none.
bool TakeDocument(const Inspected& file) {
  const auto document = DocumentIn(file.text.text, file.path);
  if (!document) {
    file.found->form = "JSON document, which is broken";
    file.found->refusal = document.error().ToString();
    return true;
  }
  if (!*document) return false;
  file.found->form = "JSON document";
  if (IsReport(**document)) {
    file.found->form = "report of this program";
    file.found->next = {"lyrefit simulate --from " + file.path};
    return true;
  }
  TakeCurves(file);
  return true;
}

void TakeText(const Inspected& file) {
  Inspection* const found = file.found;
  if (TakeModule(file)) return;
  if (const auto log = FindOperatingLog(file.text.text)) {
    TakeTable(file);
    found->form = "operating points of a day";
    found->refusal = *log;
    found->next = {"lyrefit trend --operating " + file.path + " --module MODEL"};
    return;
  }
  const std::string first = file.text.text.substr(0, 1);
  if (TakeManyCurves(file)) {
    if (first != "{" && first != "[") TakeTable(file);
    return;
  }
  if (TakeDocument(file)) return;
  if (IsMultiFlash(file.text.text)) {
    found->form = "flashes of a multi-flash tester at fixed loads";
    TakeCurves(file);
    return;
  }
  found->form = HoldsKeyPoints(file.text.text, file.path)
                    ? "matrix of key points over irradiance and temperature"
                    : "table";
  TakeTable(file);
  if (found->form != "table") {  // its columns are key points and conditions, none of a sweep
    if (found->rows < 2) found->columns.clear();
    for (ColumnNote& column : found->columns) column.use = "of the matrix";
  }
  if (found->first_row_line == 0) found->form = "text without a table";
  TakeCurves(file);
}

// Sentences that the layout and the curves say alike.
std::vector<std::string> SaidOnce(const std::vector<std::string>& sentences) {
  std::vector<std::string> kept;
  for (const std::string& one : sentences) {
    if (std::find(kept.begin(), kept.end(), one) == kept.end()) kept.push_back(one);
  }
  return kept;
}

}  // namespace

Expected<CurveSet> CurvesIn(const Inspected& file, const ReadOptions& options) {
  if (TextHoldsCurveSet(file.text, file.path, options)) {
    return CurveSetOfFile(file.text, file.path, options);
  }
  TRY(IvCurve curve, CurveOfFile(file.text, file.path, options));
  return SetOfOne(std::move(curve));
}

Expected<Inspection> Inspect(const std::string& path, const ReadOptions& options) {
  Inspection found;
  found.file = path;
  ReadOptions all = options;
  all.curve.reset();
  all.column.clear();
  if (IsFolder(path) && CurveInFolder(path).empty()) {
    TakeFolder(path, all, &found);
    return found;
  }
  const std::string inside = IsFolder(path) ? CurveInFolder(path).string() : path;
  if (inside != "-") TRY(CheckIsNoStream(inside));
  TRY(const DecodedText text, ReadText(inside, options.largest_file_bytes));
  found.encoding = EncodingOf(text);
  TakeText({inside, all, text, &found});
  if (inside != path) found.form = "folder of one curve; in it " + inside + ": " + found.form;
  found.doubts = OncePerKind(found.doubts);
  found.assumed = SaidOnce(found.assumed);
  return found;
}

}  // namespace lyrefit

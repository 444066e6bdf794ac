#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "lyrefit/base/try.h"
#include "lyrefit/read/json_curves.h"
#include "lyrefit/read/json_text.h"
#include "lyrefit/stream/batch_input.h"
#include "lyrefit/stream/json_row.h"
#include "lyrefit/stream/row_curve.h"
#include "lyrefit/stream/row_names.h"

namespace lyrefit {
namespace {

// An error with the line and column of a text of several lines.
tl::unexpected<Error> RefuseAt(std::string_view text, const RecordPlace& place,
                               const Error& error) {
  const std::size_t at = std::min<std::size_t>(std::max(error.column - 1, 0), text.size());
  const std::string_view before = text.substr(0, at);
  const auto lines = std::count(before.begin(), before.end(), '\n');
  if (lines == 0) return place.Refuse(error.message, error.column);
  return place.Refuse(error.message, static_cast<int>(at - before.rfind('\n')), place.line + lines);
}

// Reads nested readings: tables as written by pandas, lists of records.
Expected<IvCurve> NestedCurve(std::string_view text, const RecordPlace& place,
                              const std::string& id, const ReadOptions& options) {
  auto document = ParseJson(std::string(text), place.file);
  if (!document) return place.Refuse(document.error().message);
  auto curves = FindJsonCurves(*document, place.file, options);
  if (!curves) return place.Refuse(curves.error().message);
  if (curves->size() != 1) {
    return place.Refuse(fmt::format("expected one curve in a row, found {}", curves->size()));
  }
  RawCurve raw = std::move(curves->curves.front());
  auto curve = FinishCurve(std::move(raw), options);
  if (!curve) return place.Refuse(curve.error().message);
  curve->name = id;
  return curve;
}

bool HasReadings(const Records& fields) {
  return std::any_of(fields.lists.begin(), fields.lists.end(), [](const Record& list) {
    return IsElectrical(MeaningOf(list.name).column.kind);
  });
}

void AddAround(const std::vector<RecordScalar>& around, Records* fields) {
  for (const RecordScalar& scalar : around) {
    const bool own =
        std::any_of(fields->scalars.begin(), fields->scalars.end(),
                    [&](const RecordScalar& other) { return other.name == scalar.name; });
    if (!own && MeaningOf(scalar.name).id == IdPart::kNone) fields->scalars.push_back(scalar);
  }
}

}  // namespace

BatchCurve ReadJsonText(std::string_view text, const BatchItem& item, const std::string& path,
                        const std::vector<RecordScalar>& around, const ReadOptions& options) {
  ForgetManyNames();
  const RecordPlace place{path, item.line};
  BatchCurve curve;
  curve.id = item.id;
  Records fields;
  if (const auto parsed = ParseJsonRow(text, &fields); !parsed) {
    curve.curve = RefuseAt(text, place, parsed.error());
    return curve;
  }
  AddAround(around, &fields);
  curve.beside = BesideOfRow(fields);
  curve.curve = fields.nested && !HasReadings(fields) ? NestedCurve(text, place, item.id, options)
                                                      : CurveOfRow(fields, place, item.id, options);
  return curve;
}

}  // namespace lyrefit

#include "lyrefit/batch/history.h"

#include <map>
#include <utility>

#include "lyrefit/base/try.h"
#include "lyrefit/batch/addition.h"

namespace lyrefit {

class ReferenceSweeps {
 public:
  std::string digest;
  std::map<std::string, std::vector<IvCurve>> by_id;
};

namespace {

// Clears all data that the comparison does not use.
void Slim(IvCurve* curve) {
  curve->sweep = {};
  curve->time_s = {};
  curve->irradiance_W_m2 = {};
  curve->temperature_C = {};
  curve->assumptions = {};
}

std::vector<IvCurve> SweepsOf(const ReferenceSweeps& sweeps, const std::string& id) {
  const auto own = sweeps.by_id.find(id);
  if (own != sweeps.by_id.end()) return own->second;
  std::vector<IvCurve> below;  // sweeps in the folder "id/"
  const std::string prefix = id + "/";
  for (auto it = sweeps.by_id.lower_bound(prefix);
       it != sweeps.by_id.end() && it->first.compare(0, prefix.size(), prefix) == 0; ++it) {
    if (ParentOf(it->first) != id) continue;
    below.insert(below.end(), it->second.begin(), it->second.end());
  }
  return below;
}

std::vector<ResultColumn> HistoryColumns() {
  constexpr CellType kText = CellType::kText;
  return {{"history_sweeps", "", CellType::kWhole, "reference sweeps of the same string"},
          {"history_p", "", CellType::kNumber,
           "p-value of the difference from them, all looks at it counted"},
          {"history_cause", "", kText, "what would make the difference, where there is one"},
          {"history_sentence", "", kText, "the comparison in one sentence, or why there is none"}};
}

std::vector<ResultCell> HistoryCells(const IvCurve& curve, const std::vector<IvCurve>& sweeps,
                                     const ReferenceOptions& options) {
  std::vector<ResultCell> cells = {static_cast<std::int64_t>(sweeps.size())};
  if (sweeps.empty()) {
    cells.resize(3);
    cells.push_back(std::string("no reference sweep has this id"));
    return cells;
  }
  const auto comparison = CompareWithReferences(curve, sweeps, options);
  if (!comparison) {
    cells.resize(3);
    cells.push_back(TextCell(comparison.error().message));
    return cells;
  }
  const bool cause = comparison->differs && !comparison->causes.empty();
  cells.push_back(NumberCell(comparison->p_value));
  cells.push_back(cause ? TextCell(comparison->causes.front().id) : ResultCell());
  cells.push_back(TextCell(comparison->sentence));
  return cells;
}

}  // namespace

Expected<std::shared_ptr<const ReferenceSweeps>> ReadReferences(
    BatchSource* source, const std::function<Expected<void>(IvCurve*)>& prepare) {
  auto sweeps = std::make_shared<ReferenceSweeps>();
  TRY(sweeps->digest, source->Digest());
  std::optional<Error> first;
  while (true) {
    TRY(const auto item, source->Next());
    if (!item) break;
    BatchCurve curve = source->Read(*item);
    if (curve.curve && prepare) {
      if (auto prepared = prepare(&*curve.curve); !prepared) {
        curve.curve = tl::unexpected(prepared.error());
      }
    }
    if (!curve.curve) {
      if (!first) first = curve.curve.error();
      continue;
    }
    Slim(&*curve.curve);
    sweeps->by_id[curve.id].push_back(std::move(*curve.curve));
  }
  if (!sweeps->by_id.empty()) return sweeps;
  if (first) return tl::unexpected(*first);
  return Fail("no reference sweep in there");
}

BatchTaskType WithHistory(BatchTaskType task, std::shared_ptr<const ReferenceSweeps> sweeps,
                          const ReferenceOptions& asked) {
  ReferenceOptions options = asked;
  options.threads = 1;
  const std::size_t own = task.columns.size();
  for (const ResultColumn& column : HistoryColumns()) task.columns.push_back(column);
  task.options.push_back({"reference", sweeps->digest, ""});
  AppendNonDefaults(options, kReferenceOptionTable, &task.options);
  task.run = [run = task.run, sweeps = std::move(sweeps), options, own](
                 const BatchCurve& curve, std::uint64_t seed, const Observer& observer) {
    TaskResult result = run(curve, seed, observer);
    if (result.interrupted) return result;
    result.cells.resize(own);
    for (ResultCell& cell : HistoryCells(*curve.curve, SweepsOf(*sweeps, curve.id), options)) {
      result.cells.push_back(std::move(cell));
    }
    return result;
  };
  return task;
}

}  // namespace lyrefit

#include "paper/proof_table.h"

#include <filesystem>
#include <map>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/base/try.h"
#include "lyrefit/certify/floor.h"
#include "lyrefit/estimate/fit/bounds.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/settings/bounds_file.h"
#include "studies/named_table.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

Expected<double> NumberIn(const NamedTable& table, int column) {
  const auto value = ParseNumber(table[column]);
  if (!value) return table.Refuse(column, "a number");
  return *value;
}

// Names of the bounds of a curve: the published ones and the default search bounds.
std::vector<std::string> BoxesOf(const fs::path& folder) {
  std::vector<std::string> boxes;
  for (const char* name : {"literature", "paper"}) {
    if (fs::exists(folder / ("bounds-" + std::string(name) + ".json"))) boxes.emplace_back(name);
  }
  boxes.emplace_back("physical");
  return boxes;
}

Expected<void> Prove(const IvCurve& curve, const Observer& observer, ProofRow* row) {
  TRY(const Certificate certificate, Certify(curve, row->options, observer));
  row->proof = certificate.models.at(0);
  row->seconds = certificate.seconds;
  if (row->options.objective != Objective::kMeasuredCurrent) return {};
  CertifyOptions rigorous = row->options;
  rigorous.rigorous = true;
  TRY(const Certificate safe, Certify(curve, rigorous, observer));
  row->rigorous_lower_A = safe.models.at(0).lower_bound_A;
  row->rigorous_seconds = safe.seconds;
  return {};
}

// Adds the rows of a curve, without results.
Expected<void> AddRows(const IvCurve& curve, const fs::path& folder, std::int64_t effort,
                       std::vector<ProofRow>* rows) {
  for (const std::string& box : BoxesOf(folder)) {
    TRY(const BoundsSpec spec, NamedBounds(box, folder.string()));
    for (const Objective objective : {Objective::kMeasuredCurrent, Objective::kSolvedCurrent}) {
      for (const Model model : CertifyOptions().models) {
        ProofRow row = {curve.name, static_cast<int>(curve.size()), box, {}, {}};
        row.options.models = {model};
        row.options.objective = objective;
        row.options.effort = effort;
        TRY(row.options, CertifyWithin(spec, curve, row.options));
        rows->push_back(std::move(row));
      }
    }
  }
  return {};
}

}  // namespace

Expected<std::vector<ForeignProof>> ReadForeignProofs(const std::string& path) {
  enum Column { kCurve, kModel, kBest, kBound, kSeconds, kCells };
  NamedTable table;
  TRY(table.Open(path, {"curve", "model", "best_A2", "lower_bound_A2", "seconds", "cells"}));
  std::vector<ForeignProof> proofs;
  double cells_before = 0;
  while (true) {
    TRY(const bool more, table.Next());
    if (!more) return proofs;
    ForeignProof proof;
    proof.curve = table[kCurve];
    const auto model = FromText<Model>(table[kModel]);
    if (!model) return table.Refuse(kModel, "sd, dd or td");
    proof.model = *model;
    TRY(proof.best_A2, NumberIn(table, kBest));
    TRY(proof.lower_bound_A2, NumberIn(table, kBound));
    TRY(proof.seconds, NumberIn(table, kSeconds));
    TRY(const double cells, NumberIn(table, kCells));
    const bool goes_on =
        !proofs.empty() && proofs.back().curve == proof.curve && proofs.back().model == proof.model;
    if (!goes_on) {
      proofs.push_back(proof);
    } else if (cells > cells_before) {  // a run without new cells proves nothing
      proofs.back() = proof;
    }
    cells_before = cells;
  }
}

Expected<ProofTable> ProveShipped(const std::string& folder, std::int64_t effort, int threads,
                                  const Observer& observer) {
  ProofTable table;
  TRY(table.foreign, ReadForeignProofs((fs::path(folder) / "published/proofs.csv").string()));
  std::map<std::string, IvCurve> curves;
  for (const char* name : {"rtc_france", "pwp201", "stm6_40_36", "stp6_120_36", "msx60"}) {
    const fs::path path = fs::path(folder) / name;
    TRY(IvCurve curve, ReadCurve(path.string()));
    TRY(AddRows(curve, path, effort, &table.rows));
    curves[curve.name] = std::move(curve);
  }
  const int count = static_cast<int>(table.rows.size());
  std::vector<Expected<void>> done(count);
  const ProgressReporter progress(observer, "shipped curves", count);
  ParallelFor(count, threads, [&](int i) {
    if (progress.Stopped()) return;
    ProofRow& row = table.rows[i];
    done[i] = Prove(curves.at(row.curve), progress.stop().AsObserver(), &row);
    progress.Step();
  });
  table.interrupted = progress.Stopped();
  for (const Expected<void>& one : done) TRY(one);
  return table;
}

}  // namespace lyrefit

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <vector>

#include "plant/synthetic_score.h"
#include "plant/synthetic_table.h"

namespace made {
namespace {

// "19 of 20, 95 % [76 %, 99 %]", Wilson's interval.
std::string ShareText(int part, int all) {
  const double z = 1.96, n = std::max(all, 1), p = part / n;
  const double middle = p + z * z / (2 * n), scale = 1 + z * z / n;
  const double half = z * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
  char buffer[120];
  std::snprintf(buffer, sizeof buffer, "%d of %d (%.1f to %.1f %%)", part, all,
                100 * std::max(middle - half, 0.0) / scale,
                100 * std::min(middle + half, scale) / scale);
  return buffer;
}

double NumberIn(const Row& row, const char* name) { return std::atof(At(row, name).c_str()); }

// The text between the brackets after "gone_ids".
std::string GoneIds(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const std::size_t begin = text.find("\"gone_ids\": [");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find(']', begin) - begin);
}

struct Watts {
  int known = 0, inside = 0;
  double truth = 0, stated = 0;
  std::vector<double> errors;

  void Add(const Row& truth_row, const Row& row) {
    const double lost = NumberIn(truth_row, "lost_W");
    if (At(row, "change_lost_W").empty() || lost == 0) return;
    ++known;
    inside += lost >= NumberIn(row, "change_lost_W_low_95") &&
              lost <= NumberIn(row, "change_lost_W_high_95");
    truth += std::fabs(lost);
    stated += std::fabs(NumberIn(row, "change_lost_W"));
    errors.push_back(std::fabs(NumberIn(row, "change_lost_W") - lost));
  }
};

// One change, of one or two strings.
struct Found {
  bool all = true, named = true;
};

}  // namespace

std::string ScoreChanges(const ChangeScoreRequest& request, std::string* text) {
  std::vector<Row> results, truths;
  std::string error = ReadRows(request.results, &results);
  if (error.empty()) error = ReadRows(request.truth, &truths);
  if (!error.empty()) return error;
  const std::string gone = GoneIds(request.campaign);
  std::map<std::string, Row> by_id;
  for (const Row& row : results) by_id[At(row, "id")] = row;
  std::map<std::string, Found> changes;
  std::set<std::string> hidden;
  Watts watts;
  std::string lines;
  for (const Row& truth : truths) {
    const std::string id = At(truth, "id");
    hidden.insert(id);
    const Row& row = by_id[id];
    std::string kind = At(row, "change_kind");
    if (gone.find("\"" + id + "\"") != std::string::npos) kind = "gone";
    std::set<std::string> names = Words(At(row, "change_candidates"), " ");
    names.insert(kind);
    const bool found = !kind.empty() && kind != "none";
    bool named = false;
    for (const std::string& accepted : Words(At(truth, "accepted"), "|")) {
      named = named || names.count(accepted) > 0;
    }
    Found& change = changes[At(truth, "change")];
    change.all = change.all && found;
    change.named = change.named && named;
    if (found) watts.Add(truth, row);
    lines += "  " + id + "  " + At(truth, "change") + " (" + At(truth, "lost_W") +
             " W): " + (found ? kind + " " + At(row, "change_lost_W") : "not found") +
             (found && !named ? "  [another name]" : "") + "\n";
  }
  int found = 0, named = 0, others = 0, wrong = 0;
  for (const auto& [name, change] : changes) {
    found += change.all;
    named += change.all && change.named;
  }
  for (const Row& row : results) {
    if (hidden.count(At(row, "id"))) continue;
    ++others;
    if (At(row, "change_rank").empty()) continue;
    ++wrong;
    lines += "  " + At(row, "id") + "  not changed: " + At(row, "change_kind") + "\n";
  }
  std::sort(watts.errors.begin(), watts.errors.end());
  const double middle = watts.errors.empty() ? 0 : watts.errors[watts.errors.size() / 2];
  char buffer[200];
  std::snprintf(buffer, sizeof buffer,
                "watts: %.0f stated of %.0f, median error %.0f W, in the 95 %% interval ",
                watts.stated, watts.truth, middle);
  *text = "found " + ShareText(found, static_cast<int>(changes.size())) + ", under a right name " +
          ShareText(named, found) + "\nfalse " + ShareText(wrong, others) + "\n" + buffer +
          ShareText(watts.inside, watts.known) + "\n" + lines;
  return "";
}

}  // namespace made

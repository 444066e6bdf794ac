#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>

#include "batch/synthetic_curves.h"
#include "plant/synthetic_plant.h"
#include "plant/synthetic_scale.h"
#include "plant/synthetic_score.h"

namespace {

constexpr const char* kUsage =
    "lyrefit_synthetic curves --out FILE [--truth FILE] [--count N] [--points P] [--broken SHARE]\n"
    "             [--reversed SHARE] [--seed N] [--shape jsonl|csv]\n"
    "lyrefit_synthetic plant [--packed FILE] [--tree FOLDER [--sidecars 1]] [--truth FILE]\n"
    "             [--module FILE] [--strings N] [--years N] [--seed N] [--threads N]\n"
    "lyrefit_synthetic score --results FILE --truth FILE [--campaign FILE]\n"
    "lyrefit_synthetic scale --out FOLDER [--plants N] [--seed N] [--threads N]\n"
    "lyrefit_synthetic scale-score --folder FOLDER --results NAME [--planned 0|1]\n";

using Flags = std::map<std::string, std::function<void(const char*)>>;

bool Read(int argc, char** argv, const Flags& flags) {
  for (int i = 2; i + 1 < argc; i += 2) {
    const auto flag = flags.find(argv[i]);
    if (flag == flags.end()) return false;
    flag->second(argv[i + 1]);
  }
  return argc % 2 == 0;
}

int Usage() {
  std::fputs(kUsage, stderr);
  return 1;
}

int Told(const std::string& error) {
  if (error.empty()) return 0;
  std::fprintf(stderr, "lyrefit_synthetic: %s\n", error.c_str());
  return 1;
}

int Curves(int argc, char** argv) {
  made::CurvesRequest request;
  bool known_shape = true;
  const Flags flags = {
      {"--out", [&](const char* text) { request.out = text; }},
      {"--truth", [&](const char* text) { request.truth = text; }},
      {"--count", [&](const char* text) { request.count = std::atoll(text); }},
      {"--points", [&](const char* text) { request.points = std::atoi(text); }},
      {"--broken", [&](const char* text) { request.broken = std::atof(text); }},
      {"--reversed", [&](const char* text) { request.reversed = std::atof(text); }},
      {"--seed", [&](const char* text) { request.seed = std::strtoull(text, nullptr, 10); }},
      {"--shape",
       [&](const char* text) {
         const std::string shape = text;
         known_shape = shape == "jsonl" || shape == "csv";
         request.shape = shape == "csv" ? made::Shape::kCsv : made::Shape::kJsonLines;
       }},
  };
  if (!Read(argc, argv, flags) || !known_shape || request.out.empty()) return Usage();
  if (request.points < 8) return Told("--points is at least 8");
  return Told(made::WriteCurves(request));
}

int Plant(int argc, char** argv) {
  made::PlantRequest request;
  const Flags flags = {
      {"--packed", [&](const char* text) { request.packed = text; }},
      {"--tree", [&](const char* text) { request.tree = text; }},
      {"--sidecars", [&](const char* text) { request.sidecars = std::atoi(text) != 0; }},
      {"--truth", [&](const char* text) { request.truth = text; }},
      {"--module", [&](const char* text) { request.module = text; }},
      {"--strings", [&](const char* text) { request.strings = std::atoi(text); }},
      {"--years", [&](const char* text) { request.years = std::atoi(text); }},
      {"--seed", [&](const char* text) { request.seed = std::strtoull(text, nullptr, 10); }},
      {"--threads", [&](const char* text) { request.threads = std::atoi(text); }},
  };
  if (!Read(argc, argv, flags) || (request.packed.empty() && request.tree.empty())) return Usage();
  return Told(made::WritePlant(request));
}

int Score(int argc, char** argv) {
  made::ScoreRequest request;
  std::string campaign;
  const Flags flags = {
      {"--results", [&](const char* text) { request.results = text; }},
      {"--truth", [&](const char* text) { request.truth = text; }},
      {"--campaign", [&](const char* text) { campaign = text; }},
  };
  if (!Read(argc, argv, flags) || request.results.empty() || request.truth.empty()) return Usage();
  std::string text;
  const int code = Told(
      campaign.empty() ? made::Score(request, &text)
                       : made::ScoreChanges({request.results, campaign, request.truth}, &text));
  std::fputs(text.c_str(), stdout);
  return code;
}

int Scale(int argc, char** argv) {
  made::ScalePlantsRequest request;
  const Flags flags = {
      {"--out", [&](const char* text) { request.folder = text; }},
      {"--plants", [&](const char* text) { request.plants = std::atoi(text); }},
      {"--seed", [&](const char* text) { request.seed = std::strtoull(text, nullptr, 10); }},
      {"--threads", [&](const char* text) { request.threads = std::atoi(text); }},
  };
  if (!Read(argc, argv, flags) || request.folder.empty()) return Usage();
  return Told(made::WriteScalePlants(request));
}

int ScaleScore(int argc, char** argv) {
  made::ScaleScoreRequest request;
  const Flags flags = {
      {"--folder", [&](const char* text) { request.folder = text; }},
      {"--results", [&](const char* text) { request.results = text; }},
      {"--planned", [&](const char* text) { request.planned = std::atoi(text) != 0; }},
  };
  if (!Read(argc, argv, flags) || request.folder.empty() || request.results.empty()) return Usage();
  std::string text;
  const int code = Told(made::ScoreScalePlants(request, &text));
  std::fputs(text.c_str(), stdout);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string mode = argc > 1 ? argv[1] : "";
  if (mode == "curves") return Curves(argc, argv);
  if (mode == "score") return Score(argc, argv);
  if (mode == "scale") return Scale(argc, argv);
  if (mode == "scale-score") return ScaleScore(argc, argv);
  return mode == "plant" ? Plant(argc, argv) : Usage();
}

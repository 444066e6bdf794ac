#include "bench_support.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/random.h"
#include "lyrefit/estimate/fit/search_space.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/settings/bounds_file.h"

namespace lyrefit::bench {
namespace {

std::string Folder(const std::string& name) { return LYREFIT_DATA_DIR "/" + name; }

}  // namespace

IvCurve LoadCurve(const std::string& name) {
  auto curve = ReadCurve(Folder(name) + "/curve.csv");
  CHECK(curve) << curve.error().ToString();
  return std::move(*curve);
}

BoundsSpec LoadBounds(const std::string& name, const std::string& kind) {
  auto bounds = ReadBoundsFile(Folder(name) + "/bounds-" + kind + ".json");
  CHECK(bounds) << bounds.error().ToString();
  return std::move(*bounds);
}

Case MakeCase(const std::string& curve, Model model, const BoundsSpec& bounds,
              ConstantSet constants) {
  Case made;
  made.curve = LoadCurve(curve);
  made.device = MakeDevice(model, made.curve.conditions, constants);
  made.points = MakePointSet(made.curve.voltage_V, made.curve.current_A);
  auto box = MakeBounds(bounds, made.device, made.curve);
  CHECK(box) << box.error().ToString();
  made.bounds = std::move(*box);
  return made;
}

std::vector<double> DrawParameters(const Case& subject, int count) {
  const int size = subject.device.size();
  const SearchSpace space(subject.bounds, std::vector<double>(size, std::nan("")));
  std::vector<double> parameters(static_cast<std::size_t>(count) * size);
  std::vector<double> x(space.dimensions());
  RandomStream random(1);
  for (int k = 0; k < count; ++k) {
    for (int j = 0; j < space.dimensions(); ++j) {
      const double side = space.box().upper[j] - space.box().lower[j];
      x[j] = space.box().lower[j] + random.Uniform() * side;
    }
    space.ToParameters(x.data(), &parameters[static_cast<std::size_t>(k) * size]);
  }
  return parameters;
}

double CertifiedRmse(Model model, Objective objective) {
  const bool single = model == Model::kSingleDiode;
  if (objective == Objective::kMeasuredCurrent)
    return single ? 9.860218778918e-4 : 9.824848761019e-4;
  return single ? 7.730062689942e-4 : 7.326480808687e-4;
}

bool IsHit(double rmse, double certified) { return std::fabs(rmse / certified - 1) <= 1e-9; }

std::string ModelName(Model model) {
  std::string name = ToText(model);
  for (char& c : name) c = static_cast<char>(c - 'a' + 'A');
  return name;
}

std::string ObjectiveName(Objective which) {
  return which == Objective::kMeasuredCurrent ? "measured" : "solved";
}

}  // namespace lyrefit::bench

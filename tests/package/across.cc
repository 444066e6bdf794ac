#include <cstdio>
#include <stdexcept>
#include <typeinfo>

#include "lyrefit/batch.h"
#include "lyrefit/lyrefit.h"
#include "lyrefit/search/search.h"

// Language features across the boundary of a shared library: a user's exception thrown through the
// library, the library's error thrown by an inline function of a header, and a class derived on one
// side and called on the other.
namespace {

struct Enough : std::runtime_error {
  using runtime_error::runtime_error;
};

class NoCurves : public lyrefit::BatchSource {
 public:
  lyrefit::Expected<std::optional<lyrefit::BatchItem>> Next() override { return std::nullopt; }
  lyrefit::BatchCurve Read(const lyrefit::BatchItem& /*item*/) const override { return {}; }
  std::int64_t size() const override { return 0; }
  lyrefit::Expected<std::string> Digest() const override { return "none"; }
  std::vector<std::string> Remarks() const override { return {}; }
};

bool ThrowsThrough() {
  lyrefit::Box box;
  box.lower = {0};
  box.upper = {1};
  try {
    lyrefit::Search([](const double*) -> double { throw Enough("enough"); }, box, {});
  } catch (const Enough& enough) {
    return enough.what() == std::string("enough");
  }
  return false;
}

bool ThrowsAnError() {
  try {
    lyrefit::ReadCurve("/nowhere/curve.csv").value();
  } catch (const tl::bad_expected_access<lyrefit::Error>& bad) {
    return bad.error().ToString().find("/nowhere/curve.csv") != std::string::npos;
  }
  return false;
}

bool CallsADerivedClass(const char* folder) {
  NoCurves none;
  lyrefit::BatchOptions options;
  options.folder = folder;
  const auto done = lyrefit::RunBatch(&none, lyrefit::FitTask(lyrefit::BatchFitOptions()), options);
  return done && done->rows == 0 && typeid(none) != typeid(lyrefit::BatchSource);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::puts("across FOLDER"), 1;
  const bool through = ThrowsThrough();
  const bool error = ThrowsAnError();
  const bool derived = CallsADerivedClass(argv[1]);
  std::printf(
      "an exception through the library %d, its error thrown %d, a derived class called %d\n",
      through, error, derived);
  return through && error && derived ? 0 : 1;
}

// What a vector kernel must not do, for the test of the test: it leaves a copy of std::vector's
// functions, compiled for AVX2, to the whole program.
#include <vector>

namespace lyrefit::avx2 {
double Last(const std::vector<double>& values) { return values.back(); }
}  // namespace lyrefit::avx2

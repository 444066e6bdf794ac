// The loops of every kernel. Each kernel_*.cc includes this file once, with LYREFIT_KERNEL (its
// namespace) and LYREFIT_KERNEL_WIDTH (doubles per register) defined. Everything here is in that
// namespace or forced inline. A function shared by two kernels would otherwise exist once, compiled
// for the newer processor, and fail on the older one.

#include "lyrefit/model/kernel.h"

namespace lyrefit::LYREFIT_KERNEL {

#define LYREFIT_PACK_WIDTH LYREFIT_KERNEL_WIDTH
#include "lyrefit/model/pack.inc"

template <int kValue>
struct Constant {
  static constexpr int value = kValue;
};

// Weighted sum of squared residuals of `kCount` blocks. The count is a constant, so that the loops
// unroll and the dependency chains of all blocks overlap.
template <int kCount>
LYREFIT_OP Pack MeasuredSquares(const PreparedDevice& d, const Block* voltage, const Block* current,
                                const Block* weight) {
  Pack vd[kCount], model[kCount];
  for (int k = 0; k < kCount; ++k) {
    const Pack measured = Load(current[k]);
    vd[k] = Load(voltage[k]) + measured * d.rs;
    model[k] = -measured;
  }
  for (int t = 0; t < d.count; ++t) {
    const PreparedTerm<double> term = d.terms[t];
    if (__builtin_expect(term.kind == TermKind::kRecombination, 0)) {
      for (int k = 0; k < kCount; ++k) model[k] = model[k] + RecombinationCurrent(term, vd[k]);
      continue;
    }
    for (int k = 0; k < kCount; ++k) model[k] = model[k] + UsualTermCurrent(term, vd[k]);
  }
  Pack sum(0.0);
  for (int k = 0; k < kCount; ++k) sum = sum + model[k] * model[k] * Load(weight[k]);
  return sum;
}

// Calls work(constant 4 .. 1, first block) over all blocks, four at a time while four are left.
template <class Work>
LYREFIT_OP void OverBlocks(const PointSet& points, const Work& work) {
  const int blocks = (points.size + Block::kLanes - 1) / Block::kLanes;
  int first = 0;
  for (; first + 4 <= blocks; first += 4) work(Constant<4>{}, first);
  if (blocks - first == 3) work(Constant<3>{}, first);
  if (blocks - first == 2) work(Constant<2>{}, first);
  if (blocks - first == 1) work(Constant<1>{}, first);
}

static double MeasuredMeanSquare(const PreparedDevice& d, const PointSet& points) {
  const Block* voltage = points.voltage_V.data();
  const Block* current = points.current_A.data();
  const Block* weight = points.weight.data();
  Pack sum(0.0);
  OverBlocks(points, [&](auto count, int first) {
    sum = sum + MeasuredSquares<count.value>(d, voltage + first, current + first, weight + first);
  });
  return Sum(sum) * points.inverse_size;
}

static double SolvedMeanSquare(const PreparedDevice& d, const PointSet& points,
                               double diode_limit) {
  const Block* voltage = points.voltage_V.data();
  const Block* current = points.current_A.data();
  const Block* weight = points.weight.data();
  Pack sum(0.0);
  OverBlocks(points, [&](auto count, int first) {
    Pack v[count.value], junction[count.value], solved[count.value];
    for (int k = 0; k < count.value; ++k) {
      v[k] = Load(voltage[first + k]);
      junction[k] = v[k] + Load(current[first + k]) * d.rs;
    }
    SolveTogether<count.value>(d, diode_limit, v, junction, solved);
    for (int k = 0; k < count.value; ++k) {
      const Pack residual = solved[k] - Load(current[first + k]);
      sum = sum + residual * residual * Load(weight[first + k]);
    }
  });
  return Sum(sum) * points.inverse_size;
}

static void SolveCurrents(const PreparedDevice& d, const PointSet& points, double diode_limit,
                          Block* current) {
  const Block* voltage = points.voltage_V.data();
  const Block* measured = points.current_A.data();
  OverBlocks(points, [&](auto count, int first) {
    Pack v[count.value], junction[count.value], solved[count.value];
    for (int k = 0; k < count.value; ++k) {
      v[k] = Load(voltage[first + k]);
      junction[k] = v[k] + Load(measured[first + k]) * d.rs;
    }
    SolveTogether<count.value>(d, diode_limit, v, junction, solved);
    for (int k = 0; k < count.value; ++k) Store(solved[k], &current[first + k]);
  });
}

static void ExplicitCurrents(const PreparedTerm<double>* terms, int count, double rs,
                             const PointSet& points, const Block* current, Block* rows) {
  using Sloped = Dual<3, Pack>;  // by the two numbers of a term and the junction voltage
  const Block* voltage = points.voltage_V.data();
  const int length = static_cast<int>(points.voltage_V.size());
  OverBlocks(points, [&](auto blocks, int first) {
    Pack vd[blocks.value], sum[blocks.value], slope[blocks.value];
    for (int k = 0; k < blocks.value; ++k) {
      vd[k] = Load(voltage[first + k]) + Load(current[first + k]) * rs;
      sum[k] = slope[k] = Pack(0.0);
    }
    for (int t = 0; t < count; ++t) {
      const PreparedTerm<Sloped> term = {terms[t].kind, Sloped(Pack(terms[t].a), 0),
                                         Sloped(Pack(terms[t].b), 1)};
      Block* by_a = rows + (2 + 2 * t) * length + first;
      for (int k = 0; k < blocks.value; ++k) {
        const Sloped part = TermCurrent(term, Sloped(vd[k], 2));
        sum[k] = sum[k] + part.a;
        slope[k] = slope[k] + part.v[2];
        Store(part.v[0], &by_a[k]);
        Store(part.v[1], &by_a[length + k]);
      }
    }
    for (int k = 0; k < blocks.value; ++k) {
      Store(sum[k], &rows[first + k]);
      Store(slope[k], &rows[length + first + k]);
    }
  });
}

extern const Kernel kKernel;
const Kernel kKernel = {LYREFIT_KERNEL_NAME, MeasuredMeanSquare, SolvedMeanSquare, SolveCurrents,
                        ExplicitCurrents};

}  // namespace lyrefit::LYREFIT_KERNEL

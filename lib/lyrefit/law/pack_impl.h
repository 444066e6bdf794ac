// Eight doubles at a time, for a processor with registers of LYREFIT_PACK_WIDTH doubles. Included
// inside a namespace of its own by pack.h and by each kernel: everything here is forced inline.

constexpr int kWidth = LYREFIT_PACK_WIDTH;
constexpr int kParts = Block::kLanes / kWidth;
typedef double Register __attribute__((vector_size(kWidth * sizeof(double))));
typedef long long Bits __attribute__((vector_size(kWidth * sizeof(double))));
typedef unsigned long long Unsigned __attribute__((vector_size(kWidth * sizeof(double))));

#define LYREFIT_EACH(i) for (int i = 0; i < kParts; ++i)
#define LYREFIT_OP [[gnu::always_inline]] inline

struct Mask {
  Bits part[kParts];
};

// Every operation is element by element, so the width of a register does not show.
struct Pack {
  Register part[kParts];

  Pack() = default;
  [[gnu::always_inline]] Pack(double value) {  // NOLINT: a number is eight of it
    for (Register& r : part) r = Register{} + value;
  }
  double operator[](int lane) const { return part[lane / kWidth][lane % kWidth]; }
};

LYREFIT_OP Pack Load(const Block& block) {
  Pack p;
  LYREFIT_EACH(i) __builtin_memcpy(&p.part[i], &block.lane[i * kWidth], sizeof(Register));
  return p;
}
LYREFIT_OP void Store(const Pack& p, Block* block) {
  LYREFIT_EACH(i) __builtin_memcpy(&block->lane[i * kWidth], &p.part[i], sizeof(Register));
}

LYREFIT_OP Pack operator+(Pack a, const Pack& b) {
  LYREFIT_EACH(i) a.part[i] += b.part[i];
  return a;
}
LYREFIT_OP Pack operator-(Pack a, const Pack& b) {
  LYREFIT_EACH(i) a.part[i] -= b.part[i];
  return a;
}
LYREFIT_OP Pack operator*(Pack a, const Pack& b) {
  LYREFIT_EACH(i) a.part[i] *= b.part[i];
  return a;
}
LYREFIT_OP Pack operator/(Pack a, const Pack& b) {
  LYREFIT_EACH(i) a.part[i] /= b.part[i];
  return a;
}
LYREFIT_OP Pack operator-(Pack a) {
  LYREFIT_EACH(i) a.part[i] = -a.part[i];
  return a;
}
// With plain numbers.
LYREFIT_OP Pack operator*(Pack a, double b) {
  LYREFIT_EACH(i) a.part[i] *= b;
  return a;
}
LYREFIT_OP Pack operator*(double a, const Pack& b) { return b * a; }
LYREFIT_OP Pack operator+(Pack a, double b) {
  LYREFIT_EACH(i) a.part[i] += b;
  return a;
}
LYREFIT_OP Pack operator+(double a, const Pack& b) { return b + a; }
LYREFIT_OP Pack operator-(Pack a, double b) {
  LYREFIT_EACH(i) a.part[i] -= b;
  return a;
}
LYREFIT_OP Pack operator-(double a, Pack b) {
  LYREFIT_EACH(i) b.part[i] = a - b.part[i];
  return b;
}
LYREFIT_OP Pack operator/(Pack a, double b) {
  LYREFIT_EACH(i) a.part[i] /= b;
  return a;
}
LYREFIT_OP Pack operator/(double a, Pack b) {
  LYREFIT_EACH(i) b.part[i] = a / b.part[i];
  return b;
}

LYREFIT_OP Mask operator<(const Pack& a, const Pack& b) {
  Mask m;
  LYREFIT_EACH(i) m.part[i] = a.part[i] < b.part[i];
  return m;
}
LYREFIT_OP Mask operator<(const Pack& a, double b) {
  Mask m;
  LYREFIT_EACH(i) m.part[i] = a.part[i] < b;
  return m;
}
LYREFIT_OP Mask operator<(double a, const Pack& b) {
  Mask m;
  LYREFIT_EACH(i) m.part[i] = a < b.part[i];
  return m;
}
LYREFIT_OP Mask operator&(Mask a, const Mask& b) {
  LYREFIT_EACH(i) a.part[i] &= b.part[i];
  return a;
}
LYREFIT_OP Mask operator|(Mask a, const Mask& b) {
  LYREFIT_EACH(i) a.part[i] |= b.part[i];
  return a;
}
LYREFIT_OP Mask operator!(Mask a) {
  LYREFIT_EACH(i) a.part[i] = ~a.part[i];
  return a;
}
LYREFIT_OP Pack Choose(const Mask& m, const Pack& yes, Pack no) {
  LYREFIT_EACH(i) no.part[i] = m.part[i] ? yes.part[i] : no.part[i];
  return no;
}
LYREFIT_OP Pack Smaller(Pack a, const Pack& b) {
  LYREFIT_EACH(i) a.part[i] = b.part[i] < a.part[i] ? b.part[i] : a.part[i];
  return a;
}
LYREFIT_OP Pack Larger(Pack a, const Pack& b) {
  LYREFIT_EACH(i) a.part[i] = a.part[i] < b.part[i] ? b.part[i] : a.part[i];
  return a;
}
LYREFIT_OP Pack Magnitude(const Pack& a) { return Choose(a < Pack(0.0), -a, a); }
LYREFIT_OP Pack abs(const Pack& a) { return Magnitude(a); }
LYREFIT_OP bool All(const Mask& m) {
  Bits all = m.part[0];
  for (int i = 1; i < kParts; ++i) all &= m.part[i];
  long long every = -1;
  for (int lane = 0; lane < kWidth; ++lane) every &= all[lane];
  return every != 0;
}
LYREFIT_OP Pack exp(Pack a) {
  LYREFIT_EACH(i) a.part[i] = PortableExp<Register, Unsigned>(a.part[i]);
  return a;
}
LYREFIT_OP double Sum(const Pack& a) {
  Block b;
  Store(a, &b);
  return ((b.lane[0] + b.lane[4]) + (b.lane[1] + b.lane[5])) +
         ((b.lane[2] + b.lane[6]) + (b.lane[3] + b.lane[7]));
}

#undef LYREFIT_PACK_WIDTH

#if defined(__x86_64__)
#include "lyrefit/model/string_solve.h"

namespace lyrefit::avx512 {

#define LYREFIT_PACK_WIDTH 8
#define LYREFIT_PACK_ALIGNMENT alignof(lyrefit::Pack)
#include "lyrefit/model/pack.inc"

extern const StringKernel kStringKernel;
const StringKernel kStringKernel = {"avx512", FindRootInOneGo<Pack>, AddSlopesInMemory<Pack>};

}  // namespace lyrefit::avx512
#endif

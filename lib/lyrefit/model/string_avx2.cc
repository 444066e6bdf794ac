#if defined(__x86_64__)
#include "lyrefit/model/string_solve.h"

namespace lyrefit::avx2 {

#define LYREFIT_PACK_WIDTH 4
#define LYREFIT_PACK_ALIGNMENT alignof(lyrefit::Pack)
#include "lyrefit/model/pack.inc"

extern const StringKernel kStringKernel;
const StringKernel kStringKernel = {"avx2", FindRootInOneGo<Pack>, AddSlopesInMemory<Pack>};

}  // namespace lyrefit::avx2
#endif

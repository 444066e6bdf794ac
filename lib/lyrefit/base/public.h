#pragma once

// Marks public headers: a shared library exports only their declarations. Public headers, and no
// others, open their namespace with `namespace LYREFIT_PUBLIC lyrefit {`.
#define LYREFIT_PUBLIC [[gnu::visibility("default")]]
